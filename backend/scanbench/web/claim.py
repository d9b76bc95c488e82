"""One server a data directory: two would each run the same PLCs, and write over each other's history."""

import fcntl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

FILE = "lock"


class InUse(Exception):
    """Another server holds the directory."""


@contextmanager
def claimed(data_dir: Path) -> Iterator[None]:
    """Holds the directory as long as the block runs; the system lets go when the process dies."""
    with (data_dir / FILE).open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise InUse(f"{data_dir} is used by another server: stop that one, or give a different --data") from error
        yield
