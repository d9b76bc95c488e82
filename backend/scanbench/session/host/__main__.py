"""A host as a Python of its own, where forking is not to be had: `python -m scanbench.session.host FD [CACHE]`.

FD is the socket to the parent, CACHE a directory.
"""

import os
import socket
import sys
from pathlib import Path

from scanbench.session.host.host import serve

if __name__ == "__main__":
    cache = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    sys.exit(serve(socket.socket(fileno=int(sys.argv[1])), cache, os.getppid()))
