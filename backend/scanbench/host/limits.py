"""What the process of one PLC may take from the machine."""

import resource
from pathlib import Path

_MIB = 1 << 20
_FILES = 256
_STACKS = 32 * _MIB
"""Threads reserve address space for their stacks, which counts, and use next to nothing of it."""
_RESERVE = 1 * _MIB


class MemoryLimit:
    """A bound for what this process takes beyond what it shares with others of its kind; none before `hold`."""

    def __init__(self) -> None:
        self._mib: int | None = None
        self._reserve = bytearray()

    def hold(self, mib: int | None) -> None:
        """From now on an allocation beyond `mib` is a `MemoryError`."""
        if mib is None:
            return
        self._mib, self._reserve = mib, bytearray(_RESERVE)
        _, hard = resource.getrlimit(resource.RLIMIT_DATA)
        limit = _data_bytes() + mib * _MIB + _STACKS
        # the soft one only: a compiler that this process starts gives itself more
        resource.setrlimit(resource.RLIMIT_DATA, (limit if hard < 0 else min(limit, hard), hard))

    def report(self, error: BaseException) -> str:
        """What to say of an allocation that failed; gives up a reserve, so that it can be said."""
        self._reserve = bytearray()
        detail = f" ({error})" if str(error) else ""
        if self._mib is None:
            return f"out of memory: the machine has none left{detail}. End other instances, or use a smaller program"
        return (
            f"out of memory: limit {self._mib} MiB{detail}. Raise the limit of the instance, or use a smaller program"
        )


def limit_files() -> None:
    """A leak of files is to end this process, not to take those of the machine."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if soft > _FILES or soft < 0:
        resource.setrlimit(resource.RLIMIT_NOFILE, (_FILES, hard))


def _data_bytes() -> int:
    """Writable memory of this process, as the limit counts it."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmData:"):
            return int(line.split()[1]) * 1024
    return 0
