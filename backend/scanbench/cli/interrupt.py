"""Ctrl-C: what has run so far is printed, and the exit code says that it is not all."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from scanbench.runtime.interrupt import Interrupt

INTERRUPTED = 128 + signal.SIGINT


@contextmanager
def interruptible() -> Iterator[Interrupt]:
    """While the block runs, Ctrl-C asks for the end of the run; pressed again, it ends the command at once."""
    interrupt = Interrupt()

    def on_signal(number: int, frame: FrameType | None) -> None:
        if interrupt.asked:
            signal.default_int_handler(number, frame)
        interrupt.ask()

    before = signal.getsignal(signal.SIGINT)
    if before is signal.SIG_IGN:  # in the background of a shell: it means others
        yield interrupt
        return
    signal.signal(signal.SIGINT, on_signal)
    try:
        yield interrupt
    finally:
        signal.signal(signal.SIGINT, before)
