"""Variables by their paths, whole, as protocol clients read them: many at once, the same ones again and again."""

from collections.abc import Sequence

import numpy as np

from scanbench.program.program import Program
from scanbench.program.types import BOOL
from scanbench.runtime.header import Header
from scanbench.runtime.programs import Loaded
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.wire.variables import ReadVariables, VariablesAre

_PLANS = 64
"""Lists of paths that are remembered."""
_SYMBOLS = 50_000
"""Paths, too."""


class Variables:
    """Answers `ReadVariables`. Which bytes a list of paths means is found once for each program."""

    def __init__(self) -> None:
        self._program: Program | None = None
        self._plans: dict[tuple[str, ...], _Gather] = {}
        self._symbols: dict[str, Symbol | None] = {}

    def are(self, question: ReadVariables, loaded: Loaded, memory: bytes | bytearray) -> VariablesAre:
        """The answer, from an image."""
        program, header = loaded.program, Header(memory)
        if program is not self._program:
            self._program = program
            self._plans.clear()
            self._symbols.clear()
        plan = self._plans.pop(question.paths, None) or _Gather(
            [self._symbol(program, each) for each in question.paths]
        )
        self._plans[question.paths] = plan  # the dict keeps the order of use
        while len(self._plans) > _PLANS:
            del self._plans[next(iter(self._plans))]
        there, data = plan.read(memory)
        return VariablesAre(
            question.ref, loaded.version, header.scan, header.mode.name, bool(header.halt),
            header.epoch_ns + header.next_clock_ns(program.interval_ns), there, data,
        )  # fmt: skip

    def _symbol(self, program: Program, path: str) -> Symbol | None:
        """The variable; a list that has one more than the last one is quick to plan."""
        if path not in self._symbols:
            if len(self._symbols) >= _SYMBOLS:
                self._symbols.clear()
            try:
                self._symbols[path] = resolve(program, path)
            except UnknownPath:
                self._symbols[path] = None
        return self._symbols[path]


class _Gather:
    """Copies the bytes of many variables: those that stay where they are by one index, the others one by one."""

    def __init__(self, symbols: Sequence[Symbol | None]) -> None:
        places: list[np.ndarray[tuple[int], np.dtype[np.int64]]] = []
        self._there = bytearray(len(symbols))
        self._moving: list[tuple[int, int, Symbol]] = []
        """Number of the path, byte of the answer, symbol: what is reached through in-outs and references."""
        at, bits = 0, []
        for number, symbol in enumerate(symbols):
            if symbol is None:
                continue
            size = 1 if symbol.bit is not None else symbol.type.size
            if symbol.slots:
                self._moving.append((number, at, symbol))
                places.append(np.zeros(size, dtype=np.int64))
            else:
                self._there[number] = 1
                places.append(np.arange(symbol.offset, symbol.offset + size, dtype=np.int64))
                if symbol.bit is not None:
                    bits.append((at, symbol.bit))
            at += size
        self._places = np.concatenate(places) if places else np.zeros(0, dtype=np.int64)
        self._bits = np.array([each for each, _ in bits], dtype=np.int64)
        self._shifts = np.array([each for _, each in bits], dtype=np.uint8)

    def read(self, memory: bytes | bytearray) -> tuple[bytes, bytes]:
        """Which are there, and their bytes."""
        data = np.frombuffer(memory, dtype=np.uint8)[self._places]
        if len(self._bits):
            data[self._bits] = data[self._bits] >> self._shifts & 1
        if not self._moving:
            return bytes(self._there), data.tobytes()
        return self._followed(memory, bytearray(data.tobytes()))

    def _followed(self, memory: bytes | bytearray, data: bytearray) -> tuple[bytes, bytes]:
        there = bytearray(self._there)
        for number, at, symbol in reversed(self._moving):  # from the end: what is nowhere takes no room
            place = symbol.locate(memory)
            size = 1 if symbol.bit is not None else symbol.type.size
            if place is None:
                del data[at : at + size]
                continue
            there[number] = 1
            offset, bit = place
            data[at : at + size] = memory[offset : offset + size]
            if bit is not None and symbol.type == BOOL:
                data[at] = data[at] >> bit & 1
        return bytes(there), bytes(data)
