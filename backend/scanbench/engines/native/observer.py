"""The memory to which `emit_observed.STATE` points: what observed machine code notes, and where."""

import ctypes
import struct
from collections.abc import Iterable

from scanbench.engines.native import emit_observed, jit
from scanbench.engines.observe import Observer, ReadAt, Seen, areas_end
from scanbench.program.program import Program
from scanbench.symbols.sites import Sites

_HEAD = struct.Struct("<II")
_ENTRY = struct.Struct("<III")
_PADDING = 8
"""After the map: the code looks at the whole of a variable at once."""


class NativeObserver(Observer):
    """Reads what the code of one engine notes."""

    def __init__(self, program: Program, sites: Sites | None = None) -> None:
        super().__init__(program, sites)
        self._marks, self._spare_marks = (_memory(len(self.sites.statements)) for _ in range(2))
        self._map, self._spare_map = (_memory(areas_end(program.layout) + _PADDING) for _ in range(2))
        self._log = _memory(emit_observed.LOG_BYTES)
        self._watched: tuple[int, ...] = ()
        self._last: tuple[bytes, frozenset[int]] = b"", frozenset()

    def attach(self, code: jit.Code) -> None:
        """The code writes here from now on."""
        state = code.variable(emit_observed.STATE.removeprefix("@"))
        for field, memory in (
            (emit_observed.MARKS, self._marks),
            (emit_observed.MAP, self._map),
            (emit_observed.LOG, self._log),
            (emit_observed.OWN_MARKS, self._marks),
            (emit_observed.OWN_MAP, self._map),
            (emit_observed.SPARE_MARKS, self._spare_marks),
            (emit_observed.SPARE_MAP, self._spare_map),
        ):
            ctypes.c_uint64.from_address(state + field).value = ctypes.addressof(memory)

    def watch(self, bits: Iterable[tuple[int, int]]) -> None:
        masks = self._masks(bits)
        for offset in self._watched:
            self._map[offset] = 0
        for offset, mask in masks.items():
            self._map[offset] = mask
        self._watched = tuple(masks)

    def take(self) -> Seen:
        count, lost = _HEAD.unpack_from(self._log)
        reads = tuple(self._read(number) for number in range(count))
        if count:
            ctypes.memset(self._log, 0, emit_observed.ENTRIES)
        return Seen(self._reached(), reads, lost)

    def _read(self, number: int) -> ReadAt:
        at = emit_observed.ENTRIES + number * emit_observed.ENTRY_BYTES
        site, offset, mask = _ENTRY.unpack_from(self._log, at)
        return ReadAt(site, offset, mask)

    def _reached(self) -> frozenset[int]:
        marks = bytes(self._marks)
        ctypes.memset(self._marks, 0, len(marks))
        if marks != self._last[0]:  # most scans go the same way
            self._last = marks, frozenset(number for number, mark in enumerate(marks) if mark)
        return self._last[1]


def _memory(size: int) -> "ctypes.Array[ctypes.c_uint8]":
    return (ctypes.c_uint8 * size)()
