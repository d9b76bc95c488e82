"""`scanbench campaign`: many random disturbances, each tried alone on a run, and who noticed them."""

import json
import re
import shutil
import tempfile
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import NoReturn

import typer

from scanbench.cli import INTERRUPTED
from scanbench.cli.inputs import unusable_run, usage
from scanbench.cli.interrupt import Leaving
from scanbench.cli.outputs import must_be_writable, write_text
from scanbench.cli.progress import progress
from scanbench.cli.run_options import Options
from scanbench.cli.verify_subject import Given, is_run, program_of, ran
from scanbench.engines.available import flavours
from scanbench.faults.agenda import agenda_of_faults
from scanbench.history.bench import Bench
from scanbench.history.campaign.contract import KINDS, BadCampaign, Campaign, CampaignWanted, Trial
from scanbench.history.campaign.trials import Trials
from scanbench.host.run_files import programs_by, texts_in
from scanbench.recording.programs import on
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.reports.campaign_report import CampaignReport, campaign_json, campaign_junit, campaign_text, trial_text
from scanbench.wire.codec import ENTRIES

SCANS = 500
"""That a project runs when nobody says how many."""
_STRETCH = re.compile(r"(\d*)\.\.(\d*)")


class Kinds(StrEnum):
    """Kinds of disturbances."""

    FLIP = "flip"
    RESULT = "result"
    STUCK = "stuck"
    LATE = "late"


class Required(StrEnum):
    """Who has to notice a disturbance."""

    ANY = "any"
    PROGRAM = "program"


def campaign(
    path: Path = typer.Argument(metavar="PROJECT|RUNFILE", help="A folder with a program, a program file, or a recorded run."),
    count: int = typer.Option(100, metavar="N", help="So many disturbances."),
    seed: int = typer.Option(1, metavar="N", help="The same seed gives the same disturbances."),
    scans: str = typer.Option("", metavar="A..B", help="They come in these scans; else in all of the run. A project runs up to B, else 500 scans."),
    window: int = typer.Option(100, metavar="N", help="Scans that the program gets to notice each."),
    kind: list[Kinds] = typer.Option(list(Kinds), help="Only these kinds; may be given several times."),
    alarm: list[str] = typer.Option([], metavar="CONDITION", help="It says that the program has noticed something, as Main.alarm; may be given several times."),
    require: Required = typer.Option(Required.ANY, help="Who has to notice: any, or the program wherever an output became wrong."),
    allow: int = typer.Option(0, min=0, metavar="N", help="So many of those that were not noticed are let pass."),
    only: list[int] = typer.Option([], metavar="N", help="Only the disturbance with this number; may be given several times."),
    record: Path | None = typer.Option(None, metavar="FILE", help="With one --only: keep the disturbed run, for the bench (Import) or `verify`."),
    model: str | None = typer.Option(None, metavar="NAME", help="PLC model of a project; else its own, else GENERIC-IEC."),
    interval: str = typer.Option("10ms", help="Of a project: task interval if no CONFIGURATION sets one."),
    set: list[str] = typer.Option([], "--set", metavar="PATH=VALUE[@SCAN]", help="Of a project: write before a scan, as with `run`."),
    force: list[str] = typer.Option([], "--force", metavar="PATH=VALUE[@SCAN]", help="Of a project: force from a scan on."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
    junit: Path | None = typer.Option(None, metavar="FILE", help="Write a JUnit report too: a test case for each disturbance."),
) -> None:  # fmt: skip
    """Try many random disturbances, each alone, and find out whether the verification notices them, the program, or nobody.

    Exit 0: all that had an effect were noticed as --require says, but for --allow; 1: one more was not; 2: wrong usage, or none came about;
    130: interrupted, no finding so far.
    """
    must_be_writable(junit, record)
    if record is not None and len(only) != 1:
        usage("--record keeps the run of one disturbance: name its number with --only")
    first, last = _stretch(scans)
    given = Given(
        path, model, interval, Options(set, force, [], [], [], []), SCANS if last is None else last + 1, None, None
    )
    kinds = tuple(each for each in KINDS if each in kind)
    wanted = CampaignWanted(
        seed, count, -1 if first is None else first, -1 if last is None else last, window, kinds, tuple(alarm)
    )
    numbers = only or range(1, count + 1)
    done, plc = _run(given, wanted, numbers, record)
    report = CampaignReport(path.resolve().stem, plc, done, len(numbers), require.value, allow)
    _tell(report, as_json, bool(only), junit)


def _run(given: Given, wanted: CampaignWanted, numbers: list[int] | range, record: Path | None) -> tuple[Campaign, str]:
    """What came of it, and the name of the model."""
    with tempfile.TemporaryDirectory() as folder:
        run = given.path if is_run(given.path) else Path(folder, "base.run")
        if run is not given.path:
            ran(given, run)
        try:
            with RunReader(run, programs_by(program_of, on(Leaving(flavours()))), ENTRIES) as reader:
                reader.follow()
                first = reader.first if wanted.first < 0 else wanted.first
                last = max(first, reader.over - 1) if wanted.last < 0 else wanted.last
                wanted = replace(wanted, first=first, last=last)
                trials = Trials(reader, wanted, _bench(reader, Path(folder)))
                done = _tried(trials, numbers)
                model = reader.recording.about.model
        except Unreadable as error:
            unusable_run(given.path, error)
        except BadCampaign as error:
            usage(str(error))
        if record is not None and done:
            shutil.copy(trials.file, record)
    return Campaign(wanted, tuple(done)), model


def _bench(reader: RunReader, folder: Path) -> Bench:
    make = programs_by(program_of, on(Leaving(flavours())))
    observed = flavours().observed
    return Bench(folder, ENTRIES, make(reader.kept), make(reader.kept), lambda: agenda_of_faults(observed), texts_in)


def _tried(trials: Trials, numbers: list[int] | range) -> list[Trial]:
    """Those that were tried: after Ctrl-C some are not."""
    done: list[Trial] = []
    of = len(numbers)
    try:
        with progress(of, lambda: len(done), lambda: f"{len(done):,} of {of:,} disturbances"):
            for number in numbers:
                done.append(trials.trial(number))
    except KeyboardInterrupt:
        return done
    return done


def _tell(report: CampaignReport, as_json: bool, every: bool, junit: Path | None) -> NoReturn:
    if as_json:
        typer.echo(json.dumps(campaign_json(report), ensure_ascii=False))
    else:
        lines = campaign_text(report)
        shown = report.campaign.trials if every else ()
        typer.echo(
            "\n".join([*lines, *(line for each in shown if each not in report.findings for line in trial_text(each))])
        )
    if junit is not None:
        write_text(junit, campaign_junit(report))
    if report.failed:
        raise typer.Exit(1)
    if not report.whole:
        typer.echo(f"scanbench: interrupted after {len(report.campaign.trials)} disturbances", err=True)
        raise typer.Exit(INTERRUPTED)
    if all(each.outcome == "missed" for each in report.campaign.trials):
        usage("none of the disturbances came about")
    raise typer.Exit(0)


def _stretch(text: str) -> tuple[int | None, int | None]:
    if not text:
        return None, None
    match = _STRETCH.fullmatch(text.strip())
    if match is None or text.strip() == "..":
        usage(f"--scans {text}: write A..B, A.. or ..B with numbers of scans; 0..99 are the first hundred")
    first, last = (int(each) if each else None for each in match.group(1, 2))
    return first, last
