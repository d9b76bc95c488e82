"""AT on another variable, as SCL has it: a view of the bytes of a variable, in the order that an S7 has them.

A view is a temporary variable of its own. It is made of what it shows at the beginning of each call; after each statement that may
have written one of both, or a second view of the same, the others are made of it. So the two have the same bytes between any two
statements, whatever types they are.
"""

from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass, replace

from scanbench.check.body.context import Body
from scanbench.check.context import Rejected
from scanbench.problems import Span
from scanbench.program.types import BOOL, TIME, ArrayType, Elementary, Kind, Member, Record, Type, base_of
from scanbench.syntax import tree

MOST_BYTES = 256
"""Bytes of a variable that is seen in two ways: each has an assignment after each statement that writes it."""
PLAIN = (Kind.BITS, Kind.INT, Kind.UINT)
SEEN = ("REAL", "CHAR", "TIME")
"""Others whose bytes in an S7 are known; a TIME has 32 bits with the number of milliseconds."""
TIME_BYTES = 4


@dataclass(frozen=True, slots=True)
class Leaf:
    """An elementary part of a variable."""

    node: tree.Expression
    type: Elementary
    byte: int
    bit: int
    """Of a BOOL; of others 0."""

    @property
    def size(self) -> int:
        return size_of(self.type)


def overlaid(
    body: Body, overlays: tuple[tuple[str, str, Span], ...], written: tuple[tree.Statement, ...]
) -> tuple[tree.Statement, ...]:
    """The statements, with what keeps the views as they are to be."""
    groups: dict[str, list[str]] = {}
    for view, base, _ in overlays:
        groups.setdefault(base, [base]).append(view)
    groups = {name: group for group in groups.values() for name in group}
    parts: dict[str, list[Leaf]] = {}
    for view, base, span in overlays:
        for name in (base, view):
            parts[name] = list(_leaves(body, tree.Name(name, span), span))
        sizes = [size_of(_type(body, name, span)) for name in (view, base)]
        if sizes[0] > sizes[1]:
            raise body.report.reject(
                "D005", f"`{view}` takes {sizes[0]} bytes, and `{base}`, which it is AT, only {sizes[1]}.", span
            )
    keeper = _Keeper(body, groups, parts)
    start = [each for view, base, span in overlays for each in keeper.made(base, view, span)]
    return (*start, *keeper.block(written))


class _Keeper:
    def __init__(self, body: Body, groups: dict[str, list[str]], parts: dict[str, list[Leaf]]) -> None:
        self._body, self._groups, self._parts = body, groups, parts

    def block(self, statements: tuple[tree.Statement, ...]) -> tuple[tree.Statement, ...]:
        """The same statements, at any depth, each with what follows from it."""
        return tuple(each for node in statements for each in self._after(node))

    def _after(self, node: tree.Statement) -> Iterator[tree.Statement]:
        match node:
            case tree.IfStatement(branches, orelse):
                self._only_read(*(test for test, _ in branches))
                made = tuple((test, self.block(inner)) for test, inner in branches)
                yield replace(node, branches=made, orelse=self.block(orelse))
            case tree.CaseStatement(selector, cases, orelse):
                self._only_read(selector)
                chosen = tuple((labels, self.block(inner)) for labels, inner in cases)
                yield replace(node, branches=chosen, orelse=self.block(orelse))
            case tree.ForStatement():
                if self._root(node.variable) in self._groups:
                    raise self._refused(node.variable, "counts a FOR loop")
                self._only_read(node.start, node.end, *([] if node.step is None else [node.step]))
                yield replace(node, body=self.block(node.body))
            case tree.WhileStatement():
                self._only_read(node.condition)
                yield replace(node, body=self.block(node.body))
            case tree.RepeatStatement():
                self._only_read(node.until)
                yield replace(node, body=self.block(node.body))
            case _:
                yield node
                for name in self._written(node):
                    for other in self._groups[name]:
                        if other != name:
                            yield from self.made(name, other, node.span)

    def _written(self, node: tree.Statement) -> list[str]:
        """Names of those that the statement may write."""
        found: dict[str, tree.Expression] = {}
        targets = [node.target, *node.also] if isinstance(node, tree.Assignment) else []
        for target in [*targets, *_passed(node)]:
            name = self._root(target)
            if name in self._groups:
                found[name] = target
        for name, target in found.items():
            if any(other != name and self._groups[other] is self._groups[name] for other in found):
                raise self._refused(target, "is written together with what shows the same bytes")
        return list(found)

    def _only_read(self, *expressions: tree.Expression) -> None:
        """Refuses what a call in a condition could write: nothing can follow it before the next statement."""
        for target in (target for each in expressions for target in _passed(each)):
            if self._root(target) in self._groups:
                raise self._refused(
                    target, "is passed to a call in a condition, which may write it; call it in a statement before"
                )

    def _refused(self, node: tree.Expression, why: str) -> Rejected:
        name = self._root(node)
        return self._body.report.reject("X001", f"`{name}`, whose bytes a variable AT it shows, {why}.", node.span)

    def _root(self, node: tree.Expression) -> str:
        while not isinstance(node, tree.Name):
            match node:
                case tree.MemberOf(owner=inner) | tree.PartialAccess(owner=inner) | tree.IndexOf(array=inner):
                    node = inner
                case _:
                    return ""
        return node.name.upper()

    def made(self, source: str, target: str, span: Span) -> Iterator[tree.Statement]:
        """Assignments that give `target` the bytes of `source`."""
        bits: dict[tuple[int, int], tree.Expression] = {}
        octets: dict[int, Leaf] = {}
        for leaf in self._parts[source]:
            if leaf.type.kind is Kind.BOOL:
                bits[leaf.byte, leaf.bit] = leaf.node
            for number in range(leaf.size if leaf.type.kind is not Kind.BOOL else 0):
                octets[leaf.byte + number] = leaf
        for leaf in self._parts[target]:
            yield from _from(leaf, bits, octets, span)


