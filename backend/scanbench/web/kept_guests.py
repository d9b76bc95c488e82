"""Names for people who gave none. The count is kept over restarts, so that a name never means two people."""

import logging
import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

FILE = "guests"
log = logging.getLogger("scanbench")


def kept_guests(data_dir: Path) -> Callable[[], str]:
    """Gives `Guest 1`, `Guest 2`, ..., and goes on from there after a restart. Where the count cannot be kept, on a full disk
    say, somebody gets a name all the same; the count as it was kept last stays."""
    path = data_dir / FILE
    last = 0

    def next_guest() -> str:
        nonlocal last
        with suppress(FileNotFoundError, ValueError):
            last = max(last, int(path.read_text("ascii")))
        last += 1
        try:
            _keep(path, last)
        except OSError as error:
            log.error("%s cannot be written: %s", path, error)
        return f"Guest {last}"

    return next_guest


def _keep(path: Path, count: int) -> None:
    """In the place of what was there, and only when it is all written."""
    part = path.with_name(f"{path.name}.part")
    part.write_text(str(count), "ascii")
    os.replace(part, path)
