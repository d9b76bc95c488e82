"""Packed objects of a version that knows other fields."""

import msgpack  # type: ignore[import-untyped]

from scanbench.wire.codec import pack_body

_OBJECT = 1


def object_of(name: str, *values: object) -> object:
    """For a field of a packed object: an object of this class with these values."""
    return msgpack.ExtType(_OBJECT, pack_body([name, *values]))


def packed_with(name: str, *values: object) -> bytes:
    """As the codec packs an object of this class with these values."""
    return pack_body(object_of(name, *values))


def cut_off(name: str, *values: object) -> bytes:
    """The same, with the last byte of its values missing."""
    return pack_body(msgpack.ExtType(_OBJECT, pack_body([name, *values])[:-1]))
