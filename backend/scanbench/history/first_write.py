"""Which statement of a scan wrote any of some variables first."""

from collections.abc import Iterator, Sequence

from scanbench.debug.frames import frame_name, instance_path, task_of
from scanbench.engines.debug import WRITE, Frame, Listen
from scanbench.engines.engine import Reason
from scanbench.history.contract import Change
from scanbench.recording.reader import RunReader
from scanbench.runtime.resource import Resource
from scanbench.symbols.symbols import UnknownPath, resolve
from scanbench.verify.contract import Place

Owners = dict[int, list[tuple[int, Change]]]
"""By byte: which bits of it are whose."""


class _Writes:
    """Notes which statement wrote what first; halts nowhere."""

    def __init__(self, resource: Resource, owners: "Owners") -> None:
        self._resource, self._owners = resource, owners
        self.found: tuple[int, int, Change] | None = None
        self.frames: tuple[Frame, ...] = ()

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        return False

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""
        if self.found is not None or not written:
            return
        engine = self._resource.loaded.debugged()
        theirs = (each for at in range(offset, offset + size) for each in self._owners.get(at, ()))
        change = next((each for mask, each in theirs if mask & engine.bits), None)
        if change is not None:
            self.found = count, site, change
            self.frames = engine.frames()

    def entered(self) -> None:
        """See `Onlooker`."""


def first_write(reader: RunReader, scan: int, changes: Sequence[Change]) -> tuple[int, Place, Change] | None:
    """The first write of one of these variables in a scan: its count, where, and which; None where no statement did that."""
    timeline = reader.timeline
    if timeline.goto(scan, 1) is not None:
        return None  # no statement ran
    resource = timeline.resource
    owners: Owners = {}
    for each in changes:
        for at, mask in _bytes(resource, each):
            owners.setdefault(at, []).append((mask, each))
    writes = _Writes(resource, owners)
    with resource.listening.instead(writes, Listen(bytes=dict.fromkeys(owners, WRITE))):
        while timeline.go_on(scan + 1).reason is Reason.INTERRUPTED:
            pass
    if writes.found is None:
        return None
    count, site, change = writes.found
    program, frames = resource.loaded.statements, writes.frames
    span = resource.loaded.debugged().sites.statements[site].span
    frame = frames[0]
    instance = instance_path(program, frame) or frame_name(program, frame)
    text = reader.text(resource.version, span.file, span.line)
    return count, Place(task_of(program, frames), instance, frame.pou.name, span.file, span.line, text), change


def _bytes(resource: Resource, change: Change) -> Iterator[tuple[int, int]]:
    """Where the variable is in the program that runs, with the bits of each byte that are its own."""
    try:
        symbol = resolve(resource.program, change.path)
    except UnknownPath:
        return
    place = None if symbol.slots else symbol.locate(resource.memory)
    if place is not None:
        offset, bit = place
        mask = 0xFF if bit is None else 1 << bit
        yield from ((at, mask) for at in range(offset, offset + symbol.type.size))
