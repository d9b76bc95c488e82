"""The files of a folder under `git`: what other programs changed there, and writing what was committed."""

import os
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path

from scanbench.syntax.source import decode
from scanbench.wire.refused import Refused


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
            there = decode(inside(self._folder, path).read_bytes())
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
            if file.is_file() and file.read_bytes() == content:
                continue
            file.parent.mkdir(parents=True, exist_ok=True)
            fresh = file.with_name(f".{file.name}.new")
            fresh.write_bytes(content)
            os.replace(fresh, file)
    except OSError as error:
        raise Refused(f"the commit was made, but {folder} could not be written: {error.strerror}") from error


def inside(folder: Path, path: str) -> Path:
    """The file of a path; `Refused` where a link in the folder leads elsewhere, or into what git keeps."""
    file = folder / path
    links = [
        each for each in [file, *file.parents] if each.is_relative_to(folder) and each != folder and each.is_symlink()
    ]
    if links or ".git" in {part.lower() for part in Path(path).parts} or ".." in Path(path).parts:
        raise Refused(f"{path} in {folder} cannot be written: a link or a folder of git is in the way")
    return file
