"""`python -m scanbench.host FD ENTRY [CACHE]`: a process that is not forked. The server started it; see `entry.py`."""

import os
import socket
import sys
from pathlib import Path

from scanbench.host.entry import entry

if __name__ == "__main__":
    cache = Path(sys.argv[3]) if len(sys.argv) > 3 else None
    sys.exit(entry(sys.argv[2])(socket.socket(fileno=int(sys.argv[1])), cache, os.getppid()))
