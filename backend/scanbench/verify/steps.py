"""Step by step: both sides run one statement of the range, and are compared after it.

A step begins before a statement of the range, or in the seam, and ends before the next statement of the range, which may be
one of a call inside of it, or at the end of the scan. Its row is about the statement that ran. What is different for the first
time is the cause; what the statement got wrong because it read what was different already is a consequence of that.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from scanbench.engines.debug import READ, WRITE, Frame, Listen
from scanbench.engines.engine import Reason, Stop
from scanbench.program.types import Elementary
from scanbench.runtime.holds import held
from scanbench.runtime.resource import Resource
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.names import ANYWHERE, NamesInside
from scanbench.verify.both import Both, View, ViewOf
from scanbench.verify.contract import AT_END, ENDED, Cause, Input, Mismatch, Output, Place, Row
from scanbench.verify.control import trap_of
from scanbench.verify.ranges import Resolved
from scanbench.verify.sentences import mismatch, values
from scanbench.verify.sides import Begin, Side
from scanbench.verify.uses import Access, Pass

ACCUMULATOR = "$CR"
"""How the names of temporaries begin that keep IL's current result."""
MOST_STILL = 5
"""Variables that a note names."""


class _Stepper:
    """Lets the scan run to where the step begins, then to where it ends; notes what is used between."""

    def __init__(self, resource: Resource, range: Resolved, span: tuple[int, int], first: Callable[[], None]) -> None:
        """`span`: the counts where it begins and ends; an end of 0: before the next statement of the range."""
        self._resource, self._range, self._first = resource, range, first
        self._after, self._until = span
        self._engine = resource.loaded.debugged()
        self.began = False
        self.log: list[Access] = []
        self.elsewhere: set[int] = set()
        """Bytes that statements outside of the range wrote after the step's own."""
        self.frames: tuple[Frame, ...] = ()
        """The open calls where it began."""
        self.memory = b""
        """The whole image there."""

    @property
    def listen(self) -> Listen:
        """To begin with."""
        return Listen(count=1)

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        if count == 1:
            self._first()
        if not self.began:
            if count < self._after:
                self._resource.listening.listen(Listen(count=self._after))
                return False
            self._begin()
            if self._after:
                return False
        return count >= self._until if self._until else self._range.holds(self._engine.frames())

    def _begin(self) -> None:
        self.began, self.memory = True, bytes(self._resource.memory)
        if self._after:
            self.frames = self._engine.frames()
        self._resource.listening.listen(Listen(every=True, accesses=READ | WRITE))

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""
        if not (self.began and self._after):
            return
        if not self._range.holds(self._engine.frames()):
            if written:
                self.elsewhere.update(range(offset, offset + size))
        else:
            value = bytes(self._resource.memory[offset : offset + size])
            self.log.append(Access(site, count, offset, size, self._engine.bits, written, value))

    def entered(self) -> None:
        """See `Onlooker`."""


@dataclass(slots=True)
class _Stood:
    """Where a side is, and where its step began."""

    memory: bytes
    frames: tuple[Frame, ...] = ()
    log: list[Access] = field(default_factory=list)
    elsewhere: set[int] = field(default_factory=set)
    count: int = 0
    before: tuple[Frame, ...] = ()
    """The open calls where it began; none in the seam."""
    was: bytes = b""
    """The whole image there; at the end where the scan did not get so far, empty in the seam."""
    ended: bool = False
    """The scan is over."""
    trap: int = 0
    marks: dict[int, int] = field(default_factory=dict)
    """What was held, as the first statement began."""
    begin: bytes = b""
    """The whole image before the scan."""


def step_row(both: Both, scan: int, span: tuple[int, int], view_of: ViewOf) -> Row:
    """Runs both from the seam, before its entries, through one step. `span`: the count of the statement that it is about (0: none,
    it runs up to the first one), and that of the statement before which it ends (0: the next one of the range, or the end of the
    scan). With 0 and 0 where nothing runs, it is the seam."""
    both.seam(scan)
    control, monitor = both.control.side, both.monitor.side
    view = view_of(control)
    if span[0] == 0:
        both.tell_disturbed(view, scan)
    bits = held(control.resource.journal)
    if not control.resource.runnable:
        mine, right = _Stood(bytes(control.memory)), _Stood(bytes(monitor.memory))
    else:
        begin = control.begin()
        mine = _go(control, begin, view.range, span, lambda: {at: control.memory[at] for at in bits})

        def give() -> dict[int, int]:
            for at, mask in bits.items():
                monitor.memory[at] = monitor.memory[at] & ~mask | mine.marks.get(at, 0) & mask
            return {}

        to = AT_END if mine.ended and not mine.trap else mine.count
        right = _go(monitor, monitor.begin(), view.range, (span[0], to), give)
    return _Step(both, view, scan, mine, right).row()


