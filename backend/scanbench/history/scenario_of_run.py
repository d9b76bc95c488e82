"""The scenario of a recorded run up to a scan: what people did, and what the outputs are there."""

from collections.abc import Sequence
from dataclasses import replace

from scanbench.history.scenario import Scenario
from scanbench.history.scenario_steps import from_run
from scanbench.program.program import Program
from scanbench.program.types import Elementary
from scanbench.recording.gaps import gap_between
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.symbols.rack import INPUT, OUTPUT, terminals
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.symbols.whole import worth_text

NOTHING = "Nothing is expected: the program has no variable at an output. Write what is to hold below `expect:`."
"""A comment in the file: a test without it would pass whatever the program does."""
_EXPECTED = 50
"""Outputs that are looked at."""


def scenario_of(
    reader: RunReader, scan: int, expect: Sequence[str] | None = None, project: str = "."
) -> Scenario:  # fmt: skip
    """What people did up to a scan. What these variables are there is expected again, none if there are
    none; without `expect` what the outputs are. `Unreadable`."""
    if reader.first:
        raise Unreadable(f"the run begins with scan {reader.first}, and a scenario with a cold start: begin a new run")
    if scan > reader.end:
        raise Unreadable(f"scan {scan} has not come yet: the run ends at scan {reader.end}")
    gap = gap_between(reader.recording.gaps, 0, scan)
    if gap is not None:
        raise Unreadable(f"not all that was entered before scan {scan} is known: {gap}")
    plc = reader.at(scan)
    try:
        wanted = (
            _outputs(plc.program)[:_EXPECTED] if expect is None else [resolve(plc.program, each) for each in expect]
        )
    except UnknownPath as error:
        raise Unreadable(error.message, tuple(error.near)) from None
    told = [(each.path, worth_text(plc.program, plc.memory, each)) for each in wanted]
    entries = [each for each in reader.entries if each.scan < scan]
    made = from_run(entries, scan, plc.program.layout.model, told, project)
    return made if made.expect or expect == [] else replace(made, notes=(*made.notes, NOTHING))


def _outputs(program: Program) -> list[Symbol]:
    """The variables that the program has in its words of outputs."""
    found: list[Symbol] = []
    output = False
    for each in terminals(program):
        if each.section in (INPUT, OUTPUT):
            output = each.section == OUTPUT
        elif output and each.address != each.path and isinstance(each.type, Elementary):
            found.append(each)
    return found
