"""Values of many scans, none left out: the contract of sampling.

After a scan that has ended (phase 4 is done, `Layout.SCAN` counts it) an engine with samplings evaluates the signals of
each and writes a row into the sampling's ring, which lies in memory of Python's own. When a ring has no room left the engine comes
back as for an interrupt: whoever runs it takes the rows after every return, and none is lost. Sampling never changes the image.

A row: u64 number of the scan | u64 bit i: signal i has a value | u64 value[signals], the bytes of the variable (BOOL is 0
or 1), zero above them. A signal has no value where an in-out or a reference leads nowhere, an index is outside, and so on.
"""

import ctypes
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scanbench.check.typed.condition import Signal
from scanbench.program.program import Program

MAX_SIGNALS = 64
WORD = 8
HEAD_WORDS = 2
"""Of a row, before the values."""

TAKEN, WRITTEN, CAPACITY, NEXT, RING = 0, 8, 16, 24, 32
"""Byte offsets in the control block: u64 rows taken, rows written, rows that the ring holds; the first scan that is not
sampled yet (none is sampled twice, whoever runs it again); the address of the ring."""
BLOCK_BYTES = 40
RING_BYTES = 1 << 20
LEAST_ROWS = 256


class Sampling:
    """Signals of one program, a row of their values for each scan whose number is a multiple of `every`.

    With `changes` a row is written only when it differs from the last one that was: the first one always.
    """

    def __init__(
        self, program: Program, signals: Sequence[Signal], every: int = 1, changes: bool = False, rows: int | None = None
    ) -> None:  # fmt: skip
        if not 0 < len(signals) <= MAX_SIGNALS:
            raise ValueError(f"{len(signals)} signals; from 1 to {MAX_SIGNALS} can be sampled")
        if every < 1:
            raise ValueError(f"every {every} scans; 1 is the least")
        self.program, self.signals, self.every, self.changes = program, tuple(signals), every, changes
        self.words = HEAD_WORDS + len(self.signals)
        self.rows = rows if rows is not None else max(LEAST_ROWS, RING_BYTES // (WORD * self.words))
        self._ring = np.zeros((self.rows, self.words), dtype=np.uint64)
        self._block = (ctypes.c_uint64 * (BLOCK_BYTES // WORD))(0, 0, self.rows, 0, self._ring.ctypes.data)

    @property
    def address(self) -> int:
        """Of the control block; it stays as long as this object."""
        return ctypes.addressof(self._block)

    @property
    def waiting(self) -> int:
        """Rows that are there to be taken."""
        return self._block[1] - self._block[0]

    @property
    def full(self) -> bool:
        """Whether there is no room for one more row."""
        return self.waiting >= self.rows

    @property
    def next(self) -> int:
        """The first scan that is not sampled yet."""
        return self._block[3]

    def skip_to(self, scan: int) -> None:
        """Scans before this one are not sampled any more."""
        self._block[3] = max(self._block[3], scan)

    def take(self) -> NDArray[np.uint64]:
        """The rows since the last time, one after the other, as a copy. Not while the engine runs."""
        taken, written = self._block[0], self._block[1]
        first, count = taken % self.rows, written - taken
        self._block[0] = written
        if first + count <= self.rows:
            return self._ring[first : first + count].copy()
        return np.concatenate((self._ring[first:], self._ring[: first + count - self.rows]))

    def write(self, scan: int, valid: int, values: Sequence[int]) -> bool:
        """Adds a row, for an engine in Python; false when there is no room for one more."""
        self._block[3] = scan + 1
        written = self._block[1]
        row = np.array([scan, valid, *values], dtype=np.uint64)
        if self.changes and written and bool((self._ring[(written - 1) % self.rows][1:] == row[1:]).all()):
            return not self.full
        self._ring[written % self.rows] = row
        self._block[1] = written + 1
        return not self.full
