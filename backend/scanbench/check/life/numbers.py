"""A number for each declaration, which changes with it: so a program that took over knows what it has to initialise."""

from dataclasses import dataclass, field
from hashlib import blake2b

from scanbench.program.types import ArrayType, Kind, Record, Type


@dataclass(slots=True)
class Numbers:
    """Of the blocks of one program; each is looked at once."""

    _known: dict[Record, int] = field(default_factory=dict)

    def of(self, record: Record) -> int:
        """Its variables and their places are in the number; never 0."""
        known = self._known.get(record)
        if known is None:
            parts = [f"{record.name}:{record.size}"]
            if record.kind is not Kind.INTERFACE:
                for member in record.members.values():
                    type = member.type.name if member.bound else self._said(member.type)
                    parts.append(f"{member.name}@{member.offset} {member.section} {type}")
            known = self._known[record] = joined(parts)
        return known

    def _said(self, type: Type) -> str:
        if isinstance(type, ArrayType):
            return f"{type.bounds} {self._said(type.element)}"
        return str(self.of(type)) if isinstance(type, Record) else f"{type.name}:{type.size}"


def joined(parts: list[str]) -> int:
    """One number for all of these; never 0."""
    return int.from_bytes(blake2b("\n".join(parts).encode(), digest_size=8).digest(), "little") | 1
