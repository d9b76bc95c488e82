"""`scanbench`: the command line."""

import os
import signal
import sys
from contextlib import suppress
from typing import NoReturn

from scanbench import __version__

INTERRUPTED = 128 + signal.SIGINT
"""Exit code after Ctrl-C."""
ELSEWHERE = "Scanbench runs on Linux. On Windows use WSL2 or the container (docker compose up), on macOS the container."


def main() -> None:
    """Entry point of the installed command."""
    if sys.argv[1:] == ["--version"]:  # at once: commands take a second or two to be imported
        print(f"scanbench {__version__}")
        return
    if sys.platform != "linux":
        print(f"scanbench: {ELSEWHERE}", file=sys.stderr)
        sys.exit(2)
    try:
        if sys.argv[1:2] == ["dap"] and not {"-h", "--help"} & set(sys.argv):
            from scanbench.web.dap.streams import prepare

            prepare()
        from scanbench.cli.commands import app

        app()
    except KeyboardInterrupt:  # before the command has begun; the commands themselves tell what they have
        _leave()
    except SystemExit as end:
        if end.code == INTERRUPTED:
            _leave()
        raise


def _leave() -> NoReturn:
    """Ends at once, without waiting for a thread that compiles. All child processes end too."""
    from scanbench.engines.lifeline import end_children

    end_children()
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError):
            stream.flush()
    os._exit(INTERRUPTED)
