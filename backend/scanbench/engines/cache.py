"""What was built before, kept by key in a directory. Never in the way: what cannot be read or written is built again."""

import fcntl
import hashlib
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_MAGIC = b"scanbench 1\n"
_DIGEST_BYTES = 32
_SUFFIX = ".kept"
LIMIT_BYTES = 256 << 20
"""Of a directory; beyond it, what was used longest ago goes."""
_WRITES_BETWEEN_LOOKS = 200
_ABANDONED_S = 3600


class BlobCache:
    """A bounded directory of bytes by key. Several processes may use it at the same time.

    A file is written whole or not at all, and read only when its checksum is right; so a reader gets what a writer put
    there under this key, or nothing. That the key says everything that the bytes depend on is the caller's business.
    """

    def __init__(self, directory: Path, limit: int = LIMIT_BYTES) -> None:
        self._directory, self._limit = directory, limit
        self._writes = 0

    def get(self, key: str) -> bytes | None:
        """What was put under the key, or None."""
        path = self._path(key)
        try:
            data = path.read_bytes()
        except OSError:
            return None
        head = len(_MAGIC) + _DIGEST_BYTES
        content = data[head:]
        if data[:head] != _MAGIC + hashlib.sha256(content).digest():
            with suppress(OSError):
                path.unlink()
            return None
        with suppress(OSError):
            os.utime(path)  # used just now
        return content

    def put(self, key: str, content: bytes) -> None:
        """Keeps the bytes under the key."""
        try:
            self._directory.mkdir(parents=True, exist_ok=True)
            handle, name = tempfile.mkstemp(dir=self._directory)
            try:
                with os.fdopen(handle, "wb") as file:
                    file.write(_MAGIC + hashlib.sha256(content).digest() + content)
                os.replace(name, self._path(key))
            except OSError:
                Path(name).unlink(missing_ok=True)
        except OSError:
            return
        if self._writes % _WRITES_BETWEEN_LOOKS == 0:
            self._make_room()
        self._writes += 1

    @contextmanager
    def claimed(self, key: str) -> Iterator[None]:
        """Waits while a different process holds the claim to the key: it may be compiling the same code.

        The next look into the cache then finds that code. A process that ends gives up its claims.
        """
        try:
            self._directory.mkdir(parents=True, exist_ok=True)
            handle = os.open(self._directory / f"{key}.claim", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        except OSError:
            yield
            return
        try:
            with suppress(OSError):  # a file system without locks: it is made twice
                fcntl.flock(handle, fcntl.LOCK_EX)
            yield
        finally:
            os.close(handle)

    def _path(self, key: str) -> Path:
        return self._directory / f"{key}{_SUFFIX}"

    def _make_room(self) -> None:
        """Removes what was used longest ago, until three quarters of the limit are left, and what a writer abandoned."""
        kept: list[tuple[float, int, str]] = []
        unfinished: list[tuple[float, str]] = []
        for entry in os.scandir(self._directory):
            with suppress(OSError):  # a different process was faster
                status = entry.stat()
                if entry.name.endswith(_SUFFIX):
                    kept.append((status.st_mtime, status.st_size, entry.path))
                else:
                    unfinished.append((status.st_mtime, entry.path))
        newest = max((at for at, _, _ in kept), default=0.0)
        gone = [path for at, path in unfinished if at < newest - _ABANDONED_S]
        total = sum(size for _, size, _ in kept)
        if total > self._limit:
            for _, size, path in sorted(kept):
                if total <= self._limit * 3 // 4:
                    break
                gone.append(path)
                total -= size
        for path in gone:
            with suppress(OSError):
                os.unlink(path)
