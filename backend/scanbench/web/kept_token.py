"""The token stays the same over restarts: open pages come back by themselves, and a bookmarked address goes on working.

It is kept next to the database, readable by its owner only; deleting the file gives a new one at the next start.
"""

import os
import re
from pathlib import Path

from scanbench.runtime.clock import fresh_token

FILE = "token"
_TOKEN = re.compile(r"[A-Za-z0-9_-]{20,}")


def kept_token(data_dir: Path) -> str:
    """The token of this data directory; a new one when there is none, or none that can be trusted."""
    path = data_dir / FILE
    try:
        token = path.read_text("ascii").strip()
    except (FileNotFoundError, UnicodeDecodeError):
        token = ""
    if _TOKEN.fullmatch(token):
        return token
    token = fresh_token()
    path.unlink(missing_ok=True)
    with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
        file.write(token + "\n")
    return token
