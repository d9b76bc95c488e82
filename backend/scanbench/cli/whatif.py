"""`scanbench whatif`: a recorded run with other values of some inputs, from a scan on."""

import json
import tempfile
from dataclasses import asdict
from pathlib import Path

import typer

from scanbench.cli.inputs import unusable_run, usage
from scanbench.cli.outputs import must_be_writable, write_text
from scanbench.cli.progress import progress
from scanbench.cli.verify_subject import program_of
from scanbench.engines.available import flavours
from scanbench.faults.agenda import agenda_of_faults
from scanbench.history.bench import Bench
from scanbench.history.whatif.contract import MOST_TRIES, BadWhatIf, SetValue, Try, WhatIf, WhatIfWanted
from scanbench.history.whatif.tries import what_if
from scanbench.host.run_files import programs_by, texts_in
from scanbench.recording.programs import on
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.wire.codec import ENTRIES


def whatif(
    run: Path = typer.Argument(metavar="RUNFILE", help="A recorded run, as of `run --record` or *Export*."),
    scan: int = typer.Option(metavar="N", help="The values are set before this scan."),
    set: list[str] = typer.Option([], "--set", metavar="PATH=VALUE", help="In every try; may be given several times."),
    vary: str = typer.Option("", metavar="PATH=VALUE,VALUE,...", help="Try each of these values, or A..B or A..B/STEP of whole numbers."),
    change: list[str] = typer.Option([], metavar="PATH", help="Look for the smallest change of these with which --condition holds; may be given several times."),
    condition: str = typer.Option("", metavar="CONDITION", help="What is to be after one of the scans, as 'Main.valve = 3'."),
    scans: int = typer.Option(100, metavar="N", help="Run so many scans, that one the first of them."),
    once: bool = typer.Option(False, help="Write the values once; else they are forced all the time."),
    watch: list[str] = typer.Option([], "--print", metavar="PATH", help="Tell the value of this at the end; may be given several times."),
    test: Path | None = typer.Option(None, metavar="FILE", help="Write a scenario file that does the same and expects the condition."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
) -> None:  # fmt: skip
    """Go on with a recorded run from a scan with other values of some inputs, and compare.

    Exit 0: the condition was met in a try, or none was given; 1: it was not; 2: wrong usage, or a run that cannot be used.
    """
    if test is not None:
        must_be_writable(test)
    path, _, tried = vary.partition("=")
    wanted = WhatIfWanted(
        scan, tuple(map(_value, set)), path.strip(), tuple(filter(None, (each.strip() for each in tried.split(",")))) if vary else (), bool(change), tuple(change), not once, scans,
        condition, tuple(watch),
    )  # fmt: skip
    found = _found(run, wanted)
    typer.echo(json.dumps(asdict(found), ensure_ascii=False) if as_json else "\n".join(_lines(found)))
    if test is not None:
        if not found.scenario:
            usage("no test was made: no try met the condition, or the run does not begin with scan 0")
        write_text(test, found.scenario)
    met = any(each.met is not None for each in found.tries)
    raise typer.Exit(1 if condition and not met else 0)


def _found(run: Path, wanted: WhatIfWanted) -> WhatIf:
    observed, done = flavours().observed, 0

    def on_try(count: int, of: int) -> None:
        nonlocal done
        done = count

    most = MOST_TRIES if wanted.search else max(1, len(wanted.tried))
    with tempfile.TemporaryDirectory() as folder:
        try:
            with RunReader(run, programs_by(program_of, on(flavours())), ENTRIES) as reader:
                reader.follow()
                programs = programs_by(program_of, on(flavours()))(reader.kept)
                bench = Bench(Path(folder), ENTRIES, programs, programs, lambda: agenda_of_faults(observed), texts_in)
                with progress(most, lambda: done, lambda: f"{done:,} tries"):
                    return what_if(reader, wanted, bench, on_try)
        except Unreadable as error:
            unusable_run(run, error)
        except BadWhatIf as error:
            usage(str(error))


def _value(text: str) -> SetValue:
    path, equals, value = text.partition("=")
    if not equals or not path.strip():
        usage(f"--set {text}: write PATH=VALUE")
    return SetValue(path.strip(), value.strip())


def _lines(found: WhatIf) -> list[str]:
    lines = [f"as recorded: {_outcome(found, found.recorded, False)}"]
    if found.undisturbed is not None:
        lines.append(f"without the disturbances: {_outcome(found, found.undisturbed)}")
    for at, each in enumerate(found.tries):
        values = ", ".join(f"{one.path} = {one.value}" for one in each.values)
        lines.append(f"{'* ' if at == found.best else ''}{values}: {_outcome(found, each)}")
    return [*lines, *filter(None, [found.note])]


def _outcome(found: WhatIf, tried: Try, beside: bool = True) -> str:
    """`beside` the recorded run."""
    if tried.refused and not tried.ran:
        return f"not tried: {'; '.join(tried.refused)}"
    said = []
    if found.wanted.condition:
        said.append("not met" if tried.met is None else f"met after scan {tried.met}")
    if beside:
        differs = tried.output_scan
        if differs is not None:
            said.append(f"an output differs from scan {differs} on")
        elif tried.compared:
            said.append(
                "outputs as recorded"
                if tried.compared == tried.ran
                else f"outputs as recorded in {tried.compared} scans"
            )
    said += [f"{path} = {value}" for path, value in zip(found.wanted.watch, tried.shown, strict=False)]
    if tried.trapped:
        said.append(f"run-time error in {tried.trapped}")
    said += [f"not taken {each}" for each in tried.refused]
    return "; ".join(said)
