"""A scenario of what people did in a recorded run."""

from collections.abc import Iterable, Iterator, Sequence

from scanbench.faults.inject import Generate, Recover
from scanbench.faults.line_faults import BreakLine, LineStep, MendLine
from scanbench.history.rerun_plan import comes_by_itself
from scanbench.history.scenario import Expectation, Scenario, Step
from scanbench.plcmodel.model import Model
from scanbench.program.types import ELEMENTARY
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.forces import Force, ForceSeveral, Release
from scanbench.runtime.modes import SetMode
from scanbench.runtime.restart import Restart
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.write import Write
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.runtime.write_variables import WriteVariables
from scanbench.symbols.values import format_value


def from_run(
    entries: Iterable[Entry], scans: int, model: Model, expect: Sequence[tuple[str, str]] = (), project: str = "."
) -> Scenario:
    """The steps of a run of so many scans from its cold start; `expect`: what variables are worth at its end. Of what no step can say
    there is a note."""
    steps: list[Step] = []
    notes: list[str] = []
    for entry in entries:
        if comes_by_itself(entry.command) or isinstance(entry.command, SetClock):
            continue
        told = list(_steps(entry.command, model))
        if not told:
            notes.append(f"left out before scan {entry.scan}: {entry.plan.message} ({entry.command.author})")
        if entry.step:
            notes.append(f"before scan {entry.scan}, it was inside of that scan: {entry.plan.message}")
        steps += (Step(entry.scan, each) for each in told)
    held = tuple(Expectation("holds", f"{path} = {value}", scans, scans) for path, value in expect)
    return Scenario(scans, tuple(steps), held, project, tuple(notes))


def _steps(command: Command, model: Model) -> Iterator[str]:
    match command:
        case Write(path=path, value=value):
            yield f"write {path}={value}"
        case Force(path=path, value=value):
            yield f"force {path}={value}"
        case Release(path=str(path)):
            yield f"release {path}"
        case ForceSeveral(changes=changes):
            for change in changes:
                yield from _steps(change, model)
        case Generate(errors=errors):
            for each in errors:
                yield f"raise {each}"
        case Recover(ids=None):
            yield "clear all"
        case Recover(ids=tuple(ids), numbers=()):
            for id in ids:
                yield f"clear {id}"
        case SetMode(mode=mode):
            yield f"mode {mode}"
        case Restart(kind=kind):
            yield f"restart {kind}"
        case BreakLine() | LineStep() | MendLine():
            yield from _of_lines(command)
        case _:
            yield from _of_clients(command, model)


def _of_lines(command: BreakLine | LineStep | MendLine) -> Iterator[str]:
    if isinstance(command, MendLine):
        yield f"mend {command.server}"
    elif isinstance(command, BreakLine):  # a step comes by itself
        fault = command.fault
        late = f" {fault.late_ms}" if fault.kind == "late" else ""
        scans = "" if fault.scans is None else f" for {fault.scans}"
        period = "" if fault.period is None else f" of {fault.period}"
        yield f"break {command.server}={fault.kind}{late}{scans}{period}"


def _of_clients(command: Command, model: Model) -> Iterator[str]:
    """What protocol clients wrote."""
    match command:
        case WriteAreas(writes=writes):
            for write in writes:
                yield from _words(write, model)
        case WriteVariables(writes=several) if all(one.type in ELEMENTARY for one in several):
            for one in several:
                yield f"write {one.path}={format_value(ELEMENTARY[one.type], one.data)}"


def _words(write: AreaWrite, model: Model) -> Iterator[str]:
    """What a protocol client wrote, word by word; of a byte that is no part of a whole word, bit by bit."""
    area = model.area(write.area)
    assert area is not None
    if write.bit is not None:
        yield f"write {model.format(area, write.byte, write.bit, 1)}={'TRUE' if write.data[0] else 'FALSE'}"
        return
    at = 0
    while at < len(write.data):
        byte = write.byte + at
        if byte % 2 == 0 and at + 1 < len(write.data):
            value = int.from_bytes(write.data[at : at + 2], "little")
            yield f"write {model.format(area, byte, None, 16)}=16#{value:04X}"
            at += 2
            continue
        for bit in range(8):
            yield f"write {model.format(area, byte, bit, 1)}={'TRUE' if write.data[at] >> bit & 1 else 'FALSE'}"
        at += 1
