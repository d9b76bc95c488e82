"""Sentences as terminals show them."""

from collections.abc import Sequence


def with_near(message: str, near: Sequence[str]) -> str:
    """A sentence with one full stop, followed by what was perhaps meant, unless it says so itself."""
    ended = message if message.endswith((".", "?", "!")) else f"{message}."
    return ended if not near or "id you mean" in message else f"{ended} Near: {', '.join(near)}."
