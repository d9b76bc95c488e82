"""A number for each declaration, which changes with it: so a program that took over knows what it has to initialise."""

from hashlib import blake2b

from scanbench.program.types import ArrayType, Kind, Record, Type


def number_of(type: Type) -> int:
    """Of a block, whose variables and their places are in it; never 0."""
    made = blake2b(digest_size=8)
    _tell(type, made.update)
    return int.from_bytes(made.digest(), "little") | 1


def joined(parts: list[str]) -> int:
    """Of a whole program; never 0."""
    return int.from_bytes(blake2b("\n".join(parts).encode(), digest_size=8).digest(), "little") | 1


def _tell(type: Type, told: "object") -> None:
    assert callable(told)
    if isinstance(type, ArrayType):
        told(f"[{type.bounds}]".encode())
        _tell(type.element, told)
        return
    told(f"{type.name}:{type.size};".encode())
    if isinstance(type, Record) and type.kind is not Kind.INTERFACE:
        for member in type.members.values():
            told(f"{member.name}@{member.offset} {member.section} ".encode())
            if member.bound:
                told(f"{member.type.name};".encode())
            else:
                _tell(member.type, told)
