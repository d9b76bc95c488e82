"""The streams of `scanbench dap`, and what can begin before the rest of it is loaded: nothing heavy may be imported here."""

import os
from contextlib import suppress
from functools import cache

from scanbench.host.zygote import NoProcess, zygote


def prepare() -> None:
    """An editor waits: the process that a PLC is forked from loads while this one does."""
    own_streams()
    with suppress(NoProcess):  # `launch` says so
        zygote().start()


@cache
def own_streams() -> tuple[int, int]:
    """Standard input and output for us alone: what a library or a child prints must not get between the messages."""
    ours = os.dup(0), os.dup(1)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    return ours
