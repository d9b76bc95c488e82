"""Strings in memory, in both forms that `StringType` has: their characters, and the bytes of a variable."""

from scanbench.program.types import StringType


def characters(type: StringType, data: bytes) -> bytes:
    """Those of a variable with these bytes; the length before them may be wrong, as anything may write there."""
    if type.zero:
        return data[: type.capacity].partition(b"\0")[0]
    length = min(int.from_bytes(data[:2], "little"), type.capacity)
    return data[2 : 2 + length * type.width]


def stored(type: StringType, text: bytes) -> bytes:
    """The bytes of a variable with these characters, without those that mean nothing."""
    if type.zero:
        return text + b"\0"
    return (len(text) // type.width).to_bytes(2, "little") + text
