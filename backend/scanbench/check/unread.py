"""Variables of blocks that nothing reads: what is stored there has no effect on anything.

Of a user's block its private variables that no statement reads; of a library's block everything but the outputs that
somebody looks at. Variables of programs are not among them: people and panels look at them by their paths.
"""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from scanbench.check.program import Assign, CallBlock, For, Load, Place, Pou, Program, SetBytes
from scanbench.check.standard.library import in_library
from scanbench.check.types import ArrayType, Member, Record, Section, Type


def unread(program: Program) -> frozenset[str]:
    """As `name_of` names them. A variable that is read only to be stored in itself again (`n := n + 1`) is not read."""
    reads = _Reads()
    for pou in program.pous:
        if not in_library(pou.span):
            reads.of(pou.body)
    for each in (*program.plant, *(instance for task in program.tasks for instance in task.programs)):
        reads.of((each.before, each.after))
    return frozenset(
        name_of(pou.instance, member)
        for pou in program.pous
        if pou.kind == "function_block"
        for member in pou.instance.members.values()
        if _may_be_unread(pou, member) and not reads.has(pou.instance, member)
    )


def name_of(record: Record, member: Member) -> str:
    """Of a member, the same in every block that inherits it; as `Place.variable` names it."""
    return f"{member.home or record.name}.{member.name}".upper()


def _may_be_unread(pou: Pou, member: Member) -> bool:
    if member.located or member.hidden:
        return False
    return member.section is Section.VAR or (in_library(pou.span) and member.section is Section.OUTPUT)


class _Reads:
    """What statements read."""

    def __init__(self) -> None:
        self._names: set[str] = set()
        self._whole: set[str] = set()
        """Blocks and structures that are read as a whole."""
        self._ways: set[tuple[int, int]] = set()
        """Bytes from and to, relative to what a reference refers to: of which block nobody knows."""

    def has(self, record: Record, member: Member) -> bool:
        """Whether a member may be read."""
        begin, end = member.offset, member.offset + max(1, member.type.size)
        return (
            name_of(record, member) in self._names
            or record.name in self._whole
            or any(begin < last and first < end for first, last in self._ways)
        )

    def of(self, node: object, own: str = "") -> None:
        """Takes in what a node reads; reading `own` does not count."""
        match node:
            case Assign():
                self.of(node.value, node.target.variable)
                self._to(node.target)
            case SetBytes():
                self._to(node.target)
            case For():
                self._to(node.variable)
                self.of((node.start, node.end, node.step, node.body))
            case CallBlock():
                self.of((node.in_outs, tuple(value for _, value in node.inputs)))
                self._to(node.instance)
                for value, target in node.outputs:
                    self.of(value)
                    self._to(target)
            case Load():
                self._whole.update(_records(node.place.type))
                self.of(node.place, own)
            case Place():
                if node.slot is not None or node.reference is not None:
                    self._ways.add((node.offset, node.offset + max(1, node.type.size)))
                elif node.variable != own:
                    self._names.add(node.variable)
                self._to(node)
            case Pou():
                return
            case tuple():
                for each in node:
                    self.of(each, own)
            case _ if is_dataclass(node) and type(node).__module__ == Place.__module__:
                for field in fields(node):
                    self.of(getattr(node, field.name), own)

    def _to(self, place: Place) -> None:
        """What is read to find out where a place is."""
        for index in place.indices:
            self.of((index.value, index.low, index.high, index.stride))
        self.of((place.slot, place.reference))


def _records(type: Type) -> Iterator[str]:
    """The records that are read with a value of this type."""
    if isinstance(type, ArrayType):
        yield from _records(type.element)
    elif isinstance(type, Record):
        yield type.name
        for member in type.members.values():
            yield from _records(member.type)
