"""`scanbench errors present`, `log` and `clear`: what a PLC's own memory says of its errors, as any tool reads it.

Of a PLC of a running server, or of a recorded run at a scan.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

import typer

from scanbench.cli.inputs import unusable_run, usage
from scanbench.client import Plc, Refused, connect
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.faults.device import read_device
from scanbench.host.run_files import programs_by
from scanbench.jobs.starting import checked_program, model_of
from scanbench.program.program import Program
from scanbench.recording.programs import observed
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.reports.sweep_report import table
from scanbench.runtime.inside import front
from scanbench.testing.said import with_near
from scanbench.wire.codec import ENTRIES
from scanbench.wire.host import Sources

ADDRESS = "http://127.0.0.1:8700"
_PLC = typer.Argument("", metavar="[PLC]", help="Name or number of a PLC of a running server.", show_default=False)
_SERVER = typer.Option(
    ADDRESS, metavar="URL", envvar="SCANBENCH_SERVER", help="The address that `serve` prints, with its token."
)
_RUN = typer.Option(None, metavar="FILE", help="A recorded run in place of a PLC.")
_SCAN = typer.Option(None, min=0, metavar="N", help="With --run: as it was before scan N, else at the end.")
_JSON = typer.Option(False, "--json", help="Print one JSON object.")
Told = Mapping[str, object]


def present(
    plc: str = _PLC, server: str = _SERVER, run: Path | None = _RUN, scan: int | None = _SCAN, as_json: bool = _JSON
) -> None:
    """List the errors that the PLC's memory shows as present, and messages of its program.

    Exit 0: there are none; 1: there are some; 2: wrong usage, or the PLC cannot be read.
    """
    device = _device(plc, server, run, scan)
    errors, messages = _objects(device, "errors"), _objects(device, "messages")
    if as_json:
        typer.echo(
            json.dumps(
                {key: device[key] for key in ("scan", "code", "standby", "errors", "messages")}, ensure_ascii=False
            )
        )
    elif errors:
        rows: list[tuple[str, ...]] = [("CODE", "SEVERITY", "ERROR", "NAME", "DETAILS", "TEXT")]
        rows += [
            (str(each["code"] or "-"), *_texts(each, "severity", "id", "name"), _details(each), str(each["text"]))
            for each in errors
        ]
        typer.echo("\n".join(table(rows)))
    else:
        typer.echo("no error is present")
    if not as_json:
        for each in messages:
            typer.echo(f"{each['instruction']} {each['number']}: {each['text']}")
        standby = device["standby"]
        if isinstance(standby, dict):
            typer.echo(_standby_text(standby))
    raise typer.Exit(1 if errors else 0)


def _standby_text(standby: Mapping[str, object]) -> str:
    """Which CPU Unit of a device with two controls, and why."""
    running = "duplex" if standby["duplex"] else "simplex"
    causes = standby["causes"]
    why = (
        f"; the standby took over at {standby['time']}: {', '.join(causes)}"
        if isinstance(causes, list) and causes
        else ""
    )
    return f"{running}: the {standby['side']} CPU Unit controls{why}"


def log(
    plc: str = _PLC, server: str = _SERVER, run: Path | None = _RUN, scan: int | None = _SCAN, as_json: bool = _JSON
) -> None:
    """List the PLC's own error log, the newest record first. Exit 2: wrong usage, or the PLC cannot be read."""
    device = _device(plc, server, run, scan)
    records = _objects(device, "log")
    if as_json:
        typer.echo(json.dumps({"scan": device["scan"], "log": records}, ensure_ascii=False))
        return
    if not device["has_log"] and not device["keeps_latest"]:
        typer.echo("this model has no error log in its memory")
        return
    rows: list[tuple[str, ...]] = [("TIME", "CODE", "ERROR", "NAME", "DETAILS", "TEXT")]
    for each in records:
        rows.append((*_texts(each, "time", "code", "id", "name"), _details(each), str(each["text"])))
    typer.echo("\n".join(table(rows)) if records else "the error log is empty")


def clear(
    plc: str = typer.Argument(metavar="PLC", help="Name or number of a PLC of a running server."),
    server: str = _SERVER,
    code: str = typer.Option("", metavar="CODE", help="Clear the error with this code, as the device shows it."),
    every: bool = typer.Option(False, "--all", help="Clear all errors; else the most serious one."),
    error_log: bool = typer.Option(False, "--log", help="Empty the error log, and clear no error."),
) -> None:
    """Clear errors as a tool does it on the device (FINS 2101), or its error log (FINS 2103).

    An error whose cause is still there is not cleared. Exit 2: refused, or wrong usage.
    """
    if sum((bool(code), every, error_log)) > 1:
        usage("give one of --code, --all and --log")
    found = _plc(plc, server)
    try:
        if error_log:
            typer.echo(found.clear_log())
        else:
            typer.echo(found.clear(_code(found, code) if code else "all" if every else "current"))
    except Refused as refusal:
        usage(with_near(str(refusal), refusal.near))


def _code(plc: Plc, text: str) -> int:
    """A code in the notation of the device."""
    try:
        return int(text, 10 if plc.device["codes"] == "decimal" else 16)
    except ValueError:
        usage(f"{text} is no error code")


def _device(plc: str, server: str, run: Path | None, scan: int | None) -> Told:
    if run is None:
        if scan is not None:
            usage("--scan goes with --run; what a PLC shows is what everybody sees now")
        if not plc:
            usage("name a PLC of the server, or a recorded run: --run FILE")
        try:
            return _plc(plc, server).device
        except Refused as refusal:
            usage(with_near(str(refusal), refusal.near))
        except OSError as error:
            usage(f"{server} does not answer: {error}")
    if plc:
        usage("name a PLC, or give --run, not both")
    try:
        return _recorded(run, scan)
    except Unreadable as error:
        unusable_run(run, error)


def _plc(name: str, server: str) -> Plc:
    try:
        return connect(server, user="command line").plc(int(name) if name.isdigit() else name)
    except Refused as refusal:
        usage(with_near(str(refusal), refusal.near))
    except OSError as error:
        usage(
            f"{server} does not answer: {error}. Start one with `scanbench serve`, and give its address: --server URL"
        )


def _recorded(run: Path, scan: int | None) -> Told:
    def program_of(sources: Sources) -> Program:
        return checked_program(sources, model_of(sources))

    with RunReader(run, programs_by(program_of, observed(observed_engine)), ENTRIES) as reader:
        reader.follow()
        until = reader.end if scan is None else scan
        if not reader.first <= until <= reader.end:
            raise Unreadable(f"it has scans {reader.first} to {reader.end}: scan {until} is none of them")
        entries = front([each for each in reader.entries if each.scan <= until], until)
        device = read_device(reader.at(until, entries).view, past=until < reader.end)
    found: dict[str, object] = json.loads(json.dumps(asdict(device)))
    return found


def _objects(device: Told, key: str) -> Sequence[Told]:
    found = device[key]
    assert isinstance(found, list)
    return [each for each in found if isinstance(each, dict)]


def _texts(of: Told, *keys: str) -> tuple[str, ...]:
    return tuple(str(of[key]) or "-" for key in keys)


def _details(of: Told) -> str:
    return ", ".join(str(each["text"]) for each in _objects(of, "details")) or "-"
