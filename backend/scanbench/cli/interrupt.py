"""Ctrl-C: what has run so far is printed, and the exit code says that it is not all."""

import queue
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import ParamSpec, TypeVar

from scanbench.engines.available import Flavours
from scanbench.runtime.interrupt import Interrupt

P = ParamSpec("P")
T = TypeVar("T")


class _Interrupt(Interrupt):
    """Knows whether there is an engine that can be asked."""

    running = False

    def reaches(self, interrupt: Callable[[], None]) -> None:
        super().reaches(interrupt)
        self.running = True


@contextmanager
def interruptible() -> Iterator[Interrupt]:
    """While the block runs, Ctrl-C asks for the end of the run; pressed again, or before the run has begun, it ends the command at once."""
    interrupt = _Interrupt()

    def on_signal(number: int, frame: FrameType | None) -> None:
        if interrupt.asked or not interrupt.running:
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


class Leaving:
    """Code whose flavours are made so that Ctrl-C is seen at once."""

    def __init__(self, code: Flavours) -> None:
        self.run, self.debug = leaving(code.run), leaving(code.debug)


def leaving(make: Callable[P, T]) -> Callable[P, T]:
    """The same function, in which Ctrl-C is seen at once: LLVM compiles for seconds without looking at signals.

    It works in a thread of its own, which is left alone when the wait for it is interrupted.
    """

    def waited(*args: P.args, **kwargs: P.kwargs) -> T:
        answers: queue.SimpleQueue[tuple[T] | BaseException] = queue.SimpleQueue()

        def work() -> None:
            try:
                answers.put((make(*args, **kwargs),))
            except BaseException as error:  # raised where it was asked for
                answers.put(error)

        threading.Thread(target=work, daemon=True).start()
        answer = answers.get()
        if isinstance(answer, BaseException):
            raise answer
        return answer[0]

    return waited
