"""Files of the program -> what clients call them, and back: names of the project, or files on the client's disk."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable

from scanbench.web.dap.shapes import Body, Source
from scanbench.wire.refused import Refused

Files = Callable[[], Iterable[str]]
"""The files of the program that runs, by their paths in the project."""


class Paths(ABC):
    """How one client names files."""

    def __init__(self, files: Files) -> None:
        self._files = files

    @abstractmethod
    def source(self, file: str) -> Body:
        """A file, as a `Source` for the client."""

    @abstractmethod
    def _named(self, source: Source) -> str:
        """Its path in the project, whether there is such a file or not."""

    def file(self, source: Source) -> str:
        """Path in the project of what the client means; `Refused` when the program has no such file."""
        file = self._named(source)
        if file not in self._files():
            shown = source.path or source.name or f"source {source.source_reference}"
            raise Refused(f"{shown} is no file of the program that runs")
        return file


class ProjectPaths(Paths):
    """The browser's: as the project has them."""

    def source(self, file: str) -> Body:
        """Name and path."""
        return {"name": file.rpartition("/")[2], "path": file}

    def _named(self, source: Source) -> str:
        return source.path


class FolderPaths(Paths):
    """Files below a folder of the client's machine, which need not be this one."""

    def __init__(self, files: Files, root: str, other: str = "") -> None:
        """`other` is a second name of the same folder."""
        super().__init__(files)
        self._root = root.rstrip("/\\")
        self._roots = [_plain(each) for each in (root, other) if each]

    def source(self, file: str) -> Body:
        """Name and absolute path."""
        bend = "\\" if "\\" in self._root else "/"
        return {"name": file.rpartition("/")[2], "path": bend.join((self._root, *file.split("/")))}

    def _named(self, source: Source) -> str:
        for root in self._roots:
            if _plain(source.path).startswith(f"{root}/"):
                parts = source.path.replace("\\", "/").split("/")
                return "/".join(parts[root.count("/") + 1 :])
        return source.path


class ServerPaths(Paths):
    """Files that only the server has: the client asks for their text by number."""

    def __init__(self, files: Files) -> None:
        super().__init__(files)
        self._numbers: dict[str, int] = {}

    def source(self, file: str) -> Body:
        """Name, path and number."""
        number = self._numbers.setdefault(file, len(self._numbers) + 1)
        return {"name": file.rpartition("/")[2], "path": file, "sourceReference": number}

    def _named(self, source: Source) -> str:
        if source.source_reference:
            return next((file for file, number in self._numbers.items() if number == source.source_reference), "")
        if source.path in self._files():
            return source.path
        # a file on the client's disk: the one that its path ends with
        path = _plain(source.path)
        ends = [file for file in self._files() if path.endswith((f"/{file}", f"/{file.casefold()}"))]
        return max(ends, key=len, default=source.path)


def _plain(path: str) -> str:
    """With slashes; Windows does not care for case."""
    plain = path.replace("\\", "/").rstrip("/")
    return plain.casefold() if plain[1:2] == ":" or path.startswith("\\\\") else plain