def _go(
    side: Side, begin: Begin, range: Resolved, span: tuple[int, int], first: Callable[[], dict[int, int]]
) -> _Stood:
    marks: dict[int, int] = {}
    stepper = _Stepper(side.resource, range, span, lambda: marks.update(first()))

    def run() -> _Stood:
        stop: Stop = side.run(stepper, stepper.listen)
        inside = side.resource.listening.inside
        frames, count = (inside.frames, inside.count) if inside is not None else ((), 0)
        was = b"" if not span[0] else stepper.memory if stepper.began else bytes(side.memory)
        return _Stood(
            bytes(side.memory), frames, stepper.log, stepper.elsewhere, count, stepper.frames, was, stop.reason is not Reason.HALTED,
            trap_of(stop), marks, begin.memory,
        )  # fmt: skip

    return side.again(begin, run)


@dataclass(slots=True)
class _Step:
    """One row."""

    both: Both
    view: View
    scan: int
    control: _Stood
    monitor: _Stood

    def row(self) -> Row:
        """What the statement used, and what is different now that was not before it."""
        control, monitor = self.control, self.monitor
        place = _place(self.view, control.before)
        names = self._names()
        outputs: dict[str, Output] = {}
        for side, mine in ((control, True), (monitor, False)):
            for leaf in self._written(names, side.log):
                known, value = outputs.get(leaf.name, Output(None, None)), leaf.cut(side.memory, 0)
                outputs[leaf.name] = Output(value, known.monitor) if mine else Output(known.control, value)
        inputs = {
            leaf.name: Input(value)
            for access, _ in Pass(None, 0, 0, log=control.log).fresh()
            for leaf in self._leaves(names, access)
            if self.view.reader.used(leaf, False, value := leaf.cut(access.value, access.offset))
        }
        causes, consequences, still = self._different()
        note = "; ".join(filter(None, (self._ended(), self._rest(), _still(still))))
        return Row(
            "step", self.scan, 0, control.count, place.instance if place is not None else "", place, outputs, inputs, causes,
            tuple(dict.fromkeys(self.both.told)), len(control.log), note, next=_place(self.view, control.frames),
            consequences=consequences,
        )  # fmt: skip

    def _ended(self) -> str:
        return "" if not self.control.ended else ENDED if self.control.trap else "end of the scan"

    def _rest(self) -> str:
        """The statements that called the one that ran, where they went on after it."""
        ran = self.control.before[0].site if self.control.before else None
        others = dict.fromkeys(each.site for each in self.control.log if each.site != ran)
        places = (self.view.reader.places.of(each, self.control.before) for each in others)
        texts = [f"{each.file}:{each.line}" for each in places]
        return f"with the rest of {', '.join(texts)}" if texts else ""

    # ---- names ----------------------------------------------------------------------------------------------------

    def _names(self) -> NamesInside:
        """Those of the POU whose statement ran, where that is the range's."""
        names, before = self.view.reader.names, self.control.before
        if not before or before[0].pou not in self.view.range.pous:
            return names.within(ANYWHERE)
        return names.within(names.inside(before[0].pou, before[0].instance, self.control.memory))

    def _leaves(self, names: NamesInside, access: Access) -> Iterator[Leaf]:
        """What an access is about, by the names that the program has for it."""
        result = self._accumulator(access)
        if result is not None:
            yield result
            return
        for leaf in names.at(access.offset, access.size, access.bits):
            yield leaf._replace(passing=False)

    def _accumulator(self, access: Access) -> Leaf | None:
        """IL's current result, which has the type of what was loaded."""
        for frame in self.control.before[:1] or self.monitor.before[:1]:
            for member in frame.pou.frame.members.values():
                if (
                    member.name.upper().startswith(ACCUMULATOR)
                    and frame.pou.frame_offset + member.offset == access.offset
                ):
                    assert isinstance(member.type, Elementary)
                    return Leaf(f"CR ({member.type.name})", member.type, access.offset, None)
        return None

    def _written(self, names: NamesInside, log: list[Access]) -> Iterator[Leaf]:
        """Their values are those at the end of the step: a disturbed result is not what was written."""
        for access in log:
            if access.written:
                for leaf in self._leaves(names, access):
                    values = (leaf.cut(side.memory, 0) for side in (self.control, self.monitor))
                    if self.view.reader.used(leaf, True, *values):
                        yield leaf

    # ---- what is different ----------------------------------------------------------------------------------------

    def _different(self) -> tuple[tuple[Mismatch, ...], tuple[Mismatch, ...], list[str]]:
        """What this step is the cause of, what it did because something was different before, and what is still different."""
        control, monitor = self.control, self.monitor
        causes, consequences = list(self.both.extra), list[Mismatch]()
        known = self._bytes(control.was, monitor.was) if control.was and monitor.was else set[int]()
        parted = _sites(control.before) != _sites(monitor.before)
        misled = parted or _reads(control.log) != _reads(monitor.log)
        own = consequences if misled else causes
        if control.trap != monitor.trap:
            side = control if control.trap else monitor  # whatever led to it, this is told first
            causes.append(self.both.trap(self.view, self.scan, control.trap, monitor.trap, side.before))
        elif not parted and (_sites(control.frames) != _sites(monitor.frames) or control.ended != monitor.ended):
            (consequences if known else own).append(self._order())  # which way it goes may depend on what is different
        written = {
            at: each.site
            for each in (*monitor.log, *control.log)
            if each.written
            for at in range(each.offset, each.offset + each.size)
        }
        for at in control.elsewhere | monitor.elsewhere:
            written.pop(at, None)
        outside = consequences if known or parted else causes
        still: list[str] = []
        for leaf, at in self._leaves_of(self._bytes(control.memory, monitor.memory, whole=False)):
            if at in written:
                place = self.view.reader.places.of(written[at], control.before or monitor.before)
                own.append(self._mismatch(leaf, "input" if misled else "logic", place))
            elif at in known:
                still.append(leaf.name)
            else:
                outside.append(self._mismatch(leaf, "outside", None))
        return tuple(causes), tuple(consequences), still

    def _bytes(self, one: bytes, other: bytes, *, whole: bool = True) -> set[int]:
        """Where the two differ, with the temporaries of the open calls. Not `whole`: where one side's scan has ended before the
        other's, what the control device did not reach is left out."""
        control, monitor = self.control, self.monitor
        cut = control.trap != monitor.trap or control.ended != monitor.ended
        found = set(self.both.different(one, other, b"" if whole or not cut else control.begin))
        for frame in {each.pou: each for each in (*control.before, *control.frames)}.values():
            span = range(frame.pou.frame_offset, frame.pou.frame_offset + frame.pou.frame.size)
            found.update(at for at in span if one[at] != other[at])
        return found

    def _leaves_of(self, found: set[int]) -> Iterator[tuple[Leaf, int]]:
        """The variables that have these bytes, each once."""
        control, monitor = self.control.memory, self.monitor.memory
        size = self.both.control.side.resource.program.layout.state_size
        state = sorted(at for at in found if at < size)
        for leaf in self.both.leaves(self.view, state, control, monitor):
            yield leaf, _first_of(leaf, found)
        for pou in {each.pou for each in (*self.control.before, *self.control.frames)}:
            for leaf in self.view.reader.names.temporaries(pou):
                if leaf.cut(control, 0) != leaf.cut(monitor, 0):
                    yield leaf, _first_of(leaf, found)

    def _mismatch(self, leaf: Leaf, cause: Cause, place: Place | None) -> Mismatch:
        was, right = (leaf.cut(each, 0) for each in (self.control.memory, self.monitor.memory))
        here, there = values(self.view.reader.names, leaf, was, right)
        where = f" at {place.file}:{place.line}" if place is not None else ""
        text = f"{leaf.name} is {here}, the reference gives {there},{where} in scan {self.scan}"
        return mismatch(cause, leaf, was, right, place, text)

    def _order(self) -> Mismatch:
        """They go on with different statements."""
        place, other = _place(self.view, self.control.frames), _place(self.view, self.monitor.frames)
        texts = [f"{each.file}:{each.line}" if each is not None else "the end of the scan" for each in (place, other)]
        text = f"{texts[0]} is next, and {texts[1]} in the reference, in scan {self.scan}"
        return Mismatch("order", "next statement", b"", b"", place, text)


def _place(view: View, frames: tuple[Frame, ...]) -> Place | None:
    return view.reader.places.of(frames[0].site, frames) if frames else None


def _first_of(leaf: Leaf, found: set[int]) -> int:
    """Its first byte that differs."""
    return next((at for at in range(leaf.offset, leaf.offset + leaf.type.size) if at in found), leaf.offset)


def _sites(frames: tuple[Frame, ...]) -> list[tuple[object, int, int]]:
    return [(each.pou, each.instance, each.site) for each in frames]


def _reads(log: list[Access]) -> list[tuple[int, int, bytes]]:
    """What was read before it was written, by its place."""
    return [(each.offset, each.bits, each.value) for each, _ in Pass(None, 0, 0, log=log).fresh()]


def _still(names: list[str]) -> str:
    """`still different: Main.n, Main.m and 3 more`."""
    if not names:
        return ""
    more = len(names) - MOST_STILL
    return f"still different: {', '.join(names[:MOST_STILL])}" + (f" and {more} more" if more > 0 else "")
