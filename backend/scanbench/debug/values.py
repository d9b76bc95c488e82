"""Bytes of the image as people read them."""

from scanbench.program.types import BOOL, Elementary, StringType, Type
from scanbench.symbols.values import format_value


def value_text(type: Type, data: bytes) -> str:
    """A value that has a text; empty for structures and arrays. The byte of a bit is TRUE when it is not 0."""
    if type == BOOL:
        return "TRUE" if data[0] else "FALSE"
    return format_value(type, data) if isinstance(type, Elementary | StringType) else ""
