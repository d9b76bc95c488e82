"""The watch tap: thousands of values, twenty times a second, and only what changed.

Every watched value of up to 8 bytes is a row of one gather: eight byte indices, a shift (bits of an area) and a mask.
In-outs lead elsewhere at every call, so their rows are set again before each gather when their slots changed. Strings, and
the names of what references refer to, are texts. The bytes of a frame are described in `web/socket/frames.py`.
"""

import struct
from collections.abc import Iterable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from scanbench.program.program import Program
from scanbench.program.strings import characters
from scanbench.program.types import SLOT_BYTES, Elementary, Reference, StringType, Type
from scanbench.symbols.references import refers_to
from scanbench.symbols.symbols import Symbol

VALUES = 1
_HEAD = struct.Struct("<BBHIQq")
_U32 = struct.Struct("<I")
_TEXT = struct.Struct("<II")
_EIGHT = np.arange(8, dtype=np.int64)


class WatchPlan:
    """Watched symbols by id, and what the last frame said about them."""

    def __init__(self, program: Program, symbols: Mapping[int, Symbol], image_size: int) -> None:
        scalars = {id: symbol for id, symbol in symbols.items() if _is_number(symbol.type)}
        self._ids = np.array(list(scalars), dtype=np.uint32)
        self._symbols = list(scalars.values())
        count = len(scalars)
        self._places = np.zeros((count, 8), dtype=np.int64)
        self._shift = np.zeros(count, dtype=np.uint64)
        self._mask = np.zeros(count, dtype=np.uint64)
        self._last = np.zeros(count, dtype=np.uint64)
        self._fresh = np.ones(count, dtype=np.bool_)
        self._lost = np.zeros(count, dtype=np.bool_)
        self._image_size = image_size
        self._moving: list[tuple[int, Symbol]] = []
        self._located: dict[int, tuple[int, int | None] | None] = {}
        for row, symbol in enumerate(self._symbols):
            if symbol.slots:
                self._moving.append((row, symbol))
                self._lost[row] = True
            else:
                self._aim(row, symbol, symbol.offset, symbol.bit)
        self._texts = {id: symbol for id, symbol in symbols.items() if isinstance(symbol.type, StringType)}
        self._last_texts: dict[int, bytes] = {}
        self._program = program
        self._references = {id: symbol for id, symbol in symbols.items() if isinstance(symbol.type, Reference)}
        self._referred: dict[int, tuple[bytes, bytes]] = {}
        """By id of a reference: its bytes, and the text that they mean. Names are looked up only where it changed."""

    def __len__(self) -> int:
        return len(self._ids) + len(self._texts) + len(self._references)

    def keep_last(self, before: "WatchPlan", again: Iterable[int] = ()) -> None:
        """Takes over what the plan before this one has sent, but for the ids that are asked for `again`."""
        asked = set(again)
        known = {int(id): row for row, id in enumerate(before._ids) if not before._fresh[row]}
        for row, id in enumerate(self._ids.tolist()):
            old = known.get(id)
            if old is not None and id not in asked:
                self._last[row], self._fresh[row] = before._last[old], False
        for id in (*self._texts, *self._references):
            if id in before._last_texts and id not in asked:
                self._last_texts[id] = before._last_texts[id]

    def sample(self, memory: bytearray, scan: int, time_ns: int) -> bytes | None:
        """A frame of what changed since the last one; None when nothing did."""
        values = self._gather(memory)
        rows = np.flatnonzero(((values != self._last) | self._fresh) & ~self._lost)
        texts = self._changed_texts(memory)
        if not len(rows) and not texts:
            return None
        self._last = values
        self._fresh[rows] = False
        return self._frame(False, rows, values, texts, scan, time_ns)

    def snapshot(self, memory: bytearray, scan: int, time_ns: int) -> bytes:
        """A frame with every value. What the next `sample` compares with stays as it is: others have not seen this."""
        values = self._gather(memory)
        rows = np.flatnonzero(~self._lost)
        return self._frame(True, rows, values, dict(self._all_texts(memory)), scan, time_ns)

    def _gather(self, memory: bytearray) -> NDArray[np.uint64]:
        if self._moving:
            self._follow(memory)
        image = np.frombuffer(memory, dtype=np.uint8)
        raw = image[self._places].view(np.uint64).reshape(-1)
        return (raw >> self._shift) & self._mask

    def _follow(self, memory: bytearray) -> None:
        """Points the rows that lead through in-outs to the variables with which their blocks were last called."""
        for row, symbol in self._moving:
            place = symbol.locate(memory)
            if row in self._located and self._located[row] == place:
                continue
            self._located[row] = place
            self._lost[row] = place is None
            if place is not None:
                self._aim(row, symbol, *place)
                self._fresh[row] = True

    def _aim(self, row: int, symbol: Symbol, offset: int, bit: int | None) -> None:
        # The last bytes of the image are read from a little before, and shifted: no index leaves the image.
        start = min(offset, self._image_size - 8)
        self._places[row] = start + _EIGHT
        size = 1 if bit is not None else symbol.type.size
        self._shift[row] = 8 * (offset - start) + (bit or 0)
        self._mask[row] = 1 if bit is not None else (1 << 8 * size) - 1

    def _changed_texts(self, memory: bytearray) -> dict[int, bytes]:
        changed: dict[int, bytes] = {}
        for id, text in self._all_texts(memory):
            if self._last_texts.get(id) != text:
                changed[id] = self._last_texts[id] = text
        return changed

    def _all_texts(self, memory: bytearray) -> Iterator[tuple[int, bytes]]:
        for id, symbol in self._texts.items():
            text = _text(memory, symbol)
            if text is not None:
                yield id, text
        for id, symbol in self._references.items():
            place = symbol.locate(memory)
            if place is None:
                continue
            raw = bytes(memory[place[0] : place[0] + SLOT_BYTES])
            if self._referred.get(id, (b"",))[0] != raw:
                self._referred[id] = raw, refers_to(self._program, memory, symbol).encode()
            yield id, self._referred[id][1]

    def _frame(
        self, full: bool, rows: NDArray[np.intp], values: NDArray[np.uint64], texts: Mapping[int, bytes],
        scan: int, time_ns: int,
    ) -> bytes:  # fmt: skip
        count = len(rows)
        return b"".join(
            (
                _HEAD.pack(VALUES, full, 0, count, scan, time_ns),
                self._ids[rows].tobytes(),
                bytes(4 * (count % 2)),
                values[rows].tobytes(),
                _U32.pack(len(texts)),
                *(_TEXT.pack(id, len(text)) + text for id, text in texts.items()),
            )
        )


def _is_number(type: Type) -> bool:
    return isinstance(type, Elementary) and not isinstance(type, Reference)


def _text(memory: bytearray, symbol: Symbol) -> bytes | None:
    place = symbol.locate(memory)
    if place is None or not isinstance(symbol.type, StringType):
        return None
    start = place[0]
    return characters(symbol.type, bytes(memory[start : start + symbol.type.size]))
