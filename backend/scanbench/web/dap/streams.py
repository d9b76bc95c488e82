"""What of `scanbench dap` can begin before the rest of it is loaded: nothing heavy may be imported here."""

from contextlib import suppress

from scanbench.host.zygote import NoProcess, zygote
from scanbench.web.streams import own_streams


def prepare() -> None:
    """An editor waits: the process that a PLC is forked from loads while this one does."""
    own_streams()
    with suppress(NoProcess):  # `launch` says so
        zygote().start()
