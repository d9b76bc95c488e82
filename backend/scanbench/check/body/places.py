"""Variables -> places: names, members, elements, what a reference refers to, and parts of integers."""

from abc import abstractmethod
from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.harmless import harmless
from scanbench.check.body.subrange_checks import SubrangeChecker
from scanbench.check.context import Rejected, did_you_mean
from scanbench.check.declare.scopes import decode, place_of
from scanbench.problems import Span
from scanbench.program.own_variables import SYSTEM
from scanbench.program.program import Base, Const, Expr, Index, Intrinsic, Load, Place, TrapKind
from scanbench.program.shown import shown
from scanbench.program.types import (
    BOOL,
    CHAR,
    DINT,
    ELEMENTARY,
    LINT,
    SLOT_BYTES,
    ULINT,
    WCHAR,
    ArrayType,
    Elementary,
    Kind,
    Member,
    OpenArray,
    Record,
    Reference,
    Section,
    StringType,
    Type,
    actual_of,
)
from scanbench.program.untyped import ANY_INT, settle
from scanbench.syntax import tree

WIDTHS = {
    "X": BOOL,
    "B": ELEMENTARY["BYTE"],
    "W": ELEMENTARY["WORD"],
    "D": ELEMENTARY["DWORD"],
    "L": ELEMENTARY["LWORD"],
}
INSTANCE = ("THIS", "SUPER")
PARTED = (Kind.INT, Kind.UINT, Kind.BITS)

Found = tuple[Place, Member | None]
"""Where a variable lives, and the declared member it is (or is inside of)."""


