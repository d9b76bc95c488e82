"""`scanbench diff`: two recorded runs, compared: where they differ first, and why."""

import json
from dataclasses import asdict
from pathlib import Path

import typer

from scanbench.cli.inputs import PARTLY, find_model_named, tell_damage, unreadable, unusable
from scanbench.cli.interrupt import Leaving
from scanbench.cli.outputs import must_be_writable, write_text
from scanbench.engines.available import flavours
from scanbench.history.contract import Change, Divergence
from scanbench.history.divergence import find_divergence
from scanbench.host.run_files import sources_in, texts_in
from scanbench.jobs.starting import checked_program
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.programs import on, programs_of
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.reports.junit import Case
from scanbench.reports.junit import junit as junit_text
from scanbench.runtime.programs import NoProgram
from scanbench.testing.said import with_near
from scanbench.wire.codec import ENTRIES

_SHOWN = 40
"""Variables, and commands, that are printed; `--json` has all of them."""


def diff(
    run1: Path = typer.Argument(metavar="RUN1", help="A run as the bench exports it (.scanrun), or `run --record` wrote it: A."),
    run2: Path = typer.Argument(metavar="RUN2", help="The run that it is compared with: B."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
    junit: Path | None = typer.Option(None, metavar="FILE", help="Write a JUnit report too: that the runs are the same, and that all was compared."),
) -> None:  # fmt: skip
    """Compare two runs scan by scan: the first scan after which anything differs, and what.

    Exit 0: the same, as far as both go; 1: different; 2: wrong usage, files that cannot be compared here, or programs
    without a common variable; 4: the same in what could be compared, but not everything could: a variable is only in one
    of them or has another type, or a file is damaged, and a part of its run is lost.
    """
    must_be_writable(junit)
    of = programs_of(_Checked().program, on(Leaving(flavours())))
    try:
        with RunReader(run1, of, ENTRIES, texts_in) as one, RunReader(run2, of, ENTRIES, texts_in) as other:
            one.follow()
            lost = [tell_damage(run1, one.recording)]
            other.follow()
            lost.append(tell_damage(run2, other.recording))
            found = find_divergence(one, other)
    except Unreadable as error:
        if isinstance(error.__cause__, OSError) and error.__cause__.filename:
            unreadable(Path(error.__cause__.filename), error.__cause__)
        unusable(with_near(str(error), error.near), error.__cause__)
    typer.echo(json.dumps(_data(found)) if as_json else "\n".join(_text(found)))
    if junit is not None:
        write_text(junit, junit_text(f"{run1.name} and {run2.name}", _cases(found, any(lost))))
    if found.scan is not None:
        raise typer.Exit(1)
    if found.same == "nothing":
        raise typer.Exit(2)
    raise typer.Exit(PARTLY if any(lost) or found.same == "partly" else 0)


class _Checked:
    """Programs that both runs have are checked once."""

    def __init__(self) -> None:
        self._known: dict[bytes, Program] = {}

    def program(self, kept: KeptProgram) -> Program:
        """The program that was kept."""
        if kept.sources not in self._known:
            sources = sources_in(kept)
            try:
                self._known[kept.sources] = checked_program(sources, find_model_named(sources.model))
            except NoProgram as error:
                raise NoProgram(f"program version {kept.version} of the run does not compile here: {error}") from error
        return self._known[kept.sources]


def _data(found: Divergence) -> dict[str, object]:
    """As JSON: bytes of values are hex, entries and marks have names."""
    data: dict[str, object] = asdict(found)
    data["changes"] = [] if found.changes is None else [_change(each) for each in found.changes.changes]
    data["count"] = 0 if found.changes is None else found.changes.count
    data["at_least"] = found.changes is not None and found.changes.at_least
    data["note"] = "" if found.changes is None else found.changes.note
    data["marks"] = [{"first": first, "last": last} for first, last in found.marks]
    return data


def _change(change: Change) -> dict[str, object]:
    return {
        "path": change.path,
        "type": change.type,
        "a": change.before_shown,
        "b": change.after_shown,
        "a_bytes": change.before.hex(),
        "b_bytes": change.after.hex(),
    }


def _text(found: Divergence) -> list[str]:
    lines = [found.text[:1].upper() + found.text[1:]]
    if found.scan is not None:
        lines.append(f"scan       {found.scan} (scans {found.first} to {found.last} were compared)")
    place = found.place
    if place is not None:
        lines += [f"task       {place.task}", f"instance   {place.instance}", f"line       {place.file}:{place.line}"]
        lines += [f"           {place.text}"] * bool(place.text)
    changes = found.changes
    if changes is not None and changes.changes:
        lines += [
            "",
            f"{'at least ' * changes.at_least}{changes.count:,} variable{'s' * (changes.count != 1)} differ{'s' * (changes.count == 1)} after it:",
        ]
        lines += _table(
            [
                ("variable", "A", "B"),
                *((each.path, each.before_shown, each.after_shown) for each in changes.changes[:_SHOWN]),
            ]
        )
        lines += [f"... and {changes.count - _SHOWN:,} more"] * (changes.count > _SHOWN)
        lines += [changes.note] * bool(changes.note)
    if found.left:
        lines += ["", "Not compared:"]
        lines += [f"  {each.path}: {each.reason}" if each.path else f"  {each.reason}" for each in found.left[:_SHOWN]]
        lines += [f"... and {found.left_count - _SHOWN:,} more"] * (found.left_count > _SHOWN)
    if found.entries:
        lines += ["", "Entered in one of them only:"]
        lines += [f"  {each.run}  scan {each.scan}  {each.author}: {each.text}" for each in found.entries[:_SHOWN]]
        lines += [f"... and {len(found.entries) - _SHOWN:,} more"] * (len(found.entries) > _SHOWN)
    if found.marks:
        stretches = ", ".join(str(first) if first == last else f"{first} to {last}" for first, last in found.marks[:10])
        more = f" and {len(found.marks) - 10} more stretches" if len(found.marks) > 10 else ""
        lines += ["", f"They differ after scans {stretches}{more}"]
    return lines


def _cases(found: Divergence, lost: bool) -> tuple[Case, Case]:
    """For a build server: is it the same, and was all of it compared?"""
    text = "\n".join(_text(found))
    same = Case("diff", "the runs are the same", text=text)
    if found.scan is not None:
        same = Case("diff", same.name, "failure", f"after scan {found.scan}: {found.text}", found.cause, text)
    elif found.same == "nothing" or lost:
        same = Case("diff", same.name, "skipped", found.text)
    why = [found.text] * (found.same in ("nothing", "partly"))
    why += ["a file is damaged, and a part of its run is lost"] * lost
    whole = Case("diff", "all of both runs is compared")
    return same, Case("diff", whole.name, "error", ". ".join(why), "not_compared", text) if why else whole


def _table(rows: list[tuple[str, str, str]]) -> list[str]:
    widths = [max(len(row[at]) for row in rows) for at in range(2)]
    return [f"  {path:<{widths[0]}}  {one:<{widths[1]}}  {other}".rstrip() for path, one, other in rows]
