"""Standard input and output of a command that speaks a protocol on them."""

import os
from functools import cache


@cache
def own_streams() -> tuple[int, int]:
    """Both for us alone: what a library or a child prints must not get between the messages."""
    ours = os.dup(0), os.dup(1)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    return ours
