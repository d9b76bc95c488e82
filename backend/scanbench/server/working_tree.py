"""The files of a folder under `git`: what other programs changed there, and writing what was committed."""

import os
import stat
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path

from scanbench.syntax.source import decode
from scanbench.wire.refused import Refused

LARGEST = 16 << 20
"""Bytes of a file: a larger one is none of a project."""


class Foreign:
    """Looks for files that another program changed and did not commit."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def found(self, committed: Mapping[str, str], now: Mapping[str, str]) -> list[str]:
        """Paths whose file in the folder is neither what was committed nor what is to be written."""
        return [
            path for path in sorted({*committed, *now}) if self._is_foreign(path, committed.get(path), now.get(path))
        ]

    def _is_foreign(self, path: str, committed: str | None, now: str | None) -> bool:
        try:
            there = decode(_content(inside(self._folder, path)))
        except (FileNotFoundError, NotADirectoryError):
            return False  # also one that was deleted there: a commit writes it again
        except OSError as error:
            raise Refused(f"{path} in {self._folder} cannot be read: {error.strerror}") from error
        return there not in (committed, now)


def write(folder: Path, texts: Mapping[str, str], gone: Iterable[str]) -> None:
    """Writes the files of a commit, and removes those that it no longer has."""
    try:
        for path in gone:
            with suppress(FileNotFoundError):
                inside(folder, path).unlink()
        for path, text in texts.items():
            file, content = inside(folder, path), text.encode()
            with suppress(FileNotFoundError, NotADirectoryError):
                if _content(file) == content:
                    continue
            file.parent.mkdir(parents=True, exist_ok=True)
            _put(folder / ".git", file, content)
    except OSError as error:
        raise Refused(f"the commit was made, but {folder} could not be written: {error.strerror}") from error


def _content(file: Path) -> bytes:
    """The bytes of a file; `Refused` for what is none (reading a pipe would wait for ever), or too large."""
    kind = file.lstat()
    if not stat.S_ISREG(kind.st_mode):
        raise Refused(f"{file} is no file: remove it, then try again")
    if kind.st_size > LARGEST:
        raise Refused(
            f"{file} has more than {LARGEST >> 20} MiB, too much for a file of a project: remove it, then try again"
        )
    with open(os.open(file, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as opened:
        return opened.read(LARGEST + 1)


def _put(kept: Path, file: Path, content: bytes) -> None:
    """Puts a file in place whole. It is written in the folder of git, as nobody else's repository brings anything there: not in a
    folder of the project, where a link could have its name.
    """
    fresh = kept / "scanbench.new"
    try:
        fresh.unlink(missing_ok=True)  # of a server that was killed while it wrote
        with open(os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o666), "wb") as opened:
            opened.write(content)
        os.replace(fresh, file)
    except OSError:
        fresh.unlink(missing_ok=True)
        raise


def inside(folder: Path, path: str) -> Path:
    """The file of a path; `Refused` where a link in the folder leads elsewhere, or into what git keeps."""
    file = folder / path
    links = [
        each for each in [file, *file.parents] if each.is_relative_to(folder) and each != folder and each.is_symlink()
    ]
    if links or ".git" in {part.lower() for part in Path(path).parts} or ".." in Path(path).parts:
        raise Refused(f"{path} in {folder} cannot be written: a link or a folder of git is in the way")
    return file
