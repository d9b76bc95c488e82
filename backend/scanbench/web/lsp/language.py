"""One client and its project: the texts as the editor has them, what a request is about, and the problems that are told.

All of it runs in one thread, in the order in which messages come: a change only replaces a text, and
whatever asks next has it checked; problems are told a moment after the last change.
"""

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from scanbench.garbage import keep_what_is_there
from scanbench.language.index import Occurrence
from scanbench.language.navigate import named_at
from scanbench.language.reading import Reading
from scanbench.web.lsp.options import CHECKS, LISTS, STATEMENTS
from scanbench.web.lsp.positions import Positions
from scanbench.web.lsp.problems import diagnostics
from scanbench.web.lsp.project import LspProject, Saved

QUIET_S = 0.1
"""After a change problems are told when nothing has come for so long."""


@dataclass(frozen=True, slots=True)
class Asked:
    """What a request is about, in our terms."""

    reading: Reading
    positions: Positions
    file: str
    position: int

    @property
    def name(self) -> Occurrence | None:
        """The name at the position."""
        return named_at(self.reading, self.file, self.position)


@dataclass(slots=True)
class Language:
    """The server and its project, which is there once the client has said where it is."""

    server: LanguageServer
    saved_of: Callable[[types.InitializeParams], Saved]
    """The project that a client means."""
    project: LspProject | None = None
    tongue: str = "en"
    """The language that the client's reader reads."""
    statements: bool = False
    """Whether the client wants statements among the symbols of a document, which most would only list."""
    checks: bool = False
    """Whether the client wants to see where subranges are checked."""
    lists: bool = False
    """Whether the client lists what is counted above a declaration, when somebody clicks the number."""
    _timer: asyncio.TimerHandle | None = None
    _read: bool = False
    """Whether the whole project was read once."""
    _told: set[str] = field(default_factory=set)
    """URIs of files with problems."""

    def asked(self, uri: str, position: types.Position) -> Asked | None:
        """What a position in a document is; None for a document that is no program."""
        found = self.file(uri)
        if found is None:
            return None
        reading, file = found
        positions = self.positions(reading)
        return Asked(reading, positions, file, positions.ours(file, position))

    def file(self, uri: str) -> tuple[Reading, str] | None:
        """The newest state, and the name of a document in it."""
        if self.project is None:
            return None
        file = self.project.known(uri)
        return None if file is None else (self.project.reading, file)

    def positions(self, reading: Reading) -> Positions:
        """For positions of this client."""
        return Positions(reading, self.server.workspace.position_encoding != types.PositionEncodingKind.Utf32)

    def uri(self, file: str) -> str:
        """How the client calls a file of the project."""
        assert self.project is not None
        return self.project.saved.uri(file)

    def location(self, positions: Positions, found: Occurrence) -> types.Location:
        """A name somewhere in the project."""
        return types.Location(self.uri(found.span.file), positions.occurrence(found))

    # ---- texts ----------------------------------------------------------------------------------------------

    def begin(self, params: types.InitializeParams) -> None:
        """Reads the project."""
        wanted = params.initialization_options
        if isinstance(wanted, Mapping):
            self.statements = wanted.get(STATEMENTS) is True
            self.checks = wanted.get(CHECKS) is True
            self.lists = wanted.get(LISTS) is True
        self.project = LspProject(self.saved_of(params))

    def changed(self, uri: str) -> None:
        """Takes the text that the client has now."""
        assert self.project is not None
        self.project.open(uri, self.server.workspace.get_text_document(uri).source)
        self.soon()

    def closed(self, uri: str) -> None:
        """The text on the disk counts."""
        assert self.project is not None
        self.project.close(uri)
        self.soon()

    def refreshed(self) -> None:
        """Files have changed that are not open."""
        if self.project is not None:
            self.project.refresh()
            self.soon()

    def soon(self) -> None:
        """Tells the problems in a moment."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = asyncio.get_running_loop().call_later(QUIET_S, self._tell)

    def _tell(self) -> None:
        """Problems of every file that has some, had some, or is open: an empty list says that there are none."""
        assert self.project is not None
        reading = self.project.reading
        found = diagnostics(reading, self.positions(reading))
        if not self._read:  # searching a large project for garbage takes longer than any answer
            keep_what_is_there()
            self._read = True
        told = {self.uri(file): problems for file, problems in found.items()}
        open_ = {uri for uri in self.server.workspace.text_documents if self.project.saved.file(uri) is not None}
        for uri in (self._told | open_) - told.keys():
            told[uri] = []
        self._told = {uri for uri, problems in told.items() if problems}
        for uri, problems in told.items():
            self.server.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, problems))
