"""Where a program of this user keeps what it built, from one life to the next."""

import os
from pathlib import Path


def user_cache() -> Path | None:
    """`scanbench` in the user's cache folder; None where there is no such place that is the user's alone.

    What is kept is code that will run, so nobody else may be able to put something there.
    """
    named = os.environ.get("XDG_CACHE_HOME", "")
    try:
        folder = (Path(named) if os.path.isabs(named) else Path.home() / ".cache") / "scanbench"
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        status = folder.stat()
    except (OSError, RuntimeError):  # no home
        return None
    mine = status.st_uid == os.getuid() and not status.st_mode & 0o022
    return folder if mine and os.access(folder, os.W_OK | os.X_OK) else None
