"""Expressions -> checked expressions: names to places, operators to typed operations, conversions written out."""

from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.harmless import harmless
from scanbench.check.body.operators import COMPARISONS, NUMERIC, OperatorChecker, conversion_hint
from scanbench.check.body.places import INSTANCE, character_of
from scanbench.check.context import Rejected
from scanbench.check.declare.scopes import decode
from scanbench.problems import Span
from scanbench.program.own_variables import SYSTEM
from scanbench.program.program import Assign, Const, Expr, Index, Intrinsic, Load, Place, Sequence, TrapKind
from scanbench.program.shown import shown
from scanbench.program.types import (
    BOOL,
    LINT,
    LWORD,
    NULL,
    Elementary,
    Enumeration,
    Kind,
    Member,
    OpenArray,
    Record,
    Reference,
    Section,
    StringType,
    Subrange,
    Type,
    base_of,
)
from scanbench.program.untyped import is_untyped, settle, widens
from scanbench.syntax import tree

FORMS = ("REF", "ADR", "SIZEOF", "LOWER_BOUND", "UPPER_BOUND", "EN_CHECK", "SUBRANGE_ERROR", "__ISVALIDREF")
"""Calls whose argument is not a value: a variable, an array, a type."""


class ExpressionChecker(OperatorChecker):
    # ---- what stands where a value of some type is asked for --------------------------------------------

    def value(self, node: tree.Expression) -> Expr:
        """The expression, its type settled."""
        return settle(self.expr(node))

    def as_type(self, node: tree.Expression, type: Type, what: str) -> Expr:
        """The expression as a value of `type`, widened where that loses nothing."""
        return self.coerce(self.expr(node, type), type, node.span, what)

    def coerce(self, expr: Expr, type: Type, span: Span, what: str) -> Expr:
        expr = self.plain(expr, span)
        if isinstance(type, OpenArray):
            raise self.report.reject("T003", "An ARRAY[*] cannot be assigned as a whole; assign its elements.", span)
        if isinstance(type, Subrange):
            inner = self.coerce(expr, base_of(type), span, what)
            return self.into(inner, type, span, what.strip("`"))
        if isinstance(type, Reference):
            reference = self.as_reference(expr, type, span)
            if reference is not None:
                return reference
        elif isinstance(expr, Const) and isinstance(type, Elementary) and is_untyped(expr):
            return self.literal_as(expr, type, span, what)
        text = self.as_text(expr, type, span)
        if text is not None:
            return text
        source = expr.type
        if source == type:
            return expr
        if source is not None and widens(source, type):
            if isinstance(type, StringType):
                return expr
            assert isinstance(type, Elementary)
            return fold.convert(type, expr)
        if isinstance(source, Reference) and isinstance(source.target, Record) and source.target.open:
            raise Rejected  # who knows what it is derived from
        said = "nothing" if source is None else str(settle(expr).type)
        raise self.report.reject("T002", f"{what} is {type}, but this is {said}.{_hint(source, type)}", span)

    def constant(self, node: tree.Expression, type: Type | None) -> Const:
        """A constant expression; of `type`, if one is asked for."""
        expr = self.expr(node, type) if type is None else self.as_type(node, type, "The value wanted here")
        if not isinstance(expr, Const):
            raise self.report.reject("D004", "A constant is needed here: a literal or a CONSTANT.", node.span)
        return expr

    # ---- expressions ------------------------------------------------------------------------------------

    def expr(self, node: tree.Expression, wanted: Type | None = None) -> Expr:
        match node:
            case tree.Literal():
                return self.literal(node, wanted)
            case tree.UnaryOp():
                return self._unary(node, wanted)
            case tree.BinaryOp():
                return self._binary(node, wanted)
            case tree.Call():
                return self.form(node) or self.call(node, wanted)
            case tree.TypedName(type_name, name, span):
                return self.value_of_type(type_name, name, span)
            case tree.Name(name, span) if name.upper() not in INSTANCE and self._is_free(name):
                return self._unbound(node, name, wanted, span)
            case tree.PartialAccess():
                return self._part_value(node)
            case tree.IndexOf():
                return self._element(node)
            case _:
                return self._read(node)

    def _is_free(self, name: str) -> bool:
        """Whether the program declares no variable of this name; an enumeration's value goes before what the model has."""
        found = self.scope.find(name)
        return found is None or found[2] in self.scope.system

    def form(self, node: tree.Call) -> Expr | None:
        """One of `FORMS`, unless the user declared something of that name."""
        if not isinstance(node.callee, tree.Name):
            return None
        name = node.callee.name.upper()
        if name not in FORMS or name in self.pous.functions or self.scope.find(name) is not None:
            return None
        match name:
            case "REF" | "ADR":
                return self.reference_to(node, name)
            case "SIZEOF":
                return self.size_of(node)
            case "LOWER_BOUND" | "UPPER_BOUND":
                return self.bound_of(node, name == "UPPER_BOUND")
            case "__ISVALIDREF":
                return self.is_bound(node)
        return self.explicit_check(node, name)

    def _unbound(self, node: tree.Name, name: str, wanted: Type | None, span: Span) -> Expr:
        """A name that is no variable."""
        if name.upper() == "NULL":
            return Const(NULL, 0)
        value = self.enumeration_value(name, wanted, span)
        if value is not None:
            return value
        return self._read(node)

    def _read(self, node: tree.Expression) -> Expr:
        if isinstance(node, tree.MemberOf):
            value = self.qualified_value(node)
            if value is not None:
                return value
        if isinstance(node, tree.MemberOf | tree.Name):
            read = self.accessor(node)
            if read is not None:
                return read
        place, member = self.place(node)
        return self._value_at(place, member, node)

    def _value_at(self, place: Place, member: Member | None, node: tree.Expression) -> Expr:
        known = self.known(place, member)
        if known is not None:
            return known
        if not isinstance(place.type, Subrange):
            return Load(place)
        if any(node is each for each in self.explicit):
            return self.as_written(place, member)
        return self.read(place, node.span, shown(node))

    def known(self, place: Place, member: Member | None) -> Const | None:
        """The value of a CONSTANT."""
        if member is None or not member.constant or place.indices or place.slot or place.reference is not None:
            return None
        if member.section is Section.IN_OUT or member.home == SYSTEM.name or place.type is not member.type:
            return None
        if not member.initial and isinstance(place.type, Elementary | StringType):
            raise Rejected  # its value was refused where it is declared, so nobody knows it
        return decode(place.type, member.initial)

    def _part_value(self, node: tree.PartialAccess) -> Expr:
        """A part of a variable is a place; of a value it is shifted out."""
        if isinstance(node.owner, tree.Name | tree.MemberOf | tree.IndexOf | tree.DirectAddress | tree.Dereference):
            place, member = self.place(node.owner)
            whole = self.known(place, member)
            if whole is None:
                return Load(self.part(place, node.size, node.index, node.span))
        else:
            whole = None
        value: Expr = whole if whole is not None else settle(self.expr(node.owner))
        _, part = self.part_type(value.type, node.size, node.index, node.span)
        bits = fold.convert(LWORD, value)
        if isinstance(bits, Const) and isinstance(bits.value, int):
            return Const(part, bits.value >> node.index * part.bits & (1 << part.bits) - 1)
        shifted = Intrinsic("SHR", LWORD, (bits, Const(LINT, node.index * part.bits)))
        if part == BOOL:
            return fold.compare("ne", BOOL, fold.binary("and", LWORD, shifted, Const(LWORD, 1)), Const(LWORD, 0))
        return fold.convert(part, shifted)

    def _element(self, node: tree.IndexOf) -> Expr:
        """An element of an array; `text[1]` is one character of a string."""
        place, member = self.place(node.array)
        if isinstance(place.type, StringType) and len(node.indices) == 1:
            return self._character_at(place, place.type, node.indices[0])
        place, member = self.automatic(*self.elements(place, member, node), node)
        return self._value_at(place, member, node)

    def _character_at(self, place: Place, type: StringType, node: tree.Expression) -> Expr:
        """A character by its position: 0 beyond the current length, a trap beyond the declared one and below 1."""
        index = self.character_index(node, type)
        before: list[Assign] = []
        if not harmless(index):
            before.append(Assign(self.temporary(LINT, node.span), index, node.span))
            index = Load(before[-1].target)
        if not harmless(Load(place)):
            before.append(Assign(self.temporary(type, node.span), Load(place), node.span))
            place = before[-1].target
        trap = self.trap(
            TrapKind.BOUNDS, node.span, f"the string has room for characters 1..{type.capacity}, not for this one"
        )
        one = Index(index, 1, type.capacity, type.width, trap)
        kind = character_of(type)
        here = Load(replace(place, type=kind, offset=place.offset + 2, indices=(*place.indices, one)))
        length = Intrinsic("LEN", LINT, (Load(place),))
        value = Intrinsic("SEL", kind, (fold.compare("le", BOOL, index, length), Const(kind, 0), here))
        return Sequence(tuple(before), value) if before else value

    # ---- operators --------------------------------------------------------------------------------------

    def _unary(self, node: tree.UnaryOp, wanted: Type | None) -> Expr:
        operand = self.plain(self.expr(node.operand, wanted), node.operand.span)
        type = operand.type
        if isinstance(type, Enumeration):
            type = base_of(type)
            operand = fold.convert(type, operand)
        if node.op == "not":
            if isinstance(type, Elementary) and type.kind in (Kind.BOOL, Kind.BITS):
                return fold.unary("not", type, operand)
            if is_untyped(operand) and isinstance(wanted, Elementary) and wanted.kind in (Kind.BOOL, Kind.BITS):
                return fold.unary("not", wanted, self.coerce(operand, wanted, node.span, "The operand"))
            raise self.report.reject(
                "T002", f"NOT needs BOOL or a bit string, not {settle(operand).type}.", node.operand.span
            )
        if isinstance(type, Elementary) and type.kind in (*NUMERIC, Kind.TIME):
            return operand if node.op == "plus" else fold.unary("neg", type, operand)
        raise self.report.reject("T002", f"A sign needs a number, not {type}.", node.operand.span)

    def _binary(self, node: tree.BinaryOp, wanted: Type | None) -> Expr:
        if node.op in COMPARISONS:
            left, right = self._compared(node)
        else:
            left, right = self.expr(node.left, wanted), self.expr(node.right, wanted)
        return self.operate(node.op, left, right, node.span, wanted)

    def _compared(self, node: tree.BinaryOp) -> tuple[Expr, Expr]:
        """Both sides; the name of an enumeration's value may need to know what it is compared with."""
        if self.is_value_name(node.left):
            right = self.expr(node.right)
            return self.expr(node.left, right.type), right
        left = self.expr(node.left)
        hint = left.type if isinstance(left.type, Enumeration) else None
        return left, self.expr(node.right, hint)


def _hint(source: Type | None, target: Type) -> str:
    """What to do about a value that does not fit."""
    if isinstance(target, Enumeration) and target.values:
        return f" Write one of its values, e.g. {target.values[0][0]}."
    if isinstance(target, Reference):
        instance = isinstance(target.target, Record) and target.target.kind is Kind.INTERFACE
        if isinstance(source, Reference):
            return ""
        return " Assign an instance that implements it." if instance else " Write REF(variable)."
    if isinstance(source, Reference) and source.target == target:
        return " Dereference it with `^`."
    return conversion_hint(source, target)