def _from(
    leaf: Leaf, bits: dict[tuple[int, int], tree.Expression], octets: dict[int, Leaf], span: Span
) -> Iterator[tree.Statement]:
    """Assignments to one part."""
    if leaf.type.kind is Kind.BOOL:
        whole = octets.get(leaf.byte)
        shown = bits.get((leaf.byte, leaf.bit))
        if whole is not None:
            shown = tree.PartialAccess(_octet(whole, leaf.byte), "X", leaf.bit, span)
        if shown is not None:
            yield tree.Assignment(leaf.node, shown, span)
        return
    if leaf.type.kind in PLAIN and leaf.type.size > 1:
        for byte in range(leaf.byte, leaf.byte + leaf.type.size):
            place = tree.PartialAccess(leaf.node, "B", leaf.byte + leaf.type.size - 1 - byte, span)
            if byte in octets:
                yield tree.Assignment(place, _octet(octets[byte], byte), span)
            for bit in range(8):
                if (byte, bit) in bits:
                    yield tree.Assignment(tree.PartialAccess(place, "X", bit, span), bits[byte, bit], span)
        return
    for bit in range(8) if leaf.type.kind is Kind.BITS else ():
        if (leaf.byte, bit) in bits:
            yield tree.Assignment(tree.PartialAccess(leaf.node, "X", bit, span), bits[leaf.byte, bit], span)
    given = [octets.get(byte) for byte in range(leaf.byte, leaf.byte + leaf.size)]
    if None in given:
        return
    value: tree.Expression | None = None
    word = {1: "BYTE", 2: "WORD", 4: "DWORD"}[leaf.size]
    for byte in range(leaf.byte, leaf.byte + leaf.size):
        one: tree.Expression = _octet(octets[byte], byte)
        left = 8 * (leaf.byte + leaf.size - 1 - byte)
        if leaf.size > 1:
            count = tree.Literal("int", left, None, span)
            one = _call("SHL", (_call(f"BYTE_TO_{word}", (one,), span), count), span)
        value = one if value is None else tree.BinaryOp("or", value, one, span)
    assert value is not None
    yield tree.Assignment(leaf.node, _converted(leaf.type, word, value, span), span)


def _converted(type: Elementary, word: str, value: tree.Expression, span: Span) -> tree.Expression:
    """The bits as a value of this type."""
    if type == TIME:
        return _call("DINT_TO_TIME", (_call("DWORD_TO_DINT", (value,), span),), span)
    return value if type.name == word else _call(f"{word}_TO_{type.name}", (value,), span)


def _octet(leaf: Leaf, byte: int) -> tree.Expression:
    """One byte of a part, as a BYTE."""
    span = leaf.node.span
    if leaf.type.size == 1:
        return leaf.node if leaf.type.kind is Kind.BITS else _call(f"{leaf.type.name}_TO_BYTE", (leaf.node,), span)
    given = "TIME_TO_DINT" if leaf.type == TIME else "REAL_TO_DWORD"
    node = leaf.node if leaf.type.kind in PLAIN else _call(given, (leaf.node,), span)
    return tree.PartialAccess(node, "B", leaf.byte + leaf.size - 1 - byte, span)


