"""What a change of the program does to the variables, in numbers for people: a variable is what is declared in a program or as a global, as
the panel of the variables lists it. An instance of a block counts once, and what the compiler made does not count."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from scanbench.check.declare.classes import TYPE_NUMBER
from scanbench.program.program import Program
from scanbench.program.types import Member, Record, Section


@dataclass(frozen=True, slots=True)
class Counted:
    """`kept` have all of their value; `reinitialised` counts parts, too, and so do `new` and `removed` within what is kept."""

    kept: int = 0
    reinitialised: int = 0
    new: int = 0
    removed: int = 0

    def __str__(self) -> str:
        initialised = self.reinitialised + self.new
        parts = [f"{self.kept} variables kept"]
        parts += [f"{initialised} new or changed: initialised"] * (initialised > 0)
        parts += [f"{self.removed} removed"] * (self.removed > 0)
        return ", ".join(parts)


def counted(
    old: Program, new: Program, reinitialised: Sequence[str], added: Sequence[str], removed: Sequence[str]
) -> Counted:
    """The numbers, where these paths do not go over."""
    before, after = set(_declared(old)), set(_declared(new))
    programs = {each.name.upper() for each in (*old.instances, *new.instances)}
    begun = {root for path in reinitialised for root in _roots(path.upper()) if root in after}
    return Counted(
        len((before & after) - begun), len(reinitialised),
        len(after - before) + _within(added, programs | after), len(before - after) + _within(removed, programs | before),
    )  # fmt: skip


def _within(paths: Sequence[str], whole: set[str]) -> int:
    """How many of them are parts of something: not a program, nor what it declares."""
    return sum(path.upper() not in whole for path in paths)


def _roots(path: str) -> Iterator[str]:
    """What it is, or is a part of."""
    for end in re.finditer(r"[.\[]|$", path):
        yield path[: end.start()]


def _declared(program: Program) -> Iterator[str]:
    """The paths of what is declared, in capitals."""
    if program.layout.globals is not None:
        yield from _members("", program.layout.globals)
    made = {each.name for each in (*program.common, *program.life)}
    for instance in program.instances:
        if instance.name not in made:
            yield from _members(f"{instance.name}.", instance.pou.instance)


def _members(prefix: str, record: Record) -> Iterator[str]:
    return (f"{prefix}{each.name}".upper() for each in record.members.values() if _is_shown(each))


def _is_shown(member: Member) -> bool:
    return not member.hidden and member.name != TYPE_NUMBER and member.section is not Section.EXTERNAL
