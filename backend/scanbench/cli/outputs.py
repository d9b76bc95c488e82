"""Files that a command writes in addition to what it prints: reports for people and for machines."""

from pathlib import Path

from scanbench.cli.inputs import usage


def must_be_writable(*paths: Path | None) -> None:
    """Before anything is computed: nobody waits for a report that has no place. None: that one is not wanted."""
    for path in paths:
        if path is not None:
            _must_be_writable(path)


def _must_be_writable(path: Path) -> None:
    new = not path.exists()
    try:
        path.open("ab").close()
        if new:
            path.unlink()
    except OSError as error:
        usage(f"{path} cannot be written: {error.strerror}")


def write_text(path: Path, text: str) -> None:
    """The whole file."""
    try:
        path.write_text(text, "utf-8")
    except OSError as error:
        usage(f"{path} cannot be written: {error.strerror}")
