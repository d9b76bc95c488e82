"""`scanbench`: the command line."""

import signal
import sys

from scanbench import __version__


def main() -> None:
    """Entry point of the installed command."""
    if sys.argv[1:] == ["--version"]:  # at once: commands take a second or two to be imported
        print(f"scanbench {__version__}")
        return
    if sys.argv[1:2] == ["dap"] and "--help" not in sys.argv:
        from scanbench.web.dap.streams import prepare

        prepare()
    try:
        from scanbench.cli.commands import app

        app()
    except KeyboardInterrupt:  # before the command has begun; the commands themselves tell what they have
        sys.exit(128 + signal.SIGINT)
