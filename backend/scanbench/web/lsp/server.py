"""The language server of one project, for one client: who asks what is answered by the functions of `language/`, in the shapes of LSP."""

import logging
from collections.abc import Callable
from typing import Protocol

from lsprotocol import types
from pygls.exceptions import JsonRpcException, JsonRpcInternalError, PyglsError
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol

import scanbench
from scanbench.plcmodel.user_errors import CATALOGUE_FILES
from scanbench.server.from_disk import PROJECT_FILE
from scanbench.syntax.language_file import LANGUAGE_FILE
from scanbench.syntax.parse_file import ENDINGS
from scanbench.translation.inside import Path, at_paths, wanted
from scanbench.web.lsp import (
    annotations,
    boxes,
    calls,
    completion,
    crossing,
    lenses,
    mending,
    navigation,
    outline,
    renaming,
)
from scanbench.web.lsp.language import Language
from scanbench.web.lsp.project import Saved, Told

# An editor takes back most of what it asked, often after the answer: pygls warns of each.
logging.getLogger("pygls.protocol.json_rpc").setLevel(logging.ERROR)

FILES = "scanbench/files"
"""A server tells the files of a project as they are saved now: `{files: [[name, text], ...]}`."""


class _Files(Protocol):
    @property
    def files(self) -> list[tuple[str, str]]: ...


_SENTENCES: tuple[Path, ...] = (
    ("error", "message"),
    ("params", "message"),
    ("params", "diagnostics", "*", "message"),
    ("result", "*", "title"),
    ("result", "*", "tooltip"),
    ("result", "*", "diagnostics", "*", "message"),
    ("result", "title"),
    ("result", "command", "title"),
    ("result", "diagnostics", "*", "message"),
    ("result", "items", "*", "message"),
)
"""Where our messages have a sentence: refusals, problems, titles of what mends them, numbers above declarations, what a hint explains. What a name means is said where it is described."""


class _Protocol(LanguageServerProtocol):
    """Says everything in the language of the client."""

    language = "en"

    def _serialize_message(self, data: object) -> dict[str, object]:
        message: dict[str, object] = super()._serialize_message(data)
        said = message if self.language == "en" else at_paths(message, _SENTENCES, self.language)
        assert isinstance(said, dict)
        return said


class _Server(LanguageServer):
    def report_server_error(self, error: Exception, source: type[PyglsError | JsonRpcException]) -> None:
        """Tells the client of an error; but not by sending what went wrong in sending, as that would have no end when it is gone."""
        if source is not JsonRpcInternalError:
            super().report_server_error(error, source)


def make_server(saved_of: Callable[[types.InitializeParams], Saved]) -> LanguageServer:
    """A server for one client."""
    server = _Server("scanbench", scanbench.__version__, protocol_cls=_Protocol)
    language = Language(server, saved_of)

    @server.feature(types.INITIALIZE)
    def initialize(params: types.InitializeParams) -> None:
        if isinstance(server.protocol, _Protocol):
            server.protocol.language = language.tongue = wanted(params.locale or "")
        language.begin(params)

    @server.feature(types.INITIALIZED)
    async def initialized(_: types.InitializedParams) -> None:
        await watch(server)

    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: types.DidOpenTextDocumentParams) -> None:
        language.changed(params.text_document.uri)

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: types.DidChangeTextDocumentParams) -> None:
        language.changed(params.text_document.uri)

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: types.DidCloseTextDocumentParams) -> None:
        language.closed(params.text_document.uri)

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def saved(_: types.DidSaveTextDocumentParams) -> None:
        language.refreshed()

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def watched(_: types.DidChangeWatchedFilesParams) -> None:
        language.refreshed()

    @server.feature(FILES)
    def told(params: _Files) -> None:
        if language.project is not None and isinstance(language.project.saved, Told):
            language.project.saved.files = dict(params.files)
            language.refreshed()

    for room in (navigation, crossing, completion, boxes, outline, renaming, mending, annotations, lenses, calls):
        room.register(language)
    return server


async def watch(server: LanguageServer) -> None:
    """Asks a client that can to tell when files change on the disk that are not open."""
    workspace = server.client_capabilities.workspace
    watched = workspace.did_change_watched_files if workspace is not None else None
    if watched is None or not watched.dynamic_registration:
        return
    globs = [
        *(f"**/*{ending}" for ending in ENDINGS),
        f"**/{PROJECT_FILE}",
        *(f"**/{name}" for name in (*CATALOGUE_FILES, LANGUAGE_FILE)),
    ]
    options = types.DidChangeWatchedFilesRegistrationOptions([types.FileSystemWatcher(each) for each in globs])
    wanted = types.Registration("files", types.WORKSPACE_DID_CHANGE_WATCHED_FILES, options)
    await server.client_register_capability_async(types.RegistrationParams([wanted]))
