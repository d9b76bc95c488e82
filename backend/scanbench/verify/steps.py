"""Step by step: both sides at the same statement of a scan, compared there."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from scanbench.engines.debug import READ, WRITE, Frame, Listen
from scanbench.engines.engine import Reason, Stop
from scanbench.runtime.holds import held
from scanbench.runtime.resource import Resource
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.names import ANYWHERE, NamesInside
from scanbench.verify.both import Both, View, ViewOf
from scanbench.verify.contract import ENDED, Input, Mismatch, Output, Place, Row
from scanbench.verify.control import trap_of
from scanbench.verify.sentences import mismatch, values
from scanbench.verify.sides import Begin, Side
from scanbench.verify.uses import Access, Pass


class _Stepper:
    """Lets the scan run up to a statement, and notes what the one before it used."""

    def __init__(self, resource: Resource, count: int, first: Callable[[], None]) -> None:
        self._resource, self._count, self._first = resource, count, first
        self._engine = resource.loaded.debugged()
        self.log: list[Access] = []
        self.before: tuple[Frame, ...] = ()
        """The open calls before the statement before."""

    @property
    def listen(self) -> Listen:
        """To begin with."""
        return Listen(count=1)

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        if count == 1:
            self._first()
        if count >= self._count:
            return True
        if count == self._count - 1:
            self.before = self._engine.frames()
            self._resource.listening.listen(Listen(count=self._count, accesses=READ | WRITE))
        else:
            self._resource.listening.listen(Listen(count=self._count - 1))
        return False

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""
        value = bytes(self._resource.memory[offset : offset + size])
        self.log.append(Access(site, count, offset, size, self._engine.bits, written, value))

    def entered(self) -> None:
        """See `Onlooker`."""


@dataclass(slots=True)
class _Stood:
    """The present position of a side."""

    memory: bytes
    frames: tuple[Frame, ...]
    log: list[Access]
    before: tuple[Frame, ...]
    ended: bool
    """The scan is over."""
    trap: int = 0
    marks: dict[int, int] = field(default_factory=dict)
    """What was held, as the first statement began."""
    begin: bytes = b""
    """The whole image before the scan."""


def step_row(both: Both, scan: int, count: int, view_of: ViewOf) -> Row:
    """Runs both from the seam, before its entries, to the statement with this count (0: the seam before the scan)."""
    both.seam(scan)
    control, monitor = both.control.side, both.monitor.side
    view = view_of(control)
    if count <= 1:
        both.tell_disturbed(view, scan)
    bits = held(control.resource.journal)
    if count == 0 or not control.resource.runnable:
        mine = _Stood(bytes(control.memory), (), [], (), False)
        right = _Stood(bytes(monitor.memory), (), [], (), False)
    else:
        mine = _go(control, control.begin(), count, lambda: {at: control.memory[at] for at in bits})

        def give() -> dict[int, int]:
            for at, mask in bits.items():
                monitor.memory[at] = monitor.memory[at] & ~mask | mine.marks.get(at, 0) & mask
            return {}

        right = _go(monitor, monitor.begin(), count, give)
    return _Step(both, view, scan, count, mine, right).row()


def _go(side: Side, begin: Begin, count: int, first: Callable[[], dict[int, int]]) -> _Stood:
    marks: dict[int, int] = {}
    stepper = _Stepper(side.resource, count, lambda: marks.update(first()))

    def run() -> _Stood:
        stop: Stop = side.run(stepper, stepper.listen)
        inside = side.resource.listening.inside
        frames = inside.frames if inside is not None else ()
        ended = stop.reason is not Reason.HALTED
        return _Stood(
            bytes(side.memory), frames, stepper.log, stepper.before, ended, trap_of(stop), marks, begin.memory
        )

    return side.again(begin, run)


@dataclass(slots=True)
class _Step:
    """One row."""

    both: Both
    view: View
    scan: int
    count: int
    control: _Stood
    monitor: _Stood

    def row(self) -> Row:
        """What the previous statement used, and whether anything differs now."""
        reader, control, monitor = self.view.reader, self.control, self.monitor
        place = reader.places.of(control.frames[0].site, control.frames) if control.frames else None
        names = self._names()
        outputs: dict[str, Output] = {}
        for log, mine in ((control.log, True), (monitor.log, False)):
            for leaf, value in self._written(names, log):
                known = outputs.get(leaf.name, Output(None, None))
                outputs[leaf.name] = Output(value, known.monitor) if mine else Output(known.control, value)
        inputs = {
            leaf.name: Input(leaf.cut(access.value, access.offset))
            for access, _ in Pass(None, 0, 0, log=control.log).fresh()
            for leaf in names.at(access.offset, access.size, access.bits)
            if reader.columns.used(leaf._replace(passing=False), False)
        }
        note = ""
        if control.ended:
            note = ENDED if control.trap else "end of the scan"
        path = place.instance if place is not None else ""
        return Row(
            "step", self.scan, 0, 0 if control.ended else self.count, path, place, outputs, inputs,
            tuple(self._differences(place)), tuple(dict.fromkeys(self.both.told)), len(control.log), note,
        )  # fmt: skip

    def _names(self) -> NamesInside:
        """Those of the POU whose statement ran, where that is the range's."""
        names, before = self.view.reader.names, self.control.before
        if not before or before[0].pou not in self.view.range.pous:
            return names.within(ANYWHERE)
        return names.within(names.inside(before[0].pou, before[0].instance, self.control.memory))

    def _written(self, names: NamesInside, log: list[Access]) -> Iterator[tuple[Leaf, bytes]]:
        for access in log:
            if access.written:
                for leaf in names.at(access.offset, access.size, access.bits):
                    if self.view.reader.columns.used(leaf._replace(passing=False), True):
                        yield leaf, leaf.cut(access.value, access.offset)

    def _differences(self, place: Place | None) -> Iterator[Mismatch]:
        control, monitor, reader = self.control, self.monitor, self.view.reader
        yield from self.both.extra
        here = [(each.pou, each.instance, each.site) for each in control.frames]
        there = [(each.pou, each.instance, each.site) for each in monitor.frames]
        cut = control.trap != monitor.trap
        if cut:
            yield self.both.trap(self.view, self.scan, control.trap, monitor.trap)
        elif here != there or control.ended != monitor.ended:
            other = reader.places.of(monitor.frames[0].site, monitor.frames) if monitor.frames else None
            texts = [
                f"{each.file}:{each.line}" if each is not None else "the end of the scan" for each in (place, other)
            ]
            text = f"{texts[0]} is next, and {texts[1]} in the reference, in scan {self.scan}"
            yield Mismatch("order", "next statement", b"", b"", place, text)
        ran = control.log[-1].site if control.log else None
        before = None if ran is None else reader.places.of(ran, control.before)
        logs = (*control.log, *monitor.log)
        written = {at for each in logs if each.written for at in range(each.offset, each.offset + each.size)}
        begin = control.begin if cut or control.ended != monitor.ended else b""
        for leaf, mine in self._different(written, begin):
            was, right = (leaf.cut(each, 0) for each in (control.memory, monitor.memory))
            here_text, there_text = values(leaf, was, right)
            where = f" at {before.file}:{before.line}" if mine and before is not None else ""
            text = f"{leaf.name} is {here_text}, the reference gives {there_text},{where} in scan {self.scan}"
            yield mismatch("logic" if mine else "outside", leaf, was, right, before if mine else None, text)

    def _different(self, written: set[int], begin: bytes) -> Iterator[tuple[Leaf, bool]]:
        """The variables that differ now, and whether the previous statement wrote them."""
        control, monitor = self.control.memory, self.monitor.memory
        found = self.both.different(control, monitor, begin)
        mine = [at for at in found if at in written]
        for chosen, ours in ((mine, True), ([at for at in found if at not in written], False)):
            for leaf in self.both.leaves(self.view, chosen, control, monitor):
                yield leaf, ours
        for frame in self.control.frames:
            for leaf in self.view.reader.names.temporaries(frame.pou):
                if leaf.cut(control, 0) != leaf.cut(monitor, 0):
                    yield leaf, leaf.offset in written
