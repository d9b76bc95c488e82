"""What the code of one instance saw in one pass, on both sides, element by element: made of the used-variable record, for drawings.

A drawing shows A beside A' where the two differ, and marks the element that differed first.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

from scanbench.debug.flow_shown import Flow, FlowAsked, FlowElement, Flows, FlowValue, FlowWire
from scanbench.debug.flow_sites import FlowSites, Wire, flow_sites
from scanbench.engines.debug import Frame
from scanbench.program.program import Base
from scanbench.symbols.names import NamesInside
from scanbench.symbols.symbols import UnknownPath, resolve
from scanbench.symbols.values import format_value
from scanbench.verify.both import Both
from scanbench.verify.contract import VerifyFlows
from scanbench.verify.edits import BadEdit
from scanbench.verify.used_record import detailed
from scanbench.verify.uses import Access


@dataclass(slots=True)
class _Noted:
    """An element that ran."""

    power: bool | None = None
    values: dict[tuple[str, bool], str] = field(default_factory=dict)
    counts: set[int] = field(default_factory=set)
    """The counts of its statement, each time that it began."""


class _Call:
    """The last call of the instance in a pass of one side."""

    def __init__(self, bodies: Sequence[FlowSites], pou: str, head: str, instance: int) -> None:
        self._by_site = {site: each for each in bodies for site in each.sites}
        self._own = next((each for each in bodies if each.pou.name.upper() == pou.upper()), bodies[0])
        self._instance = instance
        self._wires = [(each, _where(body, each, instance)) for body in bodies for each in body.wires]
        self._from: int | None = None
        """The statement that called it."""
        self._head = f"{head}."
        self._due: dict[int, tuple[_Noted, bool]] = {}
        """By offset: where an output of a box was copied to, which is no use of its own. Who reads it next tells of the power."""
        self.calls = 0
        self.elements: dict[int, _Noted] = {}
        self.wires: dict[tuple[str, int], str] = {}

    def read(self, names: NamesInside, log: Sequence[Access], frames: Sequence[tuple[Frame, ...]]) -> None:
        """Reads the record, use by use. `frames`: the open calls at each use."""
        for access, open in zip(log, frames, strict=False):
            at = next((at for at, each in enumerate(open) if self._is_own(each)), None)
            if at is None:
                self._from = None
                continue
            caller = open[at + 1].site if at + 1 < len(open) else -1
            if caller != self._from:
                self._from, self._due, self.elements, self.wires = caller, {}, {}, {}
                self.calls += 1
            self._note_wire(access)
            self._note_due(access)
            body = self._by_site.get(access.site)
            if body is not None and open[0].pou is body.pou:
                self._note(names, body, access)

    def _is_own(self, frame: Frame) -> bool:
        return frame.pou is self._own.pou and frame.instance == self._instance

    def _note_wire(self, access: Access) -> None:
        for wire, offset in self._wires if access.written else ():
            if access.offset == offset and access.size == wire.type.size:
                self.wires[wire.name, wire.line] = format_value(wire.type, access.value)

    def _note_due(self, access: Access) -> None:
        due = self._due.get(access.offset)
        if due is None or access.site in (each for each, noted in self.elements.items() if noted is due[0]):
            return
        if not access.written:
            due[0].power = any(access.value) != due[1]
        del self._due[access.offset]

    def _note(self, names: NamesInside, body: FlowSites, access: Access) -> None:
        noted = self.elements.setdefault(access.site, _Noted())
        noted.counts.add(access.position)
        bit = body.power.get(access.site)
        if bit is not None:
            offset = body.pou.frame_offset + bit.offset
            if access.written and access.offset == offset:
                noted.power = any(access.value) != bit.inverted
                self._due.pop(offset, None)
            elif noted.power is None:
                self._due[offset] = noted, bit.inverted
        for leaf in names.at(access.offset, access.size, access.bits):
            name = leaf.name.removeprefix(self._head)
            key = name, access.written
            if not leaf.passing and "$" not in name and (access.written or key not in noted.values):
                noted.values[key] = format_value(leaf.type, leaf.cut(access.value, access.offset))


def _where(body: FlowSites, wire: Wire, instance: int) -> int:
    return (body.pou.frame_offset if wire.base is Base.FRAME else instance) + wire.offset


def flows_of(both: Both, call: int, asked: FlowAsked) -> VerifyFlows:
    """Of a call of the range in the scan that ran last. `BadEdit` when there is none, or its record is not complete; `UnknownPath`."""
    names, live, first, second = detailed(both, call)
    control = both.control.side
    if live.full or second.full:
        raise BadEdit("the record of this row is full: what its elements saw is not known")
    program, sites = control.resource.program, control.resource.loaded.debugged().sites
    bodies = flow_sites(program, sites, asked.pou)
    if not bodies:
        raise UnknownPath(f"no program that runs has statements of `{asked.pou}`")
    symbol = resolve(program, asked.instance) if asked.instance else None
    instance, head = (0, "") if symbol is None else (symbol.offset, symbol.path)
    own = next((each for each in bodies if each.pou.name.upper() == asked.pou.upper()), bodies[0])
    inside = first.inside if first.pou is own.pou else names.inside(own.pou, instance, control.memory)
    made = []
    for log, frames in ((live.log, first.frames_of), (second.log, second.frames_of)):
        seen = _Call(bodies, asked.pou, head, instance)
        seen.read(names.within(inside), log, frames)
        made.append(seen)
    scan = both.ran_last
    file, version = bodies[0].pou.span.file, control.resource.version
    spans = {site: sites.statements[site].span for each in bodies for site in each.sites}

    def flows(seen: _Call) -> Flows:
        found = [
            FlowElement(
                spans[site].line, spans[site].column, each.power,
                tuple(FlowValue(name, text, written) for (name, written), text in each.values.items()), len(each.counts),
            )
            for site, each in seen.elements.items()
        ]  # fmt: skip
        found.sort(key=lambda each: (each.line, each.column))
        wires = tuple(FlowWire(name, text, line) for (name, line), text in seen.wires.items())
        flow = Flow(scan, seen.calls, seen.calls, True, tuple(found), wires)
        return Flows(file, version, (flow,))

    where = _first(*made)
    at = (0, 0) if where is None else (spans[where].line, spans[where].column)
    return VerifyFlows(flows(made[0]), flows(made[1]), *at)


def _first(one: _Call, other: _Call) -> int | None:
    """The site of the element that differed first: whose power or values are not the same, or that ran on one side only."""
    found: tuple[int, int] | None = None
    for site in {*one.elements, *other.elements}:
        here, there = one.elements.get(site), other.elements.get(site)
        if here is not None and there is not None and (here.power, here.values) == (there.power, there.values):
            continue
        count = min(min(each.counts) for each in (here, there) if each is not None)
        if found is None or (count, site) < found:
            found = count, site
    return None if found is None else found[1]
