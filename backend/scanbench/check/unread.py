"""Private variables of blocks that no statement reads: what is stored there has no effect on anything.

Those of programs are not among them: people and panels look at them by their paths.
"""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from scanbench.check.program import (
    Assign,
    CallBlock,
    For,
    Index,
    Place,
    Pou,
    Program,
    SetBytes,
)
from scanbench.check.types import Member, Record, Section


def unread(program: Program) -> frozenset[str]:
    """As `Place.variable` has them. A variable that is read only to be stored in itself again (`n := n + 1`) is not read."""
    read = {variable for pou in program.pous for variable in _read(pou.body)}
    for task in program.tasks:
        for instance in task.programs:
            read.update(_read((instance.before, instance.after)))
    for instance in program.plant:
        read.update(_read((instance.pou.body, instance.before, instance.after)))
    kept = (pou.instance for pou in program.pous if pou.kind == "function_block")
    return frozenset(
        name
        for record in kept
        for member in record.members.values()
        if _is_private(member) and (name := name_of(record, member)) not in read
    )


def name_of(record: Record, member: Member) -> str:
    """As `Place.variable` names it."""
    return f"{member.home or record.name}.{member.name}".upper()


def _is_private(member: Member) -> bool:
    return member.section is Section.VAR and not member.located and not member.hidden


def _read(node: object) -> Iterator[str]:
    match node:
        case Assign():
            own = node.target.variable
            yield from (name for name in _read(node.value) if name != own)
            yield from _on_the_way(node.target)
        case SetBytes():
            yield from _on_the_way(node.target)
        case For():
            yield from _on_the_way(node.variable)
            for part in (node.start, node.end, node.step, node.body):
                yield from _read(part)
        case CallBlock():
            yield from _read((node.instance, node.in_outs))
            for _, value in node.inputs:
                yield from _read(value)
            for value, target in node.outputs:
                yield from _read(value)
                yield from _on_the_way(target)
        case Place():
            yield node.variable
            yield from _on_the_way(node)
        case Pou():
            return
        case tuple():
            for each in node:
                yield from _read(each)
        case _ if is_dataclass(node) and type(node).__module__ == Place.__module__:
            for field in fields(node):
                yield from _read(getattr(node, field.name))


def _on_the_way(place: Place) -> Iterator[str]:
    """What is read to find out where a place is."""
    parts: tuple[object, ...] = (*place.indices, place.slot, place.reference)
    for part in parts:
        if isinstance(part, Index):
            yield from _read((part.value, part.low, part.high, part.stride))
        elif part is not None:
            yield from _read(part)
