"""What the statements of one instance do in one scan, noted: the power and the values that the code sees, element by element.

The scan is run again by the debug flavour with a hook that notes them: of the PLC, of its past, of either side of a verification. So code that runs
while nobody looks has nothing of this in it. Drawings of ladders, diagrams and charts show what is noted.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field

from scanbench.debug.flow_shown import Flow, FlowAsked, FlowElement, FlowValue, FlowWire
from scanbench.debug.flow_sites import FlowSites, flow_sites
from scanbench.engines.debug import READ, WRITE, DebugEngine, Listen
from scanbench.program.copies import referred
from scanbench.program.program import Base, Blocks, Place
from scanbench.program.types import BOOL, SLOT_BYTES
from scanbench.runtime.resource import Resource
from scanbench.symbols.names import NamesInside, names_of
from scanbench.symbols.symbols import UnknownPath, resolve
from scanbench.symbols.values import format_value

_WHOLE = 0xFF
_MOST = 1_000
"""Variables of an element that are kept: a function block may use many."""


@dataclass(slots=True)
class _Use:
    """A variable that an element used."""

    offset: int
    size: int
    bits: int
    value: bytes
    """The bytes of the image from `offset` on."""


@dataclass(slots=True)
class _Noted:
    """One call of one body."""

    names: NamesInside
    runs: dict[int, int] = field(default_factory=dict)
    power: dict[int, bool] = field(default_factory=dict)
    uses: dict[int, dict[tuple[int, int, bool], _Use]] = field(default_factory=dict)
    """Of each site by offset, bits, and whether it is a write: of reads the first one, of writes the last."""
    wires: dict[tuple[str, int], str] = field(default_factory=dict)


@dataclass(slots=True)
class _Open:
    """A call of a body that is under way."""

    depth: int
    body: FlowSites
    instance: int
    noted: _Noted | None
    """None where somebody else's call is under way."""
    site: int | None = None
    """The statement that is under way."""


