"""`scanbench replay`: a recorded run once more, on this machine: every byte must be the same."""

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path

import typer

from scanbench.check.build import check_sources
from scanbench.cli import INTERRUPTED
from scanbench.cli.inputs import PARTLY, find_model_named, unusable_run, usage
from scanbench.cli.outputs import must_be_writable, write_text
from scanbench.cli.progress import progress
from scanbench.cli.run import ENGINES, EngineChoice
from scanbench.engines.pair import Differs
from scanbench.host.run_files import sources_in
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.gaps import LostScans
from scanbench.recording.reader import Unreadable
from scanbench.recording.replay import Diverged
from scanbench.recording.replay_file import Replayed, replay_file
from scanbench.reports.junit import Case
from scanbench.reports.junit import junit as junit_text
from scanbench.runtime.programs import EngineFactory, Loaded, LoadedPrograms
from scanbench.wire.codec import ENTRIES

_SAME = "the run comes out as it was recorded"


def replay(
    path: Path = typer.Argument(metavar="RUNFILE", help="A run as the bench exports it (.scanrun), or --record wrote it."),
    scans: int | None = typer.Option(None, min=0, metavar="N", help="Stop before scan N; else at the end of the run."),
    engine: EngineChoice = typer.Option(EngineChoice.NATIVE, help="both: compare the engines after every scan too."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
    junit: Path | None = typer.Option(None, metavar="FILE", help="Write a JUnit report too: that the run came out as it was recorded, and that all of it is there."),
) -> None:  # fmt: skip
    """Replay a run and compare it with every checkpoint in it.

    Exit 0 when every byte was the same; 2: wrong usage, or a file that cannot be replayed here; 3: it came out different;
    4: the file is damaged, and all that can still be read was the same; 130: interrupted, the same so far.
    """

    must_be_writable(junit)

    def programs_of(kept: Mapping[int, KeptProgram]) -> LoadedPrograms:
        return LoadedPrograms(*(load_kept(each, ENGINES[engine]) for each in kept.values()))

    agreed: list[int] = []
    try:
        with progress(0, lambda: 0, lambda: _so_far(agreed)):
            result = replay_file(path, programs_of, ENTRIES, scans, agreed.append)
    except KeyboardInterrupt:
        typer.echo(f"scanbench: {path}: interrupted: {_so_far(agreed)}", err=True)
        raise typer.Exit(INTERRUPTED) from None
    except Unreadable as error:
        unusable_run(path, error)
    except (Diverged, Differs) as difference:
        if junit is not None:
            write_text(junit, junit_text(path.name, (Case("replay", _SAME, "failure", str(difference), "difference"),)))
        typer.echo(f"scanbench: {path}: {difference}", err=True)
        raise typer.Exit(3) from None
    if junit is not None:
        write_text(junit, junit_text(path.name, _cases(result)))
    typer.echo(json.dumps(asdict(result)) if as_json else _text(result))
    if result.damaged:
        typer.echo(f"scanbench: {path}: {result.damage}", err=True)
        raise typer.Exit(PARTLY)


def load_kept(kept: KeptProgram, engine_factory: EngineFactory) -> Loaded:
    """A program of a run file, ready to run; one that does not compile here ends the command."""
    sources = sources_in(kept)
    checked = check_sources(sources.files, find_model_named(sources.model), sources.interval_ns)
    if checked.program is None:
        usage(f"program version {kept.version} of the run does not compile here: {checked.problems[0]}")
    return Loaded.make(checked.program, engine_factory, kept.version)


def _so_far(agreed: list[int]) -> str:
    if not agreed:
        return "nothing was compared yet"
    return f"the same up to scan {agreed[-1]}, in {len(agreed)} checkpoint{'s' * (len(agreed) != 1)}"


def _text(result: Replayed) -> str:
    lines = [
        f"begun by {result.by}, {result.created}",
        f"scans {result.first_scan} to {result.scan}: {result.entries} commands, "
        f"{result.checkpoints} checkpoints, {'what is left of it is' if result.damaged else 'all'} the same",
        f"state {result.hash}",
    ]
    lines[1:1] = [f"lost  {_stretch(each)}" for each in result.gaps]
    if result.damage and not result.damaged:
        lines.append(f"note: {result.damage}")
    return "\n".join(lines)


def _cases(result: Replayed) -> tuple[Case, Case]:
    """For a build server: what is there was the same, and is all of it there?"""
    text, name = _text(result), "all of the run is there"
    whole = Case("replay", name, "error", result.damage, "damaged", text) if result.damaged else Case("replay", name)
    return Case("replay", _SAME, text=text), whole


def _stretch(gap: LostScans) -> str:
    if gap.first == gap.until:
        return f"commands before scan {gap.first}"
    return f"scans {gap.first} to {gap.until - 1}"
