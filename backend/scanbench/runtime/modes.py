"""SetMode, and what starting and stopping do to memory. What a mode permits is in `rights.py`."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from scanbench.program.layout import Layout
from scanbench.runtime.command import Category, Command, Patch, Plan, Refusal, View
from scanbench.runtime.forces import forced_table
from scanbench.runtime.header import Halt, Mode


@dataclass(frozen=True, slots=True)
class SetMode(Command):
    """PROGRAM: the program does not run. MONITOR: it runs, tools may write. RUN: it runs, tools may only look."""

    category: ClassVar[Category] = "mode"

    mode: str

    def plan(self, view: View) -> Plan | Refusal:
        """The mode byte; between PROGRAM and the others also memory, outputs, and the trap that PROGRAM ends."""
        if self.mode not in Mode.__members__:
            return Refusal(f"{self.mode} is not a mode", tuple(Mode.__members__))
        mode, header = Mode[self.mode], view.header
        if mode is header.mode and not header.halt:
            return Plan((), f"already in {mode.name}")
        patch = Patch.whole(Layout.MODE, bytes((mode,)))
        if mode is Mode.PROGRAM:
            halt = Patch.whole(Layout.FATAL, bytes((header.halt & ~Halt.TRAP,)))
            return Plan((patch, halt, *stopped(view)), "mode PROGRAM: the program is stopped")
        if header.halt & Halt.FATAL_ERROR:
            return Refusal(f"cannot run in {mode.name}: a fatal error is present. Recover it, then set {mode.name}")
        if header.halt & Halt.TRAP:
            return Refusal(
                f"cannot run in {mode.name}: the program stopped by a run-time error. "
                "Correct it and build, or restart, or change to PROGRAM first"
            )
        if header.mode is Mode.PROGRAM:
            return Plan((patch, *volatile_cleared(view), *started(view)), f"mode {mode.name}: the program runs")
        return Plan((patch,), f"mode {mode.name}: the program goes on")


def started(view: View) -> tuple[Patch, Patch]:
    """The patches that make the next scan the program's first one."""
    header = view.header
    return (
        Patch.whole(Layout.STARTED, header.scan.to_bytes(8, "little")),
        Patch.whole(Layout.STARTED_AT, header.next_clock_ns(view.program.interval_ns).to_bytes(8, "little")),
    )


def stopped(view: View) -> tuple[Patch, ...]:
    """What a change to PROGRAM does to memory: volatile areas and outputs go to 0, unless the hold bit is on."""
    if held(view):
        return ()
    return (*volatile_cleared(view), *outputs_off(view), *_forced_values(view))


def volatile_cleared(view: View) -> tuple[Patch, ...]:
    """Clears what the device clears when its program starts or stops; nothing while the model's hold bit is on.

    Input words stay: they are what is wired to the PLC, and the device would read them again at once. What is forced
    keeps its value.
    """
    if held(view):
        return ()
    areas = view.program.layout.areas
    zeros = tuple(
        Patch.whole(areas[area.name] + 2 * first, bytes(2 * (end - first)))
        for area in view.model.fatal.cleared
        for first, end in _between(0, area.words, _inputs(view, area.name))
    )
    return (*zeros, *_forced_values(view)) if zeros else ()


def outputs_off(view: View) -> tuple[Patch, ...]:
    """Patches that switch every output off in memory, as the model does when its program stops; none while its hold bit is on.

    At a fatal error and a trap what is wired to them goes off in any case: the state of the PLC says it, as there is no
    other memory that could.
    """
    if held(view):
        return ()
    areas = view.program.layout.areas
    return tuple(
        Patch.whole(areas[words.area.name] + 2 * words.first, bytes(2 * (words.last - words.first + 1)))
        for words in view.model.fatal.outputs
    )


def held(view: View) -> bool:
    """Whether the model's hold bit is on: its memory, that of outputs too, survives a start, a stop, and a fatal error."""
    hold = view.model.fatal.hold
    if hold is None or hold.bit is None:
        return False
    return bool(view.memory[view.program.layout.areas[hold.area.name] + hold.byte] >> hold.bit & 1)


def _forced_values(view: View) -> tuple[Patch, ...]:
    """The force table does not act while nothing runs, so a patch has to."""
    table = forced_table(view)
    return tuple(Patch(offset, bytes((mask,)), bytes((value,))) for offset, (mask, value) in sorted(table.items()))


def _inputs(view: View, area: str) -> list[tuple[int, int]]:
    """The words of an area that are inputs: (first, after the last), ascending."""
    maps = (each for each in view.model.iec_maps if each.letter == "I" and each.area.name == area)
    return sorted((each.first, each.first + each.words) for each in maps)


def _between(first: int, end: int, holes: list[tuple[int, int]]) -> Iterator[tuple[int, int]]:
    """The parts of first..end that are in no hole."""
    for start, after in holes:
        if start > first:
            yield first, min(start, end)
        first = max(first, after)
    if first < end:
        yield first, end