class PlaceChecker(SubrangeChecker):
    def place(self, node: tree.Expression) -> Found:
        """The variable; of a REFERENCE TO, what it refers to."""
        return self.automatic(*self.raw_place(node), node)

    def automatic(self, place: Place, member: Member | None, node: tree.Expression) -> Found:
        """Of a REFERENCE TO, what it refers to."""
        if isinstance(place.type, Reference) and place.type.automatic:
            return self.behind(Load(place), node.span, shown(node)), None
        return place, member

    def raw_place(self, node: tree.Expression) -> Found:
        """The variable itself, also of a REFERENCE TO."""
        match node:
            case tree.Name(name, span):
                return self._named(name, span)
            case tree.MemberOf():
                return self._member(node)
            case tree.IndexOf():
                return self.elements(*self.place(node.array), node)
            case tree.Dereference():
                return self._dereferenced(node)
            case tree.PartialAccess(owner, size, index, span):
                place, member = self.place(owner)
                return self.part(place, size, index, span), member
            case tree.DirectAddress(text, span):
                type = self._width(text)
                offset, bit = self.declarations.place_of(text, type, span)
                return Place(type, Base.IMAGE, offset, bit=bit, variable="@"), None
        raise self.report.reject("T010", "A variable is needed here.", node.span)

    def _width(self, text: str) -> Elementary:
        """The type of an address that stands in a statement: as wide as the model says."""
        found = self.declarations.model.locate(text)
        if found is None:
            return BOOL if "." in text else ELEMENTARY["WORD"]
        return next((type for type in WIDTHS.values() if type.bits == found.bits), ELEMENTARY["WORD"])

    # ---- names and members ------------------------------------------------------------------------------

    def _named(self, name: str, span: Span) -> Found:
        found = self.scope.find(name)
        if name.upper() in INSTANCE and (found is None or found[0].hidden):
            return self.self_place(name, span), None
        if found is None:
            raise self.unknown(name, span)
        member, base, owner = found
        null = 0
        if member.bound:
            null = self.trap(TrapKind.NULL, span, f"the in-out {member.name} is not connected")
        return self._edge(member, base, owner) or place_of(member, base, owner, null), member

    def _edge(self, member: Member, base: Base, owner: Record) -> Place | None:
        """Of an input with R_EDGE or F_EDGE, inside its block: whether the edge is there."""
        if member.section is not Section.INPUT or base is Base.IMAGE:
            return None
        for edge in ("R", "F"):
            hidden = owner.members.get(f"{member.name}${edge}_EDGE".upper())
            if hidden is not None:
                return place_of(hidden, base, owner, 0)
        return None

    def unknown(self, name: str, span: Span) -> Rejected:
        """Reports a name that means nothing here."""
        upper = name.upper()
        if {(owner, upper) for owner in (self.scope.pou.upper(), "GLOBAL")} & self.declarations.broken:
            return Rejected()
        if upper in self.pous.functions:
            return self.report.reject("T010", f"`{name}` is a FUNCTION; call it with `{name}(...)`.", span)
        declared = self.declarations.block_trees.get(upper)
        if declared is not None and declared.kind == "program":
            return self.report.reject(
                "T010", f"`{name}` is a PROGRAM; declare in VAR_GLOBAL what others share with it.", span
            )
        if declared is not None:
            return self.report.reject("T010", f"`{name}` is a type; declare an instance of it in VAR.", span)
        known = [*self.scope.names(), *(pou.name for pou in self.pous.functions.values())]
        hint = did_you_mean(name, [*known, *self.declarations.values.names()])
        if self.declarations.model.locate(name) is not None:  # after AT it needs no percent sign
            hint += f" The address of the PLC is written `%{name}` in statements."
        return self.report.reject("T001", f"`{name}` is not declared.{hint}", span)

    def _member(self, node: tree.MemberOf) -> Found:
        found = self.qualified_place(node)
        if found is not None:
            return found
        place, outer = self.place(node.owner)
        record = place.type
        if isinstance(record, Elementary) and record.kind in PARTED:
            return self._named_part(place, node), outer
        if not isinstance(record, Record):
            hint = f" Write `{shown(node.owner)}^.{node.name}`." if isinstance(record, Reference) else ""
            raise self.report.reject("T010", f"{record} has no members.{hint}", node.span)
        member = record.members.get(node.name.upper())
        if member is None or member.hidden:
            raise self.no_member(record, node)
        self._may_use(record, member, node.span)
        inner = self.inside(place, record, member, node.span)
        if inner.slot is not place.slot or inner.reference is not place.reference:
            inner = replace(
                inner, null_trap=self.trap(TrapKind.NULL, node.span, f"the in-out {member.name} is not connected")
            )
        keep = outer is not None and (outer.constant or record.kind is not Kind.BLOCK)
        return inner, outer if keep else member

    def no_member(self, record: Record, node: tree.MemberOf) -> Rejected:
        """Reports a member that is not there, unless its declaration was reported."""
        if record.open or self.is_broken(record, node.name):
            return Rejected()
        hint = did_you_mean(node.name, [each.name for each in record.members.values() if not each.hidden])
        return self.report.reject("T001", f"`{record.name}` has no member `{node.name}`.{hint}", node.span)

    def is_broken(self, record: Record, name: str) -> bool:
        """Whether it, or what it extends, declares this, and was refused there."""
        known: Record | None = record
        while known is not None:
            if (known.name.upper(), name.upper()) in self.declarations.broken:
                return True
            known = known.base
        return False

    def inside(self, place: Place, record: Record, member: Member, span: Span) -> Place:
        """The place of a member of what lives at `place`."""
        return inside(place, record, member)

    def _may_use(self, record: Record, member: Member, span: Span) -> None:
        if record.kind is not Kind.BLOCK or member.section in (Section.INPUT, Section.OUTPUT):
            return
        if self.may_use(record, member):
            return
        what = "an in-out" if member.section is Section.IN_OUT else "internal"
        raise self.report.reject(
            "T010", f"`{member.name}` is {what} of {record.name}; only its inputs and outputs can be used from outside.",
            span,
        )  # fmt: skip

    # ---- references -------------------------------------------------------------------------------------

    def _dereferenced(self, node: tree.Dereference) -> Found:
        inner = node.reference
        if isinstance(inner, tree.Name) and inner.name.upper() in INSTANCE:
            return self.place(inner)
        reference = self.expr(inner)
        if not isinstance(reference.type, Reference):
            raise self.report.reject("T010", f"`^` needs a reference; this is {settle(reference).type}.", node.span)
        return self.behind(reference, node.span, shown(inner)), None

    def behind(self, reference: Expr, span: Span, name: str) -> Place:
        """What a reference refers to."""
        type = reference.type
        assert isinstance(type, Reference)
        if type.target is None:
            raise self.report.reject("T010", "NULL refers to nothing.", span)
        if isinstance(type.target, Record) and type.target.kind is Kind.INTERFACE:
            raise self.report.reject("T010", f"{type.target} is an interface: call its methods without `^`.", span)
        trap = self.trap(TrapKind.NULL, span, f"the reference {name} refers to nothing")
        return Place(type.target, Base.IMAGE, 0, null_trap=trap, reference=reference)

    # ---- elements ---------------------------------------------------------------------------------------

    def elements(self, place: Place, member: Member | None, node: tree.IndexOf) -> Found:
        """The element of an array, or what a pointer with an index points to."""
        type, indices = place.type, list(node.indices)
        if isinstance(type, Reference) and type.pointer and len(indices) == 1:
            moved = self.moved("add", Load(place), self.expr(indices[0]), node.span, of_target=True)
            return self.behind(moved, node.span, shown(node.array)), None
        while indices:
            if isinstance(type, StringType) and len(indices) == 1:
                return self._character_place(replace(place, type=type), type, indices[0]), member
            if not isinstance(type, ArrayType | OpenArray):
                raise self.report.reject("T010", f"{type} is not an array and has no index.", node.span)
            count = len(type.bounds) if isinstance(type, ArrayType) else type.dimensions
            if len(indices) < count:
                raise self.report.reject("T010", f"{type} needs {count} indices, not {len(indices)}.", node.span)
            for dimension, index in enumerate(indices[:count]):
                if isinstance(type, ArrayType):
                    place = self._index(place, type, dimension, index)
                else:
                    place = self._open_index(place, type, dimension, index)
            type, indices = type.element, indices[count:]
        return replace(place, type=type), member

    def character_index(self, node: tree.Expression, type: StringType) -> Expr:
        """The position of a character, which counts from 1."""
        index = fold.convert(LINT, self.index_value(node))
        if isinstance(index, Const):
            number = int(index.value)
            if number == 0:
                self.report.warn(
                    "W005",
                    "The first character is number 1; this traps. Tools that count from 0 mean the first character here.",
                    node.span,
                )
            elif not 1 <= number <= type.capacity:
                raise self.report.reject(
                    "T012", f"A {type} has no character {number}, only 1..{type.capacity}.", node.span
                )
        return index

    def _character_place(self, place: Place, type: StringType, node: tree.Expression) -> Place:
        """A character that is there: what is beyond the current length cannot be written or referred to."""
        index = self.character_index(node, type)
        if not harmless(Load(place)):
            raise self.report.reject(
                "T003", "Only a string without calls in its own index has characters here; assign the index first.",
                node.span,
            )  # fmt: skip
        trap = self.trap(
            TrapKind.BOUNDS, node.span, "the string has no character there: it is shorter, or the index below 1"
        )
        low, length = Const(LINT, 1), Intrinsic("LEN", LINT, (Load(place),))
        one = Index(index, low, length, Const(LINT, type.width), trap)
        return replace(place, type=character_of(type), offset=place.offset + 2, indices=(*place.indices, one))

    @abstractmethod
    def moved(self, op: str, pointer: Expr, by: Expr, span: Span, of_target: bool = False) -> Expr:
        """A pointer further on; see `ReferenceChecker`."""

    def index_value(self, node: tree.Expression) -> Expr:
        index = settle(self.expr(node))
        if not isinstance(index.type, Elementary) or index.type.kind not in (Kind.INT, Kind.UINT):
            raise self.report.reject("T002", f"An index is an integer, not {index.type}.", node.span)
        return index

    def _index(self, place: Place, type: ArrayType, dimension: int, node: tree.Expression) -> Place:
        low, high = type.bounds[dimension]
        stride = type.stride(dimension)
        index = self.index_value(node)
        if isinstance(index, Const):
            number = int(index.value)
            if not low <= number <= high:
                raise self.report.reject("T012", f"Index {number} is outside of {low}..{high}.", node.span)
            return replace(place, offset=place.offset + (number - low) * stride)
        trap = self.trap(TrapKind.BOUNDS, node.span, f"index outside of {low}..{high}")
        return replace(place, indices=(*place.indices, Index(index, low, high, stride, trap)))

    def _open_index(self, place: Place, type: OpenArray, dimension: int, node: tree.Expression) -> Place:
        limits = self.array_bounds(place)
        stride: Expr = Const(LINT, type.element.size)
        for low, high in limits[dimension + 1 :]:
            count = fold.binary("add", LINT, fold.binary("sub", LINT, high, low), Const(LINT, 1))
            stride = fold.binary("mul", LINT, stride, count)
        trap = self.trap(TrapKind.BOUNDS, node.span, "index outside of the bounds of this ARRAY[*]")
        index = Index(self.index_value(node), *limits[dimension], stride, trap)
        return replace(place, indices=(*place.indices, index))

    def array_bounds(self, place: Place) -> list[tuple[Expr, Expr]]:
        """Lower and upper bound of each dimension of an array: for ARRAY[*], what came with the call."""
        type = place.type
        if isinstance(type, ArrayType):
            return [(Const(LINT, low), Const(LINT, high)) for low, high in type.bounds]
        assert isinstance(type, OpenArray)
        slot = place.slot
        assert slot is not None
        made: list[tuple[Expr, Expr]] = []
        for dimension in range(type.dimensions):
            low, high = (
                replace(
                    slot, type=LINT, offset=slot.offset + SLOT_BYTES * (1 + 2 * dimension + upper),
                    variable=f"{slot.variable}${'HIGH' if upper else 'LOW'}{dimension + 1}" if slot.variable else "",
                )
                for upper in (0, 1)
            )  # fmt: skip
            made.append((Load(low), Load(high)))
        return made

    def bound_of(self, node: tree.Call, upper: bool) -> Expr:
        """`LOWER_BOUND(array, dimension)` and `UPPER_BOUND`."""
        name = "UPPER_BOUND" if upper else "LOWER_BOUND"
        values = [argument.value for argument in node.arguments if argument.value is not None]
        if len(values) != 2 or len(node.arguments) != 2:
            raise self.report.reject("T004", f"`{name}` takes an array and the number of a dimension.", node.span)
        place, _ = self.place(values[0])
        if not isinstance(place.type, ArrayType | OpenArray):
            raise self.report.reject("T002", f"`{name}` needs an array, not {place.type}.", node.span)
        limits = self.array_bounds(place)
        number = settle(self.expr(values[1]))
        if not isinstance(number, Const) or not isinstance(number.value, int) or not 1 <= number.value <= len(limits):
            raise self.report.reject("T012", f"The dimension is a constant from 1 to {len(limits)}.", values[1].span)
        bound = limits[number.value - 1][upper]
        return Const(ANY_INT, bound.value) if isinstance(bound, Const) else fold.convert(DINT, bound)

    # ---- parts of integers ------------------------------------------------------------------------------

    def _named_part(self, place: Place, node: tree.MemberOf) -> Place:
        """`word.READY` of vendors: a CONSTANT names the bit."""
        found = self.scope.find(node.name)
        known = decode(found[0].type, found[0].initial) if found and found[0].constant and found[0].initial else None
        if known is None or not isinstance(known.value, int):
            raise self.report.reject("T010", f"{place.type} has no members; a bit of it is `.0`, `.1`, ...", node.span)
        return self.part(place, "X", known.value, node.span)

    def part(self, place: Place, size: str, index: int, span: Span) -> Place:
        """A bit (X), byte, word or double word of an integer or bit string, number 0 the lowest."""
        type, part = self.part_type(place.type, size, index, span)
        if size == "X":
            return replace(place, type=part, offset=place.offset + index // 8, bit=index % 8)
        assert type.size >= part.size
        return replace(place, type=part, offset=place.offset + index * part.size)

    def part_type(self, type: Type | None, size: str, index: int, span: Span) -> tuple[Elementary, Elementary]:
        """The type of the whole and of the part, when there is such a part."""
        part = WIDTHS[size.upper()]
        if not isinstance(type, Elementary) or type.kind not in PARTED:
            raise self.report.reject("T010", f"{type} has no parts; only integers and bit strings have.", span)
        count = type.bits // part.bits if size == "X" or part.size < type.size else 0
        if not 0 <= index < count:
            shown_part = f".{index}" if size == "X" else f".%{size}{index}"
            which = f"it has {count} of that size" if count else "it is no larger than that"
            raise self.report.reject("T012", f"{type} has no part `{shown_part}`: {which}.", span)
        return type, part

    # ---- targets ----------------------------------------------------------------------------------------

    def target(self, node: tree.Expression) -> Place:
        """A place that may be written."""
        return self.declared_target(node)[0]

    def declared_target(self, node: tree.Expression) -> Found:
        """The same, and the declared variable that it is, or is inside of."""
        place, member = self.place(node)
        self.assignable(place, member, node.span)
        return place, member

    def assignable(self, place: Place, member: Member | None, span: Span) -> None:
        """Refuses what cannot be assigned: constants, outputs of others, memory that the model protects."""
        if member is not None:
            if member.constant and member.section is Section.IN_OUT and isinstance(member.type, OpenArray):
                raise self.report.reject("T003", f"`{member.name}` can only be read here.", span)
            if member.constant:
                what = "is a CONSTANT and cannot" if member.home != SYSTEM.name else "counts by itself and cannot"
                raise self.report.reject("T003", f"`{member.name}` {what} be assigned.", span)
            owner = self.scope.find(member.name)
            own = owner is not None and owner[0] is member
            if member.section is Section.INPUT and own and self.scope.instance is not None and place.slot is None:
                self.report.warn("W001", f"`{member.name}` is an input; the next call overwrites this.", span)
            if member.section is Section.OUTPUT and not own and not self._own(member):
                raise self.report.reject("T003", f"`{member.name}` is an output; only its block writes it.", span)
        self.writable(place, span)

    def _own(self, member: Member) -> bool:
        """Whether it is a member of the instance that runs, as in THIS.member."""
        instance = self.scope.instance
        return instance is not None and instance.members.get(member.name.upper()) is member

    def writable(self, place: Place, span: Span) -> None:
        """Refuses memory that the model protects from the program."""
        if place.variable != "@":
            return
        model = self.declarations.model
        for area in model.areas:
            start = self.declarations.areas[area.name]
            if start <= place.offset < start + area.size:
                word = (place.offset - start) // 2
                if area.access(word, self.scope.who) != "write":
                    where = model.format(area, place.offset - start, place.bit, 1 if place.bit is not None else 16)
                    raise self.report.reject(
                        "T011", f"{where} is read-only for the program on a {model.name}; it can only be read.", span
                    )


def character_of(type: StringType) -> Elementary:
    """The type of a character of such a string."""
    return CHAR if type.width == 1 else WCHAR


def inside(place: Place, record: Record, member: Member) -> Place:
    """The place of a member of what lives at `place`."""
    if member.located:
        return Place(member.type, Base.IMAGE, member.offset, bit=member.bit, variable="@")
    if member.copied:  # seen from outside it is what was passed: the block's own copy is over when the block has run
        member = actual_of(record, member)
    free = place.slot is not None or place.reference is not None or place.variable.startswith("@")
    if free or place.variable.endswith(".*") or place.variable == "":
        variable = place.variable
    else:
        # members of a union share their bytes, whatever is inside of them
        variable = f"{record.name}.*" if record.overlaps else f"{member.home or record.name}.{member.name}"
    inner = replace(
        place, type=member.type, offset=place.offset + member.offset, variable=variable.upper(), bit=member.bit
    )
    if not member.bound:
        return inner
    return Place(member.type, Base.IMAGE, 0, slot=replace(inner, type=ULINT))