class FlowHook:
    """Listens to one scan, for one instance; see `Onlooker`."""

    def __init__(self, resource: Resource, asked: FlowAsked, upto: int = 0) -> None:
        """`upto`: the statement before which the scan is halted, 0: it runs to its end. `UnknownPath` where there is no such
        instance, or nothing of it that runs."""
        self._resource, self._asked, self._upto = resource, asked, upto
        self._engine: DebugEngine = resource.loaded.debugged()
        self._memory, self._version = resource.memory, resource.version
        program = resource.view.statements
        self._names = names_of(program)
        self._bodies = flow_sites(program, self._engine.sites, asked.pou)
        self._own = next((each for each in self._bodies if each.pou.name.upper() == asked.pou.upper()), None)
        if not self._bodies:
            raise UnknownPath(f"no program that runs has statements of `{asked.pou}`")
        symbol = resolve(program, asked.instance) if asked.instance else None
        self._instance = 0 if symbol is None else symbol.offset
        self._head = "" if symbol is None else f"{symbol.path}."
        self._by_site = {site: each for each in self._bodies for site in each.sites}
        statements = self._engine.sites.statements
        self._in_sight = {
            each for each in self._by_site if asked.first <= statements[each].span.line <= asked.last
        }  # fmt: skip
        entries = frozenset().union(*(each.entries for each in self._bodies))
        self._idle = Listen(sites=entries, count=upto)
        self._all_along = bool(upto) or any(each.pou.recursive for each in self._bodies)
        """Whether statements out of sight count: the last one before a halt; and one whose frame its caller shares."""
        self._unseen = Listen(every=True, count=upto)
        self._busy = Listen(every=True, accesses=READ | WRITE, count=upto)
        self._listen = self._idle
        self._open: list[_Open] = []
        self._depth = 0
        self._calls = 0
        self._whole = False
        self._scan = resource.header.scan
        self._noted: dict[str, _Noted] = {}
        """By the name of the body: of the call that is wanted."""

    @property
    def file(self) -> str:
        """Where the POU is written."""
        return self._bodies[0].pou.span.file

    @property
    def version(self) -> int:
        """The program that ran."""
        return self._version

    @property
    def listen(self) -> Listen:
        """What to listen to as the scan begins."""
        return self._idle

    # ---- as the resource's hook -------------------------------------------------------------------------------------

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        if self._upto and count >= self._upto:
            return True
        self._depth = depth
        own = self._by_site.get(site)
        self._leave(depth, own, site)
        if own is not None:
            top = self._open[-1] if self._open else None
            if top is None or top.depth < depth:
                top = self._enter(own, depth)
            top.site = site
            if top.noted is not None:
                top.noted.runs[site] = top.noted.runs.get(site, 0) + 1
                top.noted.uses[site] = {}
        self._tell()
        return False

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""
        top = self._open[-1] if self._open else None
        if top is None or top.noted is None or top.depth != self._depth or site not in top.body.sites:
            return
        bits, uses = self._engine.bits, top.noted.uses.setdefault(site, {})
        key = offset, bits, written
        if len(uses) < _MOST and (written or key not in uses):
            uses[key] = _Use(offset, size, bits, bytes(self._memory[offset : offset + size]))

    def entered(self) -> None:
        """See `Onlooker`."""

    def over(self) -> None:
        """See `OfScan`."""
        inside = self._resource.listening.inside
        self._whole = self._resource.header.scan > self._scan
        depth = 0 if inside is None else len(inside.frames)
        while self._open:
            top = self._open.pop()
            if not self._whole and top.depth != depth and top.depth < max(depth, self._depth + 1) and top.noted:
                top.noted.runs.pop(-1 if top.site is None else top.site, None)  # it has not come to its end
                top.site = None
            self._close(top)

    # ---- calls ------------------------------------------------------------------------------------------------------

    def _enter(self, own: FlowSites, depth: int) -> _Open:
        frame = self._engine.frames()[0]
        noted = None
        if frame.instance == self._instance:
            if own is self._own:
                self._calls += 1
                self._noted = {} if self._wants else self._noted
            if self._wants:
                inside = self._names.inside(frame.pou, frame.instance, self._memory)
                noted = self._noted[own.pou.name] = _Noted(self._names.within(inside))
        if noted is not None and not self._all_along:
            self._unseen = Listen(self._idle.sites.union(self._in_sight, self._after(depth)))
        made = _Open(depth, own, frame.instance, noted)
        self._open.append(made)
        return made

    def _after(self, depth: int) -> Iterable[int]:
        """The statements of which one begins when the call that is under way is over: those of the caller, or of other programs."""
        frames, bodies = self._engine.frames(), self._engine.sites.bodies
        if depth > 1:
            return bodies[frames[1].pou]
        return [
            site
            for pou, sites in bodies.items()
            if pou.kind == "program" and pou is not frames[0].pou
            for site in sites
        ]

    @property
    def _wants(self) -> bool:
        """Whether the call that is under way is the one that is asked for."""
        return self._asked.call in (0, self._calls)

    def _leave(self, depth: int, own: FlowSites | None, site: int) -> None:
        """A statement is to begin: what was under way deeper, or here, is over."""
        while self._open and self._open[-1].depth > depth:
            self._close(self._open.pop())
        if not self._open or self._open[-1].depth != depth:
            return
        top = self._open[-1]
        if own is not top.body or self._begins_again(top, site):
            self._close(self._open.pop())
        else:
            self._settle(top)

    def _begins_again(self, top: _Open, site: int) -> bool:
        """Whether the first statement of the body begins a new call of it, and not a jump back."""
        if site != top.body.first:
            return False
        if self._engine.frames()[0].instance != top.instance:
            return True
        pou = top.body.pou
        return pou.kind == "function" and not any(isinstance(each, Blocks) for each in pou.body)

    def _settle(self, top: _Open) -> None:
        """The statement that was under way is over: what it came to is read, before anything else writes it."""
        noted, site, top.site = top.noted, top.site, None
        if noted is None or site is None:
            return
        bit = top.body.power.get(site)
        if bit is not None:
            noted.power[site] = (self._memory[top.body.pou.frame_offset + bit.offset] != 0) != bit.inverted
        for place in top.body.written.get(site, ()):
            self._written(top, noted, site, place)

    def _written(self, top: _Open, noted: _Noted, site: int, place: Place) -> None:
        at, bit = self._at(top, place.base, place.offset), place.bit
        if place.slot is not None:
            slot = self._at(top, place.slot.base, place.slot.offset)
            found = referred(int.from_bytes(self._memory[slot : slot + SLOT_BYTES], "little"))
            if found is None:
                return
            at = found[0] + place.offset
            bit = found[1] if bit is None and place.type == BOOL else bit
        size, bits = place.type.size, _WHOLE if bit is None else 1 << bit
        noted.uses.setdefault(site, {})[at, bits, True] = _Use(at, size, bits, bytes(self._memory[at : at + size]))

    def _at(self, top: _Open, base: Base, offset: int) -> int:
        match base:
            case Base.IMAGE:
                return offset
            case Base.SELF:
                return top.instance + offset
            case Base.FRAME:
                return top.body.pou.frame_offset + offset

    def _close(self, top: _Open) -> None:
        self._settle(top)
        self._read_wires(top)

    def _read_wires(self, top: _Open) -> None:
        if top.noted is not None:
            for each in top.body.wires:
                at = self._at(top, each.base, each.offset)
                value = bytes(self._memory[at : at + each.type.size])
                top.noted.wires[each.name, each.line] = format_value(each.type, value)

    def _tell(self) -> None:
        """What is listened for from here on."""
        listen = self._idle
        if any(each.instance == self._instance for each in self._open):
            top = self._open[-1]
            here = top.noted is not None and top.depth == self._depth and top.site in self._in_sight
            listen = self._busy if here else self._unseen
        if listen is not self._listen:
            self._listen = listen
            self._resource.listening.listen(listen)

    # ---- what was noted ---------------------------------------------------------------------------------------------

    @property
    def flow(self) -> Flow:
        """What was noted, once the scan is over, or halted."""
        found = [
            self._element(noted, site)
            for noted in self._noted.values()
            for site in noted.runs
            if site in self._in_sight
        ]
        wires = {key: text for noted in self._noted.values() for key, text in noted.wires.items()}
        call = self._asked.call or self._calls
        return Flow(
            self._scan, self._calls, call if call <= self._calls else 0, self._whole,
            tuple(sorted(found, key=lambda each: (each.line, each.column))),
            tuple(FlowWire(name, text, line) for (name, line), text in wires.items()),
        )  # fmt: skip

    def _element(self, noted: _Noted, site: int) -> FlowElement:
        span = self._engine.sites.statements[site].span
        values: dict[tuple[str, bool], FlowValue] = {}
        for (_, _, written), use in noted.uses.get(site, {}).items():
            for value in self._values(noted, use, written):
                values[value.name, written] = value
        return FlowElement(span.line, span.column, noted.power.get(site), tuple(values.values()), noted.runs[site])

    def _values(self, noted: _Noted, use: _Use, written: bool) -> list[FlowValue]:
        return [
            FlowValue(
                leaf.name.removeprefix(self._head), format_value(leaf.type, leaf.cut(use.value, use.offset)), written
            )
            for leaf in noted.names.at(use.offset, use.size, use.bits)
            if not leaf.passing
        ]
