"""The exception of a room whose answer is: no, because."""


class Refused(Exception):
    """A request that makes no sense; the message says why, and what to do. `final`: the same request is always refused."""

    def __init__(self, message: str, near: tuple[str, ...] = (), final: bool = False) -> None:
        super().__init__(message)
        self.message, self.near, self.final = message, near, final


class Unavailable(Exception):
    """A process cannot answer now: that of the PLC, or one that works for it; the message says why."""
