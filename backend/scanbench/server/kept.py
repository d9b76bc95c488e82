"""What a project keeps, perhaps by a newer version of Scanbench: one that cannot be read takes none of the others with it."""

import logging
from collections.abc import Callable, Iterable
from typing import TypeVar

from scanbench.wire.refused import Refused

log = logging.getLogger("scanbench")
R = TypeVar("R")
A = TypeVar("A")


def unreadable(what: str, why: Exception) -> Refused:
    """What to say of one that cannot be read."""
    return Refused(f"{what} cannot be read: {why}. Open it with the version of Scanbench that kept it")


def readable(rows: Iterable[R], read: Callable[[R], A]) -> list[A]:
    """All that `read` does not refuse; the log says why of the others, which stay as they are."""
    found: list[A] = []
    for row in rows:
        try:
            found.append(read(row))
        except Refused as refused:
            log.error("%s", refused)
    return found
