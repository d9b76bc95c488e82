"""`scanbench lsp`: the language server, as VS Code and other editors start it."""


def lsp() -> None:
    """Speak the Language Server Protocol on standard input and output. For editors, see docs/lsp.md."""
    from scanbench.web.lsp.stdio import serve_stdio

    serve_stdio()
