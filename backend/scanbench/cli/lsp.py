"""`scanbench lsp`: the language server, as VS Code and other editors start it."""

from scanbench.garbage import without_collection


def lsp() -> None:
    """Speak the Language Server Protocol on standard input and output. For editors, see docs/lsp.md."""
    with without_collection():
        from scanbench.web.lsp.stdio import serve_stdio

    serve_stdio()
