"""A sampling in Python."""

from collections.abc import Sequence

from scanbench.engines.interpreter.memory import CANONICAL_NAN, packing
from scanbench.engines.interpreter.places import Read, Trapped
from scanbench.engines.sample import Sampling
from scanbench.program.layout import Layout


class Sampler:
    """Writes the rows of one sampling."""

    def __init__(self, sampling: Sampling, memory: bytearray, reads: Sequence[Read]) -> None:
        """`reads` are the sampling's signals, in their order."""
        self._sampling, self._memory = sampling, memory
        self._reads = [(read, packing(signal.type)) for read, signal in zip(reads, sampling.signals, strict=True)]

    @property
    def full(self) -> bool:
        """Whether there is no room for one more row."""
        return self._sampling.full

    def sample(self) -> bool:
        """Samples after a scan that has ended; false when there is no room for one more row."""
        sampling = self._sampling
        scan = int.from_bytes(self._memory[Layout.SCAN : Layout.SCAN + 8], "little") - 1
        if scan % sampling.every or scan < sampling.next:
            return True
        valid, values = 0, []
        for index, (read, packed) in enumerate(self._reads):
            try:
                value = read(0)
            except Trapped:
                values.append(0)
                continue
            data = CANONICAL_NAN[packed.size] if value != value else packed.pack(value)
            values.append(int.from_bytes(data, "little"))
            valid |= 1 << index
        return sampling.write(scan, valid, values)
