"""Which frame variables can be registers, and how a FUNCTION takes and gives its parameters."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from scanbench.engines.native import inlining, walk
from scanbench.engines.native.emit_types import stored
from scanbench.program.program import Base, Expr, Place, Pou
from scanbench.program.types import Elementary, Member, Section, StringType


class Passing(Enum):
    """How a parameter goes from the caller to the function, or back."""

    VALUE = 0
    STRING = 1
    BYTES = 2
    REFERENCE = 3
    POINTER = 4
    """Result in the caller's register."""
    FRAME = 5
    """Result in the function's frame, for the caller to copy."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter, or the result."""

    member: Member
    passing: Passing

    @property
    def declaration(self) -> str:
        """How the LLVM function declares it; empty when it is not passed."""
        name = f'%"p.{self.member.name.upper()}"'
        match self.passing:
            case Passing.VALUE:
                assert isinstance(self.member.type, Elementary)
                return f"{stored(self.member.type)} {name}"
            case Passing.STRING:
                return f'ptr {name}, i64 %"n.{self.member.name.upper()}"'
            case Passing.BYTES:
                return f"ptr {name}"
            case Passing.REFERENCE:
                return f"i64 {name}"
            case Passing.POINTER:
                return f"ptr noalias {name}"
        return ""


@dataclass(frozen=True, slots=True)
class Signature:
    """A FUNCTION as its callers see it."""

    parameters: tuple[Parameter, ...]
    result: Parameter | None
    registers: dict[int, str]
    """See `registers`."""

    @property
    def all(self) -> tuple[Parameter, ...]:
        return (*self.parameters, self.result) if self.result else self.parameters


def signature(pou: Pou, free: dict[int, str]) -> Signature:
    """How this FUNCTION is called, where these of its variables are registers."""
    parameters = tuple(Parameter(pou.frame.members[name], _passing(pou.frame.members[name], free))
                       for name in pou.parameters)  # fmt: skip
    own = pou.returned
    return Signature(parameters, Parameter(own, _back(own, free)) if own is not None else None, free)


def _passing(member: Member, free: dict[int, str]) -> Passing:
    if member.section is Section.IN_OUT:
        return Passing.REFERENCE
    if member.section is Section.OUTPUT:
        return _back(member, free)
    if isinstance(member.type, StringType):
        return Passing.STRING
    return Passing.VALUE if isinstance(member.type, Elementary) else Passing.BYTES


def _back(member: Member, free: dict[int, str]) -> Passing:
    return Passing.POINTER if member.offset in free else Passing.FRAME


def registers(pou: Pou, looks: Iterable[Expr] = ()) -> dict[int, str]:
    """Frame offsets of the variables that nothing refers to or sees a part of, with their LLVM types. `looks` are
    evaluated in the POU's body besides.

    A slot that only this POU follows is a register too. Of a divided POU none is: its pieces share them. Of an addressed one neither: a reference may see them.
    """
    if inlining.divided(pou) or pou.addressed:
        return {}
    members = [each for each in pou.frame.members.values() if each.storage]
    free = {each.offset: _register_type(each) for each in members}
    seen_there = [each for expr in looks for each in walk.of_expression(expr)]
    for seen in (*walk.of_statements(pou.body), *seen_there):
        if isinstance(seen, Pou):
            continue
        place, use = seen
        own = place.base is Base.FRAME and place.slot is None and place.reference is None
        if own and not _whole(place, use, free):
            for each in members:
                if each.offset <= place.offset < each.offset + each.storage:
                    free.pop(each.offset, None)
    return {offset: type for offset, type in free.items() if type}


def _register_type(member: Member) -> str:
    if member.section is Section.IN_OUT:
        return "i64"
    return stored(member.type) if isinstance(member.type, Elementary) else ""


def _whole(place: Place, use: walk.Use, free: dict[int, str]) -> bool:
    return (
        use in (walk.Use.READ, walk.Use.WRITE)
        and not place.indices
        and place.bit is None
        and isinstance(place.type, Elementary)
        and free.get(place.offset) == stored(place.type)
    )
