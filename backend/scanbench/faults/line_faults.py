"""Faults of communication: what is wrong with the line between a server of the communication unit and its clients, or to the plant.

The PLC and its memory know nothing of it but what comes of it: a SEND that gets no answer ends with an error of its port. The
journal says which lines are broken; the server (`server/communication.py`) does to clients what it says. A line stays broken when
the PLC restarts: somebody has to mend it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, Literal, get_args

from scanbench.faults.shapes import Shape, Wanted, flaw, lasts
from scanbench.plcmodel.model import Model
from scanbench.public import Public
from scanbench.runtime.agenda import NOTHING, Met, Waits
from scanbench.runtime.command import Category, Command, Entry, Plan, Refusal, View
from scanbench.runtime.journal import Fold

ServerKind = Literal["fins", "slmp", "modbus", "opcua"]
LineKind = Literal["fins", "slmp", "modbus", "opcua", "plant"]
"""Lines: that of each server to its clients, and that to a plant that is a server of Modbus TCP."""
FaultKind = Literal["none", "silent", "late", "cut", "refused", "node"]
LINE_NAMES: Mapping[LineKind, str] = {
    "fins": "FINS", "slmp": "SLMP", "modbus": "Modbus TCP", "opcua": "OPC UA", "plant": "Modbus plant",
}  # fmt: skip
LATEST_MS = 60_000
_SERVERS: tuple[ServerKind, ...] = get_args(ServerKind)
_VENDORS: Mapping[ServerKind, str] = {"fins": "omron", "slmp": "mitsubishi"}
"""Whose models alone speak a protocol."""


@dataclass(frozen=True, slots=True)
class LineFault(Public):
    """What is wrong with a line."""

    PUBLIC: ClassVar = "CommunicationFault"
    GIVEN: ClassVar = True

    kind: FaultKind = "none"
    """silent: the PLC does what it was asked, and no answer comes, so that clients run into their time limit. late: each answer comes
    `late_ms` later. cut: connections end at the next request, before it is done. refused: nobody can connect. node: the PLC has a
    different node number than its clients believe, so that their requests reach nobody."""
    late_ms: int = 1000
    scans: int | None = None
    """It is there for so many scans; None: until somebody mends the line."""
    period: int | None = None
    """With `scans`: it comes again every so many scans, until somebody mends the line; None: it comes once."""

    @property
    def shape(self) -> Shape:
        """As that of other errors."""
        if self.scans is None:
            return Shape()
        return Shape("for", self.scans) if self.period is None else Shape("intermittent", self.scans, self.period)


NO_FAULT = LineFault()
_TOLD = {
    "silent": "no answer comes", "cut": "connections end", "refused": "nobody can connect", "node": "the PLC has a different node number",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class BrokenLine(Public):
    """A line that somebody broke."""

    PUBLIC: ClassVar = "BrokenLine"

    server: LineKind
    fault: LineFault
    by: str
    scan: int
    present: bool = True
    """False between two times of a fault that comes again."""
    due: int | None = None
    """Before which scan it goes, or comes again; None: it stays."""
    step: int = 0
    """How often it has come and gone: even while it is there."""

    @property
    def now(self) -> LineFault:
        """What clients meet."""
        return self.fault if self.present else NO_FAULT


def servers_of(model: Model) -> tuple[ServerKind, ...]:
    """The protocols that a model speaks."""
    return tuple(kind for kind in _SERVERS if _VENDORS.get(kind, model.vendor) == model.vendor)


def lines_of(model: Model) -> tuple[LineKind, ...]:
    """The lines that a PLC of this model can have."""
    return (*servers_of(model), "plant")


@dataclass(frozen=True, slots=True)
class BreakLine(Command):
    """Something is wrong with a line from now on, instead of what was."""

    category: ClassVar[Category] = "error"

    server: LineKind
    fault: LineFault

    def plan(self, view: View) -> Plan | Refusal:
        """Nothing in memory."""
        name = LINE_NAMES[self.server]
        if self.server not in lines_of(view.model):
            return Refusal(f"{view.model.name} does not speak {name}", lines_of(view.model))
        if not 0 <= self.fault.late_ms <= LATEST_MS:
            return Refusal(f"an answer can come up to {LATEST_MS} ms late, not {self.fault.late_ms}")
        if self.fault.kind == "node" and self.server == "opcua":
            return Refusal("OPC UA has no node numbers of PLCs: choose a different fault")
        if self.fault.kind == "node" and self.server == "plant":
            return Refusal("a plant has no node number of the PLC: choose a different fault")
        if self.fault.kind == "none":
            return Refusal("no fault is given: MendLine takes one back")
        shape = self.fault.shape
        wrong = "say for how many scans it is there each time" if self._only_period else flaw(Wanted((), shape=shape))
        if wrong:
            return Refusal(wrong)
        told = _TOLD.get(self.fault.kind, f"answers come {self.fault.late_ms} ms late")
        if shape.kind == "for":
            told = f"{told}, for {shape.scans} scans"
        elif shape.kind == "intermittent":
            told = f"{told}, {shape.scans} of every {shape.period} scans"
        return Plan((), f"line of {name}: {told}")

    @property
    def _only_period(self) -> bool:
        return self.fault.period is not None and self.fault.scans is None


@dataclass(frozen=True, slots=True)
class LineStep(Command):
    """A fault of a line goes, or comes again, as its shape has it."""

    category: ClassVar[Category] = "error"

    server: LineKind

    def plan(self, view: View) -> Plan | Refusal:
        """Nothing in memory."""
        name, line = LINE_NAMES[self.server], view.derived(BROKEN_LINES).get(self.server)
        if line is None or line.due is None:
            return Refusal(f"the line of {name} has no fault that comes and goes")
        return Plan(
            (), f"line of {name}: the fault is gone" if line.present else f"line of {name}: the fault is there again"
        )


@dataclass(frozen=True, slots=True)
class MendLine(Command):
    """Nothing is wrong with a line any more."""

    category: ClassVar[Category] = "recover"

    server: LineKind

    def plan(self, view: View) -> Plan | Refusal:
        """Nothing in memory."""
        name = LINE_NAMES[self.server]
        whole = self.server not in view.derived(BROKEN_LINES)
        return Plan((), f"line of {name}: nothing was wrong" if whole else f"line of {name}: nothing is wrong any more")


def _next(line: BrokenLine, scan: int) -> BrokenLine:
    """After its next step, which was entered before `scan`."""
    shape, step = line.fault.shape, line.step + 1
    due = None if shape.kind == "stay" else scan + lasts(shape, step)
    return replace(line, step=step, present=step % 2 == 0, due=due)


def _step(broken: Mapping[str, BrokenLine], entry: Entry) -> Mapping[str, BrokenLine]:
    match entry.command:
        case BreakLine() as made:
            first = BrokenLine(made.server, made.fault, made.author, entry.scan, step=-1)
            return {**broken, made.server: _next(first, entry.scan)}
        case LineStep() as made if made.server in broken:
            line = broken[made.server]
            if line.present and line.fault.period is None:
                return {kind: each for kind, each in broken.items() if kind != made.server}
            return {**broken, made.server: _next(line, entry.scan)}
        case MendLine() as made if made.server in broken:
            return {kind: each for kind, each in broken.items() if kind != made.server}
    return broken


BROKEN_LINES: Fold[Mapping[str, BrokenLine]] = Fold({}, _step)
"""Those that something is wrong with, by server; one whose fault comes again, also while it is gone."""


class Lines:
    """`runtime.agenda.Agenda` of faults that come and go."""

    def due(self, view: View, met: Met) -> Command | None:
        """The first step whose scan has come."""
        for each in view.derived(BROKEN_LINES).values():
            if each.due is not None and each.due <= view.header.scan:
                return LineStep(each.by, each.server)
        return None

    def refused(self, command: Command, refusal: Refusal) -> Command:
        """What is due here was looked at before."""
        raise ValueError(f"{command} was refused: {refusal.message}")

    def waits(self, view: View) -> Waits:
        """The next step."""
        dues = [each.due for each in view.derived(BROKEN_LINES).values() if each.due is not None]
        return Waits(min(dues)) if dues else NOTHING
