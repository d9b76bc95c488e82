"""File handles: each connection takes one. Without any left the event loop closes what comes without an answer, so it is refused before."""

import resource

_MOST = 65_536
_RESERVE = 256
"""For PLCs, the database and files; and for connections that are told that there are too many."""


def raised_limit() -> int:
    """As many handles as this process may have: many systems begin with 1,024 and allow far more."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = _MOST if hard == resource.RLIM_INFINITY else min(hard, _MOST)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
        return wanted
    return _MOST if soft == resource.RLIM_INFINITY else soft


def most_connections(handles: int) -> int:
    """Beyond so many a request is answered with 503."""
    return max(handles - _RESERVE, handles // 2)
