"""The project that an editor works on: texts that are open in the editor over those that are saved."""

from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Protocol
from urllib.parse import quote, unquote, urlsplit

from lsprotocol import types

from scanbench.language.reading import Reading, Readings
from scanbench.plcmodel.load import NoSuchModel, model_named
from scanbench.plcmodel.model import Model
from scanbench.server.from_disk import DEFAULT_MODEL, program_files, project_model, read_text
from scanbench.syntax.parse_file import is_program_file
from scanbench.wire.refused import Refused

SCHEME = "scanbench"
"""Of the addresses that the browser's editor gives to the files of a project."""


class Saved(Protocol):
    """Where the files are that are not open."""

    @property
    def model(self) -> str:
        """Name of the project's model."""

    def texts(self) -> Mapping[str, str]:
        """Every program file, by its name in the project."""

    def uri(self, file: str) -> str:
        """How the editor calls a file."""

    def file(self, uri: str) -> str | None:
        """The name in the project of what the editor calls so; None where it is not of the project."""


class Folder:
    """A project in a folder on this machine."""

    def __init__(self, root: Path) -> None:
        self._root = root.absolute()  # and no further: files are called as the editor calls them

    @property
    def model(self) -> str:
        try:
            return project_model(self._root) or DEFAULT_MODEL
        except Refused:
            return DEFAULT_MODEL

    def texts(self) -> Mapping[str, str]:
        try:
            paths = program_files(self._root)
        except Refused:  # a folder without programs
            return {}
        found = {}
        for path in paths:
            with suppress(Refused):  # what cannot be read is not there for an editor either
                found[path.relative_to(self._root).as_posix()] = read_text(path)
        return found

    def uri(self, file: str) -> str:
        return "file://" + quote((self._root / file).as_posix())

    def file(self, uri: str) -> str | None:
        path = Path(unquote(urlsplit(uri).path))
        return path.relative_to(self._root).as_posix() if path.is_relative_to(self._root) else None


class Told:
    """A project of a server, which tells its files (`scanbench/files`): who edits it is a browser."""

    def __init__(self, model: str, files: Mapping[str, str]) -> None:
        self.model = model
        self.files = files

    def texts(self) -> Mapping[str, str]:
        return self.files

    def uri(self, file: str) -> str:
        return f"{SCHEME}:/{quote(file)}"

    def file(self, uri: str) -> str | None:
        return unquote(urlsplit(uri).path).lstrip("/")


def told_by(params: types.InitializeParams) -> Saved:
    """The project that the server adds to what the browser asks for."""
    told = params.initialization_options
    model, files = (told.get("model"), told.get("files")) if isinstance(told, dict) else (None, None)
    return Told(model if isinstance(model, str) else DEFAULT_MODEL, files if isinstance(files, dict) else {})


class LspProject:
    """All texts as the editor has them, and what is known of them; read again when somebody asks after a change."""

    def __init__(self, saved: Saved) -> None:
        self.saved = saved
        self._open: dict[str, str] = {}
        self._texts: Mapping[str, str] = saved.texts()
        self._model = saved.model
        self._readings = Readings(model_of(self._model))
        self._reading: Reading | None = None

    def open(self, uri: str, text: str) -> None:
        """The editor has this text now."""
        file = self.saved.file(uri)
        if file is not None and is_program_file(file):
            self._open[file] = text
            self._reading = None

    def close(self, uri: str) -> None:
        """The saved text counts again."""
        file = self.saved.file(uri)
        if file is not None:
            self._open.pop(file, None)
        self.refresh()

    def refresh(self) -> None:
        """Reads what is saved once more."""
        self._texts, self._reading = self.saved.texts(), None
        if self.saved.model != self._model:
            self._model = self.saved.model
            self._readings = Readings(model_of(self._model))

    @property
    def reading(self) -> Reading:
        """The newest state."""
        if self._reading is None:
            self._reading = self._readings.read({**self._texts, **self._open})
        return self._reading

    def tried(self, texts: Mapping[str, str]) -> Reading:
        """What would be known of other texts; whoever asks next gets the texts as they are."""
        self._reading = None
        return self._readings.read({**self._texts, **self._open, **texts})

    def known(self, uri: str) -> str | None:
        """The name of a file that is read as a program; None for others."""
        file = self.saved.file(uri)
        return file if file is not None and file in self.reading.files else None


def model_of(name: str) -> Model:
    """The model; the generic one where there is none of this name."""
    try:
        return model_named(name)
    except NoSuchModel:
        return model_named(DEFAULT_MODEL)