def _call(name: str, values: tuple[tree.Expression, ...], span: Span) -> tree.Call:
    return tree.Call(tree.Name(name, span), tuple(tree.Argument(None, False, each, span) for each in values), span)


def _passed(node: object) -> Iterator[tree.Expression]:
    """Variables that calls in it are given, which they may write."""
    if isinstance(node, tuple):
        for each in node:
            yield from _passed(each)
    elif is_dataclass(node) and not isinstance(node, Span | type):
        if isinstance(node, tree.Call):
            yield from (each.value for each in node.arguments if each.value is not None)
        for each in fields(node):
            yield from _passed(getattr(node, each.name))


# ---- where an S7 has the parts of a variable ------------------------------------------------------------------


def _type(body: Body, name: str, span: Span) -> Type:
    mark = body.report.mark()
    try:
        return body.place(tree.Name(name, span))[0].type
    finally:
        body.report.undo(mark)


def _leaves(body: Body, node: tree.Name, span: Span) -> Iterator[Leaf]:
    type = _type(body, node.name, span)
    if size_of(type) > MOST_BYTES:
        raise body.report.reject(
            "X001", f"`{node.name}` takes {size_of(type)} bytes; at most {MOST_BYTES} can be seen in two ways.", span
        )
    yield from _parts(body, node, type, 0, span)


def _parts(body: Body, node: tree.Expression, type: Type, byte: int, span: Span) -> Iterator[Leaf]:
    match type:
        case ArrayType():
            yield from _elements(body, node, type, byte, span)
        case Record() if type.kind is Kind.STRUCT:
            for member, at, bit in members_at(type):
                part = tree.MemberOf(node, member.name, span)
                if is_bit(member.type):
                    yield Leaf(part, BOOL, byte + at, bit)
                else:
                    yield from _parts(body, part, member.type, byte + at, span)
        case Elementary() if base_of(type).kind in (*PLAIN, Kind.BOOL) or base_of(type).name in SEEN:
            yield Leaf(node, base_of(type), byte, 0)
        case _:
            raise body.report.reject(
                "X001", f"What bytes {type} has in an S7 is not known here, so nothing is AT it.", span
            )


def _elements(body: Body, node: tree.Expression, type: ArrayType, byte: int, span: Span) -> Iterator[Leaf]:
    indices: list[tuple[int, ...]] = [()]
    for low, high in type.bounds:
        indices = [(*before, each) for before in indices for each in range(low, high + 1)]
    step = step_of(type.element)
    for number, index in enumerate(indices):
        part = tree.IndexOf(node, tuple(_number(each, span) for each in index), span)
        if is_bit(type.element):
            yield Leaf(part, BOOL, byte + number // 8, number % 8)
        else:
            yield from _parts(body, part, type.element, byte + number * step, span)


def _number(value: int, span: Span) -> tree.Expression:
    literal = tree.Literal("int", abs(value), None, span)
    return tree.UnaryOp("neg", literal, span) if value < 0 else literal


def is_bit(type: Type) -> bool:
    """Whether it is a BOOL, of which eight share a byte."""
    return isinstance(type, Elementary) and type.kind is Kind.BOOL


def step_of(type: Type) -> int:
    """From one element of an array to the next: structures and arrays begin at even bytes."""
    size = size_of(type)
    return size + size % 2 if isinstance(type, ArrayType | Record) else size


def members_at(type: Record) -> Iterator[tuple[Member, int, int]]:
    """Each with its byte and bit: BOOLs one after the other, bytes at any byte, all else at even ones."""
    bits = 0
    for member in type.members.values():
        if member.hidden:
            continue
        if not is_bit(member.type):
            bits = -(-bits // 8) * 8
            if size_of(member.type) > 1 or isinstance(member.type, ArrayType | Record):
                bits = -(-bits // 16) * 16
        yield member, bits // 8, bits % 8
        bits += 1 if is_bit(member.type) else 8 * size_of(member.type)


def size_of(type: Type) -> int:
    """Bytes in an S7 with standard access."""
    if isinstance(type, ArrayType):
        count = type.count
        whole = -(-count // 8) if is_bit(type.element) else count * step_of(type.element)
        return whole + whole % 2
    if isinstance(type, Record):
        last = [(at, member.type) for member, at, _ in members_at(type)]
        whole = 0 if not last else last[-1][0] + (1 if is_bit(last[-1][1]) else size_of(last[-1][1]))
        return whole + whole % 2
    if type == TIME:
        return TIME_BYTES
    return 1 if is_bit(type) else type.size
