"""`scanbench verify`: the scans of a run, or of a real controller's trace, compared with a second execution."""

import re
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import NoReturn

import typer

from scanbench import __version__
from scanbench.cli import INTERRUPTED
from scanbench.cli.inputs import PARTLY, usage
from scanbench.cli.interrupt import Leaving
from scanbench.cli.outputs import must_be_writable, write_text
from scanbench.cli.progress import progress
from scanbench.cli.run_options import Options
from scanbench.cli.verify_controller import INTERVAL_MS, SAMPLES, Controller
from scanbench.cli.verify_subject import Given, Subject, opened
from scanbench.engines.available import flavours
from scanbench.public import iso
from scanbench.recording.programs import Make, on, reference
from scanbench.recording.reader import Unreadable
from scanbench.reports.report import Collected, Report, ReportHead
from scanbench.reports.report_html import to_html
from scanbench.reports.report_json import to_json
from scanbench.reports.report_text import verify_junit, verify_text
from scanbench.runtime.clock import wall_time
from scanbench.testing.command_text import AUTHOR
from scanbench.testing.said import with_near
from scanbench.verify.contract import DEFAULT_LIMIT, MAX_LIMIT, BadRange, Begun, Range
from scanbench.verify.ranges import parse_range

SCANS = 1000
"""That a project runs when nobody says how many."""
STRETCHES = 100
"""Of scans that were not compared; a report has the last ones."""
_STRETCH = re.compile(r"(\d*)\.\.(\d*)")


class ControlEngine(StrEnum):
    """What runs a recorded run again."""

    NATIVE = "native"
    REFERENCE = "reference"


