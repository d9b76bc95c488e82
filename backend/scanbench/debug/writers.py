"""Which statements may write a variable: more than do, never less. What cannot be told is taken for a writer."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from scanbench.check.typed.local import this_of
from scanbench.problems import Span
from scanbench.program.origin import in_library
from scanbench.program.program import (
    Assign,
    Base,
    Binary,
    CallBlock,
    CallFunction,
    Compare,
    Const,
    Convert,
    Expr,
    For,
    Limit,
    Place,
    Pou,
    Program,
    RefOf,
    Sequence,
    SetBytes,
    Stmt,
    Violates,
)
from scanbench.program.types import BOOL, LWORD, ULINT, Elementary, Kind, Record, Reference, Section, Type, base_of
from scanbench.symbols.names import names_of
from scanbench.symbols.sites import Sites
from scanbench.symbols.symbols import Symbol

_ANYTHING = Reference("REF_TO", Kind.REF, 8)


def writers(program: Program, sites: Sites, symbol: Symbol) -> dict[int, Expr | None] | None:
    """The sites; None when nothing can be said, as where it lies changes while the program runs.

    With each a condition in the scope of its POU, without which the statement does not write the variable: that it is
    this element of the array, this instance. None: it may write it whenever it runs.
    """
    if symbol.slots:
        return None
    return _Search(program, sites, symbol).found()


class _Search:
    def __init__(self, program: Program, sites: Sites, symbol: Symbol) -> None:
        self._program, self._sites, self._symbol = program, sites, symbol
        self._begin, self._end = symbol.offset, symbol.offset + symbol.type.size
        enclosing = list(names_of(program).holding(symbol.offset))
        self._instances = [each for each in enclosing if isinstance(each.type, Record)]
        mixed = any(isinstance(each.type, Record) and each.type.overlaps for each in self._instances)
        self._typed = symbol.address is None and symbol.bit is None and not mixed
        self._passed: bool | None = None
        self._bodies: dict[int, tuple[Place | None, ...]] = {}

    def found(self) -> dict[int, Expr | None]:
        """All of them."""
        found = {site: when for pou in self._sites.bodies for site, when in self._in_body(pou, pou.body)}
        for task in self._program.tasks:
            for each in task.programs:
                for stmt in (*each.before, *each.after):
                    number = self._sites.number(stmt)
                    if number is not None and any(self._may_be(each.pou, place) for place in _written(stmt, self)):
                        found[number] = None
        return found

    def _in_body(self, pou: Pou, body: tuple[Stmt, ...]) -> Iterator[tuple[int, Expr | None]]:
        for stmt in _numbered(body, self._sites):
            places = [place for place in _written(stmt, self) if self._may_be(pou, place)]
            if places:
                number = self._sites.number(stmt)
                assert number is not None
                yield number, self._when(stmt, places)

    def _when(self, stmt: Stmt, places: list[Place | None]) -> Expr | None:
        """That an assignment writes the variable, where its target can be told before it runs."""
        if not isinstance(stmt, Assign) or len(places) != 1 or places[0] is not stmt.target:
            return None
        target = stmt.target
        fixed = target.base is not Base.SELF and not (target.indices or target.slot or target.reference)
        if fixed or not target.type.size or not (_is_plain(target, False) and _is_plain(stmt.value, True)):
            return None
        offset = Binary("and", LWORD, Convert(LWORD, RefOf(target, _ANYTHING)), Const(LWORD, 0xFFFF_FFFF))
        below = Compare("lt", LWORD, offset, Const(LWORD, self._end))
        above = Compare(
            "gt",
            LWORD,
            Binary("add", ULINT, Convert(ULINT, offset), Const(ULINT, target.type.size)),
            Const(ULINT, self._begin),
        )
        return Binary("and", BOOL, below, above)

    def number(self, stmt: object) -> int | None:
        """The site of a statement."""
        return self._sites.number(stmt)  # type: ignore[arg-type]

    def has_sites(self, pou: Pou) -> bool:
        """Whether its own statements tell what it writes."""
        return pou in self._sites.bodies and not any(each.copied for each in pou.instance.members.values())

    def of_body(self, pou: Pou) -> tuple[Place | None, ...]:
        """What the body of a block of the library writes, in the scope of that; None: who knows what."""
        if id(pou) not in self._bodies:
            self._bodies[id(pou)] = tuple(place for stmt in pou.body for place in _written(stmt, self))
        return self._bodies[id(pou)]

    def _may_be(self, pou: Pou, place: Place | None) -> bool:
        """Whether a place of a body may be, or hold, a part of the variable."""
        if place is None:
            return True
        this = this_of(pou)
        if place.reference is not None or place.slot is not None:
            own = this is not None and place.slot is not None and place.slot.offset == this.offset
            if own and place.slot is not None and place.slot.base is Base.FRAME and isinstance(this.type, Record):  # type: ignore[union-attr]
                return self._in_instance(this.type, place)  # type: ignore[union-attr]
            return self._fits(place.type) and (not _through_in_out(pou, place) or self.is_passed())
        if place.base is Base.IMAGE:
            return self._reaches(place, 0)
        return place.base is Base.SELF and self._in_instance(pou.instance, place)

    def is_passed(self) -> bool:
        """Whether any call passes it, or what it is a part of, to an in-out."""
        if self._passed is None:
            self._passed = False  # what is passed on was passed before
            self._passed = any(
                self._may_be(pou, place) for pou in self._program.pous for place in _passed(pou.body)
            ) or any(
                self._may_be(each.pou, place)
                for task in self._program.tasks
                for each in task.programs
                for place in _passed((*each.before, *each.after))
            )  # fmt: skip
        return self._passed

    def _in_instance(self, record: Record, place: Place) -> bool:
        return any(_derived(each.type, record) and self._reaches(place, each.offset) for each in self._instances)

    def _reaches(self, place: Place, base: int) -> bool:
        first = last = base + place.offset
        for index in place.indices:
            low, high, stride = index.low, index.high, index.stride
            if not (isinstance(low, int) and isinstance(high, int) and isinstance(stride, int)):
                return True
            last += (high - low) * stride
        return first < self._end and self._begin < last + max(1, place.type.size)

    def _fits(self, type: Type) -> bool:
        """Whether something of this type, wherever it is, may have to do with the variable."""
        own = self._symbol.type
        if not self._typed or not (isinstance(type, Elementary) and isinstance(own, Elementary)):
            return True
        return _kind(type) == _kind(own)


def _is_plain(node: object, value: bool) -> bool:
    """Whether evaluating this changes nothing; of a value: nothing that an index could depend on."""
    match node:
        case tuple():
            return all(_is_plain(each, value) for each in node)
        case Sequence():
            return False
        case Limit() | Violates() if not value:
            return False
        case CallFunction(pou=pou, args=args):
            return (
                value
                and in_library(pou.span)
                and not any(isinstance(each, Place) for each in args)
                and _is_plain(args, value)
            )
    if not is_dataclass(node) or isinstance(node, Pou | Type | Span | type):
        return True
    return all(_is_plain(getattr(node, field.name), value) for field in fields(node))


def _kind(type: Elementary) -> tuple[Kind, int]:
    return base_of(type).kind, type.size


def _numbered(body: object, sites: Sites) -> Iterator[Stmt]:
    """The statements of a body that have a site, at any depth."""
    for node in _nodes(body):
        if sites.number(node) is not None:  # type: ignore[arg-type]
            yield node  # type: ignore[misc]


def _nodes(node: object) -> Iterator[object]:
    if isinstance(node, tuple):
        for each in node:
            yield from _nodes(each)
    elif is_dataclass(node) and not isinstance(node, Pou | Type | Span | type):
        yield node
        for field in fields(node):
            yield from _nodes(getattr(node, field.name))


def _of_statement(node: object, search: _Search, root: bool = True) -> Iterator[object]:
    """A statement and what is in it, but for the statements in it that have a site of their own."""
    if isinstance(node, tuple):
        for each in node:
            yield from _of_statement(each, search, False)
    elif is_dataclass(node) and not isinstance(node, Pou | Type | Span | type):
        if root or search.number(node) is None:
            yield node
            for field in fields(node):
                yield from _of_statement(getattr(node, field.name), search, False)


def _written(stmt: Stmt, search: _Search) -> Iterator[Place | None]:
    """What a statement itself writes; None: who knows what."""
    for node in _of_statement(stmt, search):
        match node:
            case Assign() | SetBytes():
                yield node.target
            case For():
                yield node.variable
            case CallBlock():
                yield from _of_call(node, search)
            case CallFunction():
                known = search.has_sites(node.pou)
                for name, arg in zip(node.pou.parameters, node.args, strict=False):
                    member = node.pou.frame.members.get(name)
                    passed = member is not None and member.bound
                    if isinstance(arg, Place) and not (passed and known):
                        yield arg


def _of_call(call: CallBlock, search: _Search) -> Iterator[Place | None]:
    yield from (target for _, target in call.outputs)
    if not search.has_sites(call.pou):  # of a library, or with copies that are made around its body
        yield from _of_library(call, search)
        yield from (actual for _, actual in call.in_outs)
        if any(each.copied for each in call.pou.instance.members.values()):
            yield None
    for place, _ in call.inputs:
        if call.instance.slot is not None or call.instance.reference is not None:
            yield None
        else:
            yield _in_caller(call, place)


def _of_library(call: CallBlock, search: _Search) -> Iterator[Place]:
    """What of its instance the body writes: all of it, unless that can be told. An input mostly stays as it was passed."""
    places = search.of_body(call.pou) if in_library(call.pou.span) and call.pou.body else (None,)
    own = [each for each in places if each is not None and each.base is Base.SELF and not (each.slot or each.reference)]
    elsewhere = [each for each in places if each is not None and each.base is not Base.SELF]
    if (
        call.instance.slot is not None
        or call.instance.reference is not None
        or len(own) + len(elsewhere) < len(places)
        or any(each.base is not Base.FRAME or each.slot or each.reference for each in elsewhere)
    ):
        yield call.instance
    else:
        yield from (_in_caller(call, each) for each in own)


def _in_caller(call: CallBlock, place: Place) -> Place:
    """A place of the instance, in the scope of whoever calls it."""
    return Place(
        place.type, call.instance.base, call.instance.offset + place.offset, (*call.instance.indices, *place.indices),
        variable=place.variable,
    )  # fmt: skip


def _passed(body: tuple[Stmt, ...]) -> Iterator[Place]:
    for node in _nodes(body):
        if isinstance(node, CallBlock):
            yield from (actual for _, actual in node.in_outs)
        elif isinstance(node, CallFunction):
            yield from (arg for arg in node.args if isinstance(arg, Place))


def _through_in_out(pou: Pou, place: Place) -> bool:
    """Whether a place is what was passed to an in-out of the POU, or a part of that."""
    slot = place.slot
    if slot is None or slot.slot is not None or slot.reference is not None or slot.base is Base.IMAGE:
        return False
    record = pou.instance if slot.base is Base.SELF else pou.frame
    members = record.members.values()
    return any(each.section is Section.IN_OUT and each.offset == slot.offset for each in members)


def _derived(type: Type, record: Record) -> bool:
    known: Record | None = type if isinstance(type, Record) else None
    while known is not None:
        if known is record or known.name.upper() == record.name.upper():
            return True
        known = known.base
    return False
