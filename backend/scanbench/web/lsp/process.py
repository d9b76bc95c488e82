"""The process of one language server, forked by the server for one browser: LSP on its socket, framed as on standard input.

Imports what is heavy only when it serves: the process that it is forked from needs none of it.
"""

import signal
import socket
from pathlib import Path

from scanbench.engines.lifeline import end_with_parent


def serve(sock: socket.socket, _cache: Path | None, parent: int) -> int:
    """Serves until the process `parent` closes the socket, or is gone; the exit code."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's business
    sock.recv(1, socket.MSG_PEEK)  # the parent has spoken, so it has adopted this process
    end_with_parent(parent)
    from scanbench.web.lsp.project import told_by
    from scanbench.web.lsp.server import make_server

    with sock, sock.makefile("rb") as reading, sock.makefile("wb") as writing:
        make_server(told_by).start_io(reading, writing)
    return 0
