"""Packed objects of a version that knows other fields."""

from scanbench.wire.codec import pack_body

_OBJECT = 1


def packed_with(name: str, *values: object) -> bytes:
    """As the codec packs an object of this class with these values."""
    body = pack_body([name, *values])
    return b"\xc9" + len(body).to_bytes(4, "big") + bytes((_OBJECT,)) + body