def verify(
    path: Path = typer.Argument(metavar="PROJECT|RUNFILE", help="A folder with a program, a program file, or a recorded run."),
    model: str | None = typer.Option(None, metavar="NAME", help="PLC model of a project; else its own, else GENERIC-IEC."),
    range_: str = typer.Option("", "--range", metavar="POU:10-20", help="POU, POU:10-20, FILE:10-20, with @INSTANCE for one instance; else the whole scan."),
    scans: str = typer.Option("", metavar="A..B", help="Only these scans, both included; also A.. and ..B. A project runs up to B, else 1000 scans."),
    trace: Path | None = typer.Option(None, metavar="FILE", help="Log of a real controller (CSV or JSON, docs/trace-format.md) instead of a run."),
    map: Path | None = typer.Option(None, "--map", metavar="FILE", help="What the columns of the log are (JSON); else they are taken by their names."),
    controller: str | None = typer.Option(None, metavar="ADDRESS", help="A controller that runs, instead of a run: opc.tcp://HOST:4840 (OPC UA), fins://HOST:9600 (FINS, UDP) or fins+tcp://HOST:9600. It is only read."),
    node: list[str] = typer.Option([], metavar="NODE", help="Of a controller: what is read; else all that it shows, by FINS the variables of the program at addresses."),
    samples: int = typer.Option(SAMPLES, min=2, help="Of a controller: so often it is read."),
    every: int = typer.Option(INTERVAL_MS, metavar="MS", help="Of a controller: from one sample to the next."),
    interval: str = typer.Option("10ms", help="Of a project: task interval if no CONFIGURATION sets one."),
    set: list[str] = typer.Option([], "--set", metavar="PATH=VALUE[@SCAN]", help="Of a project: write before a scan, as with `run`."),
    force: list[str] = typer.Option([], "--force", metavar="PATH=VALUE[@SCAN]", help="Of a project: force from a scan on."),
    generate: list[str] = typer.Option([], "--raise", metavar="ERROR[@SCAN]", help="Of a project: raise an error, as with `run`."),
    clear: list[str] = typer.Option([], "--clear", metavar="ERROR|all[@SCAN]", help="Of a project: recover an error."),
    mode: list[str] = typer.Option([], "--mode", metavar="MODE[@SCAN]", help="Of a project: change to PROGRAM, MONITOR or RUN."),
    restart: list[str] = typer.Option([], "--restart", metavar="KIND[@SCAN]", help="Of a project: restart: cold, warm or power."),
    limit: int = typer.Option(DEFAULT_LIMIT, min=1, max=MAX_LIMIT, help="Uses of variables that are recorded of a scan; a row says when it was full."),
    engine: ControlEngine = typer.Option(ControlEngine.NATIVE, help="What a run is run again with; the monitor is the reference interpreter in any case."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
    html: Path | None = typer.Option(None, metavar="FILE", help="Write a page to read, print or keep too."),
    junit: Path | None = typer.Option(None, metavar="FILE", help="Write a JUnit report too: that all was compared, that there is no difference, and of a log each output."),
) -> None:  # fmt: skip
    """Run a program twice and compare: what ran (native code, or a real controller of which there is a log) and the
    reference interpreter, on the same inputs.

    Exit 0: no difference; 1: there is one; 2: wrong usage, or nothing could be compared; 4: no difference in what was
    compared, but that is not all: scans could not be compared, an input has no column in the log, or the run file is
    damaged, and a part of the run is lost; 130: interrupted, no difference so far.
    """
    options = Options(set, force, generate, clear, mode, restart)
    must_be_writable(html, junit)
    read = None if controller is None else Controller(controller, tuple(node), samples, every)
    _one_source(trace, map, read)
    wanted = _range(range_)
    first, last = _stretch(scans)
    given = Given(path, model, interval, options, SCANS if last is None else last + 1, trace, map, read)
    make: Make = on(Leaving(flavours())) if engine is ControlEngine.NATIVE else reference
    try:
        with opened(given, make) as subject:
            report, stopped = _verified(subject, wanted, limit, first, last)
    except KeyboardInterrupt:  # while the project runs, or the run goes to its first scan
        typer.echo("scanbench: interrupted before the first scan was verified", err=True)
        raise typer.Exit(INTERRUPTED) from None
    typer.echo(to_json(report) if as_json else "\n".join(verify_text(report)))
    _write(report, subject.lost, html, junit)
    _end(report, stopped, subject.lost)


def _write(report: Report, lost: bool, html: Path | None, junit: Path | None) -> None:
    if html is not None:
        write_text(html, to_html(report))
    if junit is not None:
        write_text(junit, verify_junit(report, "the run file is damaged: a part of its run is lost" if lost else ""))


def _range(text: str) -> Range:
    try:
        return parse_range(text)
    except BadRange as error:
        usage(f"--range {text}: {with_near(str(error), error.near)}")


def _one_source(trace: Path | None, map: Path | None, controller: Controller | None) -> None:
    if map is not None and trace is None and controller is None:
        usage("--map says what the columns of a trace are: name the trace with --trace FILE")
    if trace is not None and controller is not None:
        usage("--trace is what a controller did, --controller what one does now: name one of them")


def _end(report: Report, stopped: "_Stopped | None", lost: bool) -> NoReturn:
    if stopped is not None:
        typer.echo(f"scanbench: {stopped.message}", err=True)
    if report.head.differing:
        raise typer.Exit(1)
    if stopped is None and not report.head.compared:
        usage("nothing of these scans could be compared")
    if stopped is None and report.idle:
        usage(f"{report.head.title} did not run in any of these scans: nothing of it was compared")
    raise typer.Exit(stopped.code if stopped is not None else PARTLY if lost or report.head.partly else 0)


class _Stopped:
    """Why not all scans were verified."""

    def __init__(self, message: str, code: int) -> None:
        self.message, self.code = message, code


def _stretch(text: str) -> tuple[int | None, int | None]:
    """The first and the last scan of `--scans`."""
    if not text:
        return None, None
    match = _STRETCH.fullmatch(text.strip())
    if match is None or text.strip() == "..":
        usage(f"--scans {text}: write A..B, A.. or ..B with numbers of scans; 0..99 are the first hundred")
    first, last = (int(each) if each else None for each in match.group(1, 2))
    if first is not None and last is not None and last < first:
        usage(f"--scans {text}: scan {last} is before scan {first}")
    return first, last


def _verified(
    subject: Subject, wanted: Range, limit: int, first: int | None, last: int | None
) -> tuple[Report, _Stopped | None]:
    """All the scans that are wanted and there."""
    verifier = subject.verifier
    begin, end = verifier.first, verifier.end
    kept = f"{subject.trace or subject.instance} has scans {begin} to {end - 1}"
    if begin >= end:
        usage(f"{subject.trace or subject.instance} has no scan that is over")
    if last is None:
        last = SCANS - 1 if subject.trapped else end - 1
    first = begin if first is None else first
    if not begin <= first < end:
        usage(f"{kept}: scan {first} is none of them")
    unreached = 0
    if last >= end:
        if not subject.trapped:
            usage(f"{kept}: scan {last} is none of them")
        unreached, last = last - end + 1, end - 1
    try:
        begun = verifier.begin(wanted, limit, first)
    except BadRange as error:
        usage(f"--range: {with_near(str(error), error.near)}")
    except Unreadable as error:
        usage(str(error))
    if begun.note:
        typer.echo(f"scanbench: {begun.note}", err=True)
    collected = Collected()
    stopped = _run(subject, collected, first, last)
    head = _head(subject, begun, collected, first, last, stopped, limit)
    return collected.report(replace(head, not_reached=unreached)), stopped


def _run(subject: Subject, collected: Collected, first: int, last: int) -> _Stopped | None:
    of = last - first + 1

    def told() -> str:
        return f"{collected.compared:,} of {of:,} scans, {collected.differing:,} rows differ"

    try:
        with progress(of, lambda: collected.compared, told):
            for scan in range(first, last + 1):
                collected.add(subject.verifier.verify(scan))
    except Unreadable as error:
        return _Stopped(f"verified up to the scan before that only: {error}", 2)
    except KeyboardInterrupt:
        return _Stopped(f"interrupted after {collected.compared:,} scans", INTERRUPTED)
    return None


def _head(
    subject: Subject, begun: Begun, collected: Collected, first: int, last: int, stopped: _Stopped | None, limit: int
) -> ReportHead:  # fmt: skip
    notes = (subject.note, begun.note, "" if stopped is None else f"{stopped.message[0].upper()}{stopped.message[1:]}.")
    return ReportHead(
        project=subject.project, instance=subject.instance, model=subject.model, by=AUTHOR, when=iso(wall_time()),
        version=begun.version, title=begun.title, source=subject.source, first=first,
        last=last if stopped is None or collected.last_scan is None else collected.last_scan,
        compared=collected.compared, skipped=collected.skipped, differing=collected.differing, tool=f"Scanbench {__version__}",
        trace=subject.trace, interval_ns=begun.interval_ns, forgotten=collected.seen - len(collected.rows()),
        limit=limit, full=collected.full, stretches=tuple(collected.stretches[-STRETCHES:]),
        coverage=subject.verifier.coverage, note=" ".join(filter(None, notes)),
        sampled=subject.sampled,
    )  # fmt: skip
