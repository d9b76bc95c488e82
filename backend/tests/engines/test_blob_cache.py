"""The directory of what was built before."""

import os
import subprocess
import sys
import threading
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from scanbench.engines.cache import BlobCache


def test_what_was_put_is_given(tmp_path: Path) -> None:
    cache = BlobCache(tmp_path / "made" / "by itself")
    assert cache.get("a") is None
    cache.put("a", b"one")
    cache.put("b", b"")
    cache.put("a", b"two")
    assert (cache.get("a"), cache.get("b")) == (b"two", b"")


def test_a_broken_file_is_nothing_and_goes(tmp_path: Path) -> None:
    cache = BlobCache(tmp_path)
    for broken in (b"", b"short", b"x" * 500):
        cache.put("a", b"content" * 50)
        (path,) = tmp_path.iterdir()
        path.write_bytes(broken)
        assert cache.get("a") is None
        assert not path.exists()


def test_what_was_used_longest_ago_goes_first(tmp_path: Path) -> None:
    for number in range(10):
        BlobCache(tmp_path).put(str(number), bytes(1000))
        os.utime(tmp_path / f"{number}.kept", (number, number))
    assert BlobCache(tmp_path).get("0") is not None  # used just now
    (tmp_path / "unfinished").write_bytes(b"")
    os.utime(tmp_path / "unfinished", (1, 1))
    BlobCache(tmp_path, limit=6000).put("new", bytes(1000))
    kept = {path.stem for path in tmp_path.iterdir()}
    assert {"new", "0", "9"} <= kept
    assert not {"1", "2", "3", "4", "unfinished"} & kept


def test_where_nothing_can_be_written_nothing_is_kept(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no directory")
    cache = BlobCache(tmp_path / "file" / "below")
    cache.put("a", b"one")
    assert cache.get("a") is None


def write_many(directory: Path, number: int) -> int:
    cache, wrong = BlobCache(directory, limit=50_000), 0
    for each in range(200):
        key = str((number + each) % 20)
        cache.put(key, key.encode() * 3000)
        found = cache.get(str(each % 20))
        wrong += found is not None and found != str(each % 20).encode() * 3000
    return wrong


def test_several_processes_at_once(tmp_path: Path) -> None:
    with ProcessPoolExecutor(3, get_context("spawn")) as pool:
        assert sum(pool.map(write_many, [tmp_path] * 3, range(3))) == 0


_CLAIMING = """
import sys, time
from pathlib import Path
from scanbench.engines.cache import BlobCache
with BlobCache(Path(sys.argv[1])).claimed("key"):
    print("claimed", flush=True)
    time.sleep(600)
"""


def test_a_claim_lasts_as_long_as_its_process(tmp_path: Path) -> None:
    cache, entered = BlobCache(tmp_path), threading.Event()

    def wait() -> None:
        with cache.claimed("key"):
            entered.set()

    with subprocess.Popen([sys.executable, "-c", _CLAIMING, str(tmp_path)], stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "claimed\n"
        with cache.claimed("another key"):
            pass
        waiting = threading.Thread(target=wait)
        waiting.start()
        assert not entered.wait(0.1)
        other.kill()
        assert entered.wait(60)
        waiting.join()


def test_where_nothing_can_be_claimed_everybody_goes_on(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with BlobCache(tmp_path / "file" / "below").claimed("key"):
        pass
