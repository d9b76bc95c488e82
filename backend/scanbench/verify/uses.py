"""The used-variable record: what a range reads and writes in a scan, pass by pass, in the order of use.

The recorder listens to the debug flavour of either side. A pass begins when a statement of the range begins in a frame of its
POU. It ends when a statement outside of the range or a new call of the POU begins in that frame, or when the frame ends;
what is called belongs to it.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from scanbench.engines.debug import READ, WRITE, Frame, Listen
from scanbench.program.program import Blocks, Pou
from scanbench.runtime.resource import Resource
from scanbench.symbols.leaves import WHOLE
from scanbench.symbols.names import ANYWHERE, Inside, Names
from scanbench.verify.ranges import Resolved


class Access(NamedTuple):
    """A use. `value`: the bytes as they are after it; of a bit nothing else of its byte."""

    site: int
    position: int
    """The count of the statement that had begun last."""
    offset: int
    size: int
    bits: int
    written: bool
    value: bytes


_COUNTED = 16
"""Uses that are counted of a whole scan, for each one that is kept."""
_new = tuple.__new__
"""Makes an access in half the time: there are hundreds in a scan."""


class Fresh(NamedTuple):
    """A read of what the pass had not written. `mask`: which of its bits, None where all of them."""

    access: Access
    mask: bytes | None


@dataclass(slots=True)
class Pass:
    """One run through the range."""

    pou: Pou | None
    instance: int
    begin: int
    """The count of its first statement."""
    inside: Inside = ANYWHERE
    frames: tuple[Frame, ...] = ()
    """Open calls as it begins, innermost first; none of the whole scan."""
    log: list[Access] = field(default_factory=list)
    used: int = 0
    """Uses, the ones that found no room included."""
    called: int = 1 << 62
    """The offset of the frames. Frames of the POUs that it calls are no inputs, as the engine does not report arguments."""
    uncounted: bool = False
    """There were more uses than `used`: a loop that hardly ends makes millions, which nobody counts."""
    frames_of: list[tuple[Frame, ...]] = field(default_factory=list)
    """Of each entry of the log the open calls, where that was asked for."""

    @property
    def full(self) -> bool:
        """Whether uses found no room."""
        return self.used > len(self.log)

    def fresh(self) -> list[Fresh]:
        """Its inputs: what it read before it wrote it, each once."""
        known: dict[int, int] = {}
        found = []
        pou, called = self.pou, self.called
        own = range(0) if pou is None else range(pou.frame_offset, pou.frame_offset + pou.frame.size)
        for access in self.log:
            _, _, offset, size, bits, written, _ = access
            if offset >= called and offset not in own:
                continue
            if size == 1:
                before = known.get(offset, 0)
                if not written and bits & ~before:
                    found.append(Fresh(access, None if not before & bits else bytes((bits & ~before,))))
                known[offset] = before | bits
                continue
            span = range(offset, offset + size)
            if not written:
                mask = bytes(WHOLE & ~known.get(at, 0) for at in span)
                if any(mask):
                    found.append(Fresh(access, None if mask.count(WHOLE) == size else mask))
            known.update(dict.fromkeys(span, WHOLE))
        return found


class Recorder:
    """Listens to one side while a scan runs. It halts nowhere."""

    def __init__(
        self, resource: Resource, names: Names, range: Resolved, limit: int, detail: bool = False,
        disturbed: Iterable[int] = (),
    ) -> None:  # fmt: skip
        """`disturbed`: bytes of which every write is noted, wherever the program makes it."""
        self._resource, self._names, self._range = resource, names, range
        self._engine = resource.loaded.debugged()
        self._memory = resource.memory
        self._left, self._detail = limit, detail
        self._most = _COUNTED * limit
        self.written: dict[int, list[tuple[int, int]]] = {at: [] for at in disturbed}
        """Of each disturbed byte what statements have written of it: the count, and the bits that nobody had written."""
        self._idle = Listen(sites=range.sites, count=1, bytes=dict.fromkeys(self.written, WRITE))
        self._busy = Listen(sites=range.sites, every=True, accesses=READ | WRITE)
        if range.whole:
            self._idle = self._busy = Listen(count=1, accesses=READ | WRITE)
        self._open: Pass | None = None
        self._depth = 0
        self._callers: frozenset[int] = frozenset()
        self._first = True
        self.passes: list[Pass] = []
        self.on_first: Callable[[], None] | None = None
        """Called before the first statement of the scan: after input refresh and forces."""
        self.on_begin: Callable[[int, Pass], None] | None = None
        """Called when a pass begins, with its number."""

    @property
    def listen(self) -> Listen:
        """What to listen to as the scan begins."""
        return self._idle

    @property
    def began(self) -> bool:
        """Whether any statement ran."""
        return not self._first

    # ---- as the resource's hook -----------------------------------------------------------------------------------

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        if self._first:
            self._first = False
            if self.on_first is not None:
                self.on_first()
        if self._range.whole:
            if self._open is None:
                self._begin(Pass(None, 0, count), depth)
            return False
        if self._open is not None and self._goes_on(site, depth):
            return False
        if self._open is not None:
            self._end()
        if site in self._range.sites:
            self._enter(count, depth)
        return False

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""
        if written and self.written:
            self._note_written(count, range(offset, offset + size))
        open = self._open
        if open is None:
            if not self._range.whole:
                return
            open = self._begin(Pass(None, 0, count), 1)
        if site in self._range.outside:
            return  # as of a loop around the range
        if site in self._callers:
            self._end()
            return
        open.used += 1
        if self._left <= 0:
            self._count_out(open)
            return
        self._left -= 1
        bits = self._engine.bits
        value = bytes(self._memory[offset : offset + size]) if bits == WHOLE else bytes((self._memory[offset] & bits,))
        open.log.append(_new(Access, (site, count, offset, size, bits, written, value)))
        if self._detail:
            open.frames_of.append(self._engine.frames())

    def _count_out(self, open: Pass) -> None:
        """Of the whole scan nothing more is counted when far more is used than is kept."""
        if self._range.whole and not open.uncounted and open.used > self._most:
            open.uncounted = True
            self._resource.listening.listen(Listen(bytes=dict.fromkeys(self.written, WRITE)))

    def _note_written(self, count: int, span: range) -> None:
        for at in span if len(span) < len(self.written) else [at for at in self.written if at in span]:
            known = self.written.get(at)
            if known is not None:
                new = self._engine.bits & ~sum(bits for _, bits in known)
                if new:
                    known.append((count, new))

    def entered(self) -> None:
        """Something was entered inside of the scan: what it changed that a statement had written counts as its result; not where
        the record is full, as the last write of a variable in it is not the last one that ran."""
        if self._open is not None and not self._open.full:
            results_are(self._open.log, self._memory)

    # ---- passes ---------------------------------------------------------------------------------------------------

    def _goes_on(self, site: int, depth: int) -> bool:
        """Whether the pass does, with this statement."""
        open = self._open
        assert open is not None
        if depth != self._depth:
            return depth > self._depth
        if site not in self._range.sites:
            return False
        return site not in self._range.first_sites or not self._is_new_call(open)

    def _is_new_call(self, open: Pass) -> bool:
        """Whether the first statement of the POU begins a new call of it, and not a jump back of an instruction list."""
        frame = self._engine.frames()[0]
        if frame.instance != open.instance or frame.pou is not open.pou:
            return True
        return frame.pou.kind == "function" and not any(isinstance(each, Blocks) for each in frame.pou.body)

    def _enter(self, count: int, depth: int) -> None:
        frames = self._engine.frames()
        pou, instance = frames[0].pou, frames[0].instance
        if self._range.only is not None and instance != self._range.only:
            return
        inside = self._names.inside(pou, instance, self._memory)
        self._callers = frozenset(each.site for each in frames[1:])
        self._begin(Pass(pou, instance, count, inside, frames), depth)

    def _begin(self, made: Pass, depth: int) -> Pass:
        made.called = self._names.program.layout.frames
        self._open, self._depth = made, depth
        self.passes.append(made)
        if self.on_begin is not None:
            self.on_begin(len(self.passes) - 1, made)
        if self._busy is not self._idle:
            self._resource.listening.listen(self._busy)
        return made

    def _end(self) -> None:
        self._open, self._callers = None, frozenset()
        self._resource.listening.listen(self._idle)


def results_are(log: list[Access], memory: bytes | bytearray, span: range | None = None) -> bool:
    """Replaces the last results in a log by the present values in memory (in these bytes); returns whether any changed."""
    known: set[tuple[int, int]] = set()
    changed = False
    for index in range(len(log) - 1, -1, -1):
        access = log[index]
        if not access.written or (span is not None and not _touches(access, span)):
            continue
        now = bytes(memory[access.offset : access.offset + access.size])
        mine = bytearray(access.value)
        for at, bits in _bits(access):
            if (at, bits) not in known:
                known.add((at, bits))
                here = at - access.offset
                mine[here] = mine[here] & ~bits | now[here] & bits
        if mine != access.value:
            log[index] = access._replace(value=bytes(mine))
            changed = True
    return changed


def _bits(access: Access) -> Iterator[tuple[int, int]]:
    """Each of its bits."""
    for at in range(access.offset, access.offset + access.size):
        for bit in range(8):
            if access.bits >> bit & 1:
                yield at, 1 << bit


def _touches(access: Access, span: range) -> bool:
    return access.offset < span.stop and span.start < access.offset + access.size
