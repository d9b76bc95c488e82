"""The exception of a room whose answer is: no, because."""


class Refused(Exception):
    """A request that makes no sense; the message says why, and what to do."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.message, self.near = message, near


class Unavailable(Exception):
    """A process cannot answer now: that of the PLC, or one that works for it; the message says why."""
