"""Which types have something to initialise besides their bytes."""

from collections.abc import Container, Iterator
from dataclasses import dataclass, field

from scanbench.check.declare.creations import MADE
from scanbench.program.types import ArrayType, Kind, Member, Record, Section, Type


@dataclass(slots=True)
class Needs:
    """Looks at each type once."""

    computed: Container[tuple[str, str]] = ()
    """The variables whose start values are computed, see `Declarations`."""
    _known: dict[int, bool] = field(default_factory=dict)
    _kept: list[Record] = field(default_factory=list)
    """So that no other gets the identity of a record that was looked at."""

    def of(self, type: Type) -> bool:
        """Whether a block with FB_init, or with a method that is called after it, is this or in it."""
        if isinstance(type, ArrayType):
            return self.of(type.element)
        if not isinstance(type, Record) or type.kind not in (Kind.BLOCK, Kind.STRUCT):
            return False
        known = self._known.get(id(type))
        if known is None:
            self._known[id(type)] = False
            self._kept.append(type)
            known = self._known[id(type)] = has_made(type) or self._in(type)
        return known

    def _in(self, record: Record) -> bool:
        """Whether something in it needs it: in its base, or in what it has besides."""
        if record.base is None:
            return any(self._has(record, each) for each in held(record))
        known = record.base.members
        own = [member for key, member in record.members.items() if key not in known]
        return self.of(record.base) or any(self._has(record, each) for each in own if _is_held(each))

    def _has(self, record: Record, member: Member) -> bool:
        return self.computes(record, member) or self.of(member.type)

    def computes(self, record: Record, member: Member) -> bool:
        """Whether the start value of the variable, or of a part of it, is computed."""
        return bool(self.computed) and ((member.home or record.name).upper(), member.name.upper()) in self.computed

    def members(self, record: Record) -> list[Member]:
        """The variables of a record that need it, in order of declaration."""
        return [each for each in held(record) if self._has(record, each)]


def has_made(record: Record) -> bool:
    """Whether an instance remembers that it is initialised."""
    return MADE.upper() in record.members


def held(record: Record) -> Iterator[Member]:
    """The variables that are in an instance, and are not only referred to."""
    return filter(_is_held, record.members.values())


def _is_held(member: Member) -> bool:
    return not member.located and not member.bound and member.section is not Section.EXTERNAL
