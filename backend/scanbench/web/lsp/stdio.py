"""`scanbench lsp`: the language server on standard input and output, as editors start it."""

import os
import signal
from pathlib import Path
from urllib.parse import unquote, urlsplit

from lsprotocol import types

from scanbench.web.lsp.project import Folder, Saved
from scanbench.web.lsp.server import make_server
from scanbench.web.streams import own_streams


def serve_stdio() -> None:
    """Speaks LSP until the client says `exit` or closes the stream."""
    signal.signal(
        signal.SIGINT, lambda *_: os._exit(128 + signal.SIGINT)
    )  # a thread that reads would hold up any other end
    incoming, outgoing = own_streams()
    with os.fdopen(incoming, "rb") as reading, os.fdopen(outgoing, "wb") as writing:
        make_server(folder_of).start_io(reading, writing)


def folder_of(params: types.InitializeParams) -> Saved:
    """The folder that the client has open; without one the folder that it was started in."""
    folders = params.workspace_folders or []
    uri = folders[0].uri if folders else params.root_uri
    return Folder(Path(unquote(urlsplit(uri).path)) if uri else Path.cwd())
