"""What the processes of PLCs cost: CPU and memory, as the kernel counts them.

Read from /proc directly: a look at one process is two small files, so 200 of them every few seconds are no burden.
"""

import os
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from scanbench.runtime.clock import monotonic_ns

_TICK_NS = 1_000_000_000 // os.sysconf("SC_CLK_TCK")


@dataclass(frozen=True, slots=True)
class Load:
    """Of one process since the last look: CPU in percent of one core, and its proportional share of memory (PSS)."""

    cpu_percent: float = 0.0
    memory_bytes: int = 0


NO_LOAD = Load()


class Loads:
    """Looks at processes again and again."""

    def __init__(self, proc: Path = Path("/proc")) -> None:
        self._proc = proc
        self._last: dict[int, tuple[int, int]] = {}
        self._found: dict[int, Load] = {}

    def of(self, pid: int | None) -> Load:
        """What the last look found; nothing where there is no process, or it was not looked at yet."""
        return self._found.get(pid, NO_LOAD) if pid is not None else NO_LOAD

    def look(self, pids: Iterable[int]) -> dict[int, Load]:
        """The load of each; a process that is gone is not there. At the first look its CPU is 0.

        One look at a time, and not in an event loop: the kernel may let it wait. `of` may be called at the same time.
        """
        found: dict[int, Load] = {}
        seen: dict[int, tuple[int, int]] = {}
        for pid in pids:
            with suppress(OSError, ValueError, IndexError):
                memory, cpu, now = self._memory_bytes(pid), self._cpu_ns(pid), monotonic_ns()
                seen[pid] = cpu, now
                cpu_before, before = self._last.get(pid, (cpu, now))
                span = now - before
                # a number may belong to a new process by now, which has used less
                share = max(0.0, 100 * (cpu - cpu_before) / span) if span > 0 else 0.0
                found[pid] = Load(share, memory)
        self._last, self._found = seen, found
        return found

    def _cpu_ns(self, pid: int) -> int:
        fields = (self._proc / str(pid) / "stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) * _TICK_NS

    def _memory_bytes(self, pid: int) -> int:
        """PSS; what is resident where the kernel does not say that to us, which counts shared memory whole."""
        with suppress(OSError):
            for line in (self._proc / str(pid) / "smaps_rollup").read_text().splitlines():
                if line.startswith("Pss:"):
                    return int(line.split()[1]) * 1024
        pages = int((self._proc / str(pid) / "statm").read_text().split()[1])
        return pages * os.sysconf("SC_PAGESIZE")
