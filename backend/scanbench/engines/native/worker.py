"""Optimises modules in a process of its own: LLVM takes one lock for a whole process, and a PLC's must not wait for it.

`python -m scanbench.engines.native.worker`: modules on standard input, object code on standard output, each as a length of
four bytes and so many bytes. It ends with its input, and with its parent.
"""

import os
import resource
import signal
import struct
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from typing import IO

from scanbench.engines.lifeline import end_with_parent
from scanbench.engines.native import jit
from scanbench.engines.native.compiler import FAST
from scanbench.engines.native.parts import Part

_HEAD = struct.Struct("<I")
_NICENESS = 10


class WorkerDied(Exception):
    """The process that optimises is gone."""


def optimised(parts: Iterable[Part], wanted: Callable[[], bool]) -> Iterator[tuple[Part, bytes]]:
    """The optimised code of each part; ends early when it is not `wanted` any more."""
    command = [sys.executable, "-m", "scanbench.engines.native.worker"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            for part in parts:
                if not wanted():
                    return
                try:
                    _send(process.stdin, part.text.encode())
                except OSError as error:
                    raise WorkerDied from error
                code = _receive(process.stdout)
                if code is None:
                    raise WorkerDied
                yield part, code
        finally:
            process.kill()


def main() -> int:
    """Serves until the input ends."""
    end_with_parent()
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (hard, hard))  # what the PLC may take is not what its compiler needs
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the server's business
    os.nice(_NICENESS)
    while (text := _receive(sys.stdin.buffer)) is not None:
        code = jit.compile_object(text.decode(), FAST, jit.Timings())
        try:
            _send(sys.stdout.buffer, code)
        except BrokenPipeError:  # nobody wants it any more
            os._exit(0)  # what is left in the buffer has nowhere to go, and need not be told of
    return 0


def _send(stream: IO[bytes], data: bytes) -> None:
    stream.write(_HEAD.pack(len(data)) + data)
    stream.flush()


def _receive(stream: IO[bytes]) -> bytes | None:
    head = stream.read(_HEAD.size)
    if len(head) < _HEAD.size:
        return None
    (length,) = _HEAD.unpack(head)
    data = stream.read(length)
    return data if len(data) == length else None


if __name__ == "__main__":
    sys.exit(main())
