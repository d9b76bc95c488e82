"""`scanbench dap`: the debug adapter, as VS Code and other editors start it."""

import getpass

import typer

from scanbench.garbage import without_collection


def dap(
    user: str | None = typer.Option(None, metavar="NAME", help="Who debugs, for the others at the PLC; default: the login name."),
) -> None:  # fmt: skip
    """Speak the Debug Adapter Protocol on standard input and output. For editors, see docs/dap.md."""
    with without_collection():
        from scanbench.web.dap.stdio import serve_stdio

    serve_stdio(user or _login())


def _login() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return "debugger"
