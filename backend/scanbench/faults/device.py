"""The device's own view of its errors: what is read from its memory, as any tool would read it.

Nothing here asks who raised an error. So what a program or a protocol client wrote shows too, and what the memory does not
say is not shown: a number that is only in an error code is known while the code word or the error log has that code.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from scanbench.faults.device_log import clock_text, messages, records
from scanbench.faults.device_memory import Memory
from scanbench.faults.device_present import present
from scanbench.faults.device_shapes import DeviceErrors, DeviceStandby
from scanbench.faults.standby import active_side, causes_on, is_duplex
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.overlaps import Stretch, stretch, stretches
from scanbench.program.layout import Layout
from scanbench.runtime.command import View


def read_device(view: View, past: bool = False) -> DeviceErrors:
    """Everything that a tool's window of errors shows, at the scan that the view shows."""
    memory = Memory(view.memory, view.program.layout)
    log = records(memory)
    return DeviceErrors(
        scan=view.header.scan,
        past=past,
        code=memory.code_text,
        codes=view.model.code_form,
        has_log=view.model.log is not None,
        keeps_latest=view.model.log is None and view.model.error_time is not None,
        errors=tuple(present(memory, log)),
        log=log,
        messages=messages(memory),
        standby=_standby(view, memory),
    )


def _standby(view: View, memory: Memory) -> DeviceStandby | None:
    standby, layout = view.model.standby, view.program.layout
    if standby is None:
        return None
    causes = tuple(causes_on(view.memory, layout, standby))
    time = "" if standby.time is None or not causes else clock_text(memory, standby.time, standby.fields)
    return DeviceStandby(is_duplex(view.memory, layout), active_side(view.memory, layout, standby), causes, time)


@dataclass(slots=True)
class Watched:
    """Whether anything changed that `read_device` reads, found out in microseconds."""

    layout: Layout
    _parts: tuple[tuple[int, int], ...] = ()
    _last: bytes | None = None

    def __post_init__(self) -> None:
        self._parts = tuple(_joined(sorted(_bytes(self.layout))))

    def changed(self, memory: bytearray | bytes | memoryview) -> bool:
        """Since it was asked last; true the first time."""
        now = b"".join(memory[start:end] for start, end in self._parts)
        if now == self._last:
            return False
        self._last = now
        return True


def _bytes(layout: Layout) -> Iterator[tuple[int, int]]:
    for bits in _read(layout.model):
        start = layout.areas[bits.area]
        yield start + bits.first // 8, start + -(-bits.end // 8)


def _read(model: Model) -> Iterator[Stretch]:
    if model.code_word is not None:
        yield stretch(model.code_word)
    if model.log is not None:
        yield stretch(model.log.first, model.log.records * model.log.words)
        yield stretch(model.log.counter)
    if model.error_time is not None:
        yield stretch(model.error_time.first, -(-len(model.error_time.fields) // 2))
    for told in () if model.standby is None else model.standby.places:
        yield stretch(told, -(-told.bits // 16))
    for query in model.queries:
        yield stretch(query.code)
    for _, place, words in model.texts():
        yield stretch(place.first, words)
    for error in model.errors():
        yield stretch(error.flag)
        yield from stretches(error.also)
        for detail in error.details:
            yield from stretches(detail.addresses)


def _joined(parts: list[tuple[int, int]]) -> Iterator[tuple[int, int]]:
    """Without overlaps."""
    at: tuple[int, int] | None = None
    for start, end in parts:
        if at is not None and start <= at[1]:
            at = at[0], max(at[1], end)
            continue
        if at is not None:
            yield at
        at = start, end
    if at is not None:
        yield at
