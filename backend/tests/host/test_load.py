"""What processes cost, as the kernel counts it."""

import os
from pathlib import Path

from scanbench.host.load import NO_LOAD, Loads
from scanbench.runtime.clock import monotonic_ns


def test_a_process_that_works_has_a_load() -> None:
    loads, me = Loads(), os.getpid()
    first = loads.look([me])[me]
    assert first.cpu_percent == 0
    assert first.memory_bytes > 1 << 20
    end = monotonic_ns() + 300_000_000
    while monotonic_ns() < end:
        pass
    second = loads.look([me])
    assert second[me].cpu_percent > 0
    assert loads.of(me) == second[me]


def test_a_process_that_is_gone_has_none() -> None:
    loads, me = Loads(), os.getpid()
    assert set(loads.look([me, 1 << 30])) == {me}
    assert loads.of(1 << 30) == NO_LOAD
    assert loads.of(None) == NO_LOAD
    loads.look([])
    assert loads.of(me) == NO_LOAD


def put(proc: Path, pid: int, ticks: int, **files: str) -> None:
    folder = proc / str(pid)
    folder.mkdir(parents=True, exist_ok=True)
    fields = ["S", *["0"] * 10, str(ticks), str(ticks), *["0"] * 20]
    (folder / "stat").write_text(f"{pid} (a name) with ) in it) {' '.join(fields)}")
    for name, text in files.items():
        (folder / name).write_text(text)


def test_a_number_that_belongs_to_a_new_process_now(tmp_path: Path) -> None:
    loads = Loads(tmp_path)
    put(tmp_path, 7, 5000, smaps_rollup="00-ff ---p 00000000 00:00 0 [rollup]\nRss: 900 kB\nPss: 300 kB\n")
    assert loads.look([7])[7].memory_bytes == 300 * 1024
    put(tmp_path, 7, 3)
    assert loads.look([7])[7].cpu_percent == 0


def test_where_the_kernel_tells_no_shares(tmp_path: Path) -> None:
    put(tmp_path, 7, 0, statm="100 25 3 4 5 6 7")
    assert Loads(tmp_path).look([7])[7].memory_bytes == 25 * os.sysconf("SC_PAGESIZE")
