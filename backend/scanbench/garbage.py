"""Python's collector looks through everything again and again while a large tree is built or kept, and finds nothing."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without_collection() -> Iterator[None]:
    """No search for garbage meanwhile."""
    was = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was:
            if not gc.get_freeze_count():  # what was made is old at once, else the next search looks through all of it
                gc.freeze()
                gc.unfreeze()
            gc.enable()


def keep_what_is_there() -> None:
    """What exists now is not searched again: for a process that keeps most of it as long as it lives."""
    gc.collect()
    gc.freeze()
