"""`scanbench`: the command line."""

import sys


def main() -> None:
    """Entry point of the installed command."""
    if sys.argv[1:2] == ["dap"] and "--help" not in sys.argv:
        from scanbench.web.dap.streams import prepare

        prepare()
    from scanbench.cli.commands import app

    app()
