"""Names for people who gave none. The count is kept over restarts, so that a name never means two people."""

from collections.abc import Callable
from pathlib import Path

FILE = "guests"


def kept_guests(data_dir: Path) -> Callable[[], str]:
    """Gives `Guest 1`, `Guest 2`, ..., and goes on from there after a restart."""
    path = data_dir / FILE

    def next_guest() -> str:
        try:
            count = int(path.read_text("ascii"))
        except (FileNotFoundError, ValueError):
            count = 0
        path.write_text(str(count + 1), "ascii")
        return f"Guest {count + 1}"

    return next_guest
