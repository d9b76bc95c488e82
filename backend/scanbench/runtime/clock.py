"""The only place that knows wall time and chance: everything else is a function of the image and the journal."""

import secrets
import time
from datetime import UTC, datetime


def wall_time() -> datetime:
    """Now, for people: journal, history, log."""
    return datetime.now(UTC)


def monotonic_ns() -> int:
    """CLOCK_MONOTONIC, the clock of `Pace.deadline_ns`."""
    return time.monotonic_ns()


def fresh_token() -> str:
    """A secret that cannot be guessed."""
    return secrets.token_urlsafe(24)
