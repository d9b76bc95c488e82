"""Expressions -> checked expressions: names to places, operators to typed operations, conversions written out."""

import math
from abc import ABC, abstractmethod
from dataclasses import replace

from scanbench.check import fold
from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare import Declarations
from scanbench.check.program import (
    Base,
    Const,
    Expr,
    Index,
    Intrinsic,
    Load,
    Place,
    Pou,
    TrapKind,
)
from scanbench.check.scopes import Pous, Scope, decode, place_of
from scanbench.check.types import (
    BOOL,
    ELEMENTARY,
    LINT,
    LREAL,
    TIME,
    ULINT,
    ArrayType,
    Elementary,
    Kind,
    Member,
    Record,
    Section,
    StringType,
    Type,
)
from scanbench.check.untyped import ANY_INT, ANY_REAL, bounds, common, is_untyped, settle, widens
from scanbench.problems import Span
from scanbench.syntax import tree

ORDER = ("lt", "le", "gt", "ge")
SIGNS = {
    "add": "+", "sub": "-", "mul": "*", "div": "/", "mod": "MOD", "pow": "**", "and": "AND", "or": "OR", "xor": "XOR",
    "eq": "=", "ne": "<>", "lt": "<", "le": "<=", "gt": ">", "ge": ">=",
}  # fmt: skip
NUMERIC = (Kind.INT, Kind.UINT, Kind.REAL)
WIDTHS = {
    "X": BOOL,
    "B": ELEMENTARY["BYTE"],
    "W": ELEMENTARY["WORD"],
    "D": ELEMENTARY["DWORD"],
    "L": ELEMENTARY["LWORD"],
}


class ExpressionChecker(ABC):
    """Checks the expressions of one POU. Every method reports and raises `Rejected` where it cannot go on."""

    def __init__(self, report: Report, declarations: Declarations, pous: Pous, scope: Scope, pou: Pou | None) -> None:
        self.report = report
        self.declarations = declarations
        self.pous = pous
        self.scope = scope
        self.pou = pou

    def trap(self, kind: TrapKind, span: Span, message: str) -> int:
        return self.report.trap(kind, span, self.scope.pou, message)

    # ---- what stands where a value of some type is asked for --------------------------------------------

    def value(self, node: tree.Expression) -> Expr:
        """The expression, its type settled."""
        return settle(self.expr(node))

    def as_type(self, node: tree.Expression, type: Type, what: str) -> Expr:
        """The expression as a value of `type`, widened where that loses nothing."""
        return self.coerce(self.expr(node, type), type, node.span, what)

    def coerce(self, expr: Expr, type: Type, span: Span, what: str) -> Expr:
        if isinstance(expr, Const) and isinstance(type, Elementary) and is_untyped(expr):
            return self._literal_as(expr, type, span, what)
        source = expr.type
        if source == type:
            return expr
        if source is not None and widens(source, type):
            if isinstance(type, StringType):
                return expr
            assert isinstance(type, Elementary)
            return fold.convert(type, expr)
        shown = "nothing" if source is None else str(settle(expr).type)
        raise self.report.reject("T002", f"{what} is {type}, but this is {shown}.{_conversion(source, type)}", span)

    def _literal_as(self, expr: Const, type: Elementary, span: Span, what: str) -> Const:
        value = expr.value
        assert not isinstance(value, bytes)
        if type.kind is Kind.REAL:
            rounded = fold.round_real(float(value), type)
            if math.isinf(rounded) and not math.isinf(value):
                raise self.report.reject("S004", f"{value} does not fit {type}.", span)
            return Const(type, rounded)
        if expr.type == ANY_REAL or type.kind is Kind.TIME:
            hint = " Write a duration, e.g. T#5s." if type.kind is Kind.TIME else f" Use TRUNC or LREAL_TO_{type}."
            raise self.report.reject("T002", f"{what} is {type}, but this is the number {value}.{hint}", span)
        low, high = bounds(type)
        if not low <= int(value) <= high:
            raise self.report.reject("S004", f"{value} does not fit {type} ({low} to {high}).", span)
        return Const(type, int(value))

    def constant(self, node: tree.Expression, type: Type | None) -> Const:
        """A constant expression; of `type`, if one is asked for."""
        expr = self.expr(node, type) if type is None else self.as_type(node, type, "The value wanted here")
        if not isinstance(expr, Const):
            raise self.report.reject("D004", "A constant is needed here: a literal or a CONSTANT.", node.span)
        return expr

    # ---- expressions ------------------------------------------------------------------------------------

    def expr(self, node: tree.Expression, wanted: Type | None = None) -> Expr:
        """The expression; literals may still be untyped. `wanted` helps a literal find its type."""
        match node:
            case tree.Literal():
                return self._literal(node)
            case tree.UnaryOp():
                return self._unary(node, wanted)
            case tree.BinaryOp():
                return self._binary(node, wanted)
            case tree.Call():
                return self.call(node, wanted)
            case _:
                return self._read(node)

    @abstractmethod
    def call(self, node: tree.Call, wanted: Type | None = None) -> Expr:
        """A call for its value; see `CallChecker`."""

    def _literal(self, node: tree.Literal) -> Const:
        if node.type_name is not None:
            return self._typed_literal(node, node.type_name.upper())
        match node.kind:
            case "int":
                return self._in_64_bits(Const(ANY_INT, node.value), node.span)
            case "real":
                return Const(ANY_REAL, node.value)
            case "time":
                return Const(TIME, node.value)
            case "bool":
                return Const(BOOL, node.value)
        assert isinstance(node.value, bytes)
        return Const(StringType(max(len(node.value), 1)), node.value)

    def _in_64_bits(self, expr: Const, span: Span) -> Const:
        """Refuses an integer constant that no type can hold."""
        if not bounds(LINT)[0] <= int(expr.value) <= bounds(ULINT)[1]:
            raise self.report.reject("S004", f"{expr.value!r} does not fit any integer type.", span)
        return expr

    def _typed_literal(self, node: tree.Literal, name: str) -> Const:
        if node.kind == "string" and name == "STRING":
            assert isinstance(node.value, bytes)
            return Const(StringType(max(len(node.value), 1)), node.value)
        type = ELEMENTARY.get(name)
        if type is None:
            known = did_you_mean(name, ELEMENTARY)
            raise self.report.reject("D002", f"There is no type `{name}` for a literal.{known}", node.span)
        if node.kind == "bool" and type == BOOL:
            return Const(BOOL, node.value)
        if node.kind not in ("int", "real"):
            raise self.report.reject("S004", f"This is not a value of {name}.", node.span)
        return self._literal_as(
            Const(ANY_INT if node.kind == "int" else ANY_REAL, node.value), type, node.span, "The literal"
        )

    def _read(self, node: tree.Expression) -> Expr:
        place, member = self.place(node)
        if member is not None and member.constant and not place.indices and place.slot is None:
            known = decode(place.type, member.initial) if place.type is member.type else None
            if known is not None:
                return known
        return Load(place)

    def _unary(self, node: tree.UnaryOp, wanted: Type | None) -> Expr:
        operand = self.expr(node.operand, wanted)
        type = operand.type
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
        if node.op in ("eq", "ne", *ORDER):
            wanted = None
        left, right = self.expr(node.left, wanted), self.expr(node.right, wanted)
        return self.operate(node.op, left, right, node.span, wanted)

    def operate(self, op: str, left: Expr, right: Expr, span: Span, wanted: Type | None = None) -> Expr:
        """`left op right`, both brought to one type."""
        if isinstance(left.type, StringType) and isinstance(right.type, StringType) and op in ("eq", "ne", *ORDER):
            return fold.compare(op, BOOL, left, right)
        if TIME in (left.type, right.type) and op not in ("eq", "ne", *ORDER):
            return self._time(op, left, right, span)
        if op == "pow":
            return self._power(left, right, span, wanted)
        left, right, type = self._same(op, left, right, span)
        if op in ("eq", "ne", *ORDER):
            return fold.compare(op, BOOL, left, right)
        if op in ("and", "or", "xor"):
            fits = type.kind in (Kind.BOOL, Kind.BITS) or type == ANY_INT
            need = "BOOL or bit strings"
        else:
            fits = type.kind in NUMERIC and not (op == "mod" and type.kind is Kind.REAL)
            need = "integers" if op == "mod" else "numbers"
        if not fits:
            raise self.report.reject("T002", f"`{SIGNS[op]}` needs {need}, not {type}.{_unsigned(type)}", span)
        return self._arithmetic(op, type, left, right, span)

    def _arithmetic(self, op: str, type: Elementary, left: Expr, right: Expr, span: Span) -> Expr:
        trap = 0
        if op == "div" and type.kind is not Kind.REAL:
            if isinstance(right, Const) and right.value == 0:
                raise self.report.reject("S004", "This divides by the constant zero.", span)
            if not isinstance(right, Const):
                trap = self.trap(TrapKind.DIVISION, span, "division by zero")
        made = fold.binary(op, type, left, right, trap)
        return self._in_64_bits(made, span) if isinstance(made, Const) and type == ANY_INT else made

    def _same(self, op: str, left: Expr, right: Expr, span: Span) -> tuple[Expr, Expr, Elementary]:
        """Both operands in their common type."""
        a, b = left.type, right.type
        if not isinstance(a, Elementary) or not isinstance(b, Elementary):
            both = f"{settle(left).type} and {settle(right).type}"
            raise self.report.reject("T002", f"`{SIGNS[op]}` cannot join {both}.", span)
        if is_untyped(left) and is_untyped(right):
            type = ANY_REAL if ANY_REAL in (a, b) else ANY_INT
            return Const(type, _plain(left)), Const(type, _plain(right)), type
        if is_untyped(left):
            left, a = self._beside(left, b, span), b
        elif is_untyped(right):
            right, b = self._beside(right, a, span), a
        assert isinstance(left.type, Elementary)
        assert isinstance(right.type, Elementary)
        type_or_none = common(left.type, right.type)
        if type_or_none is None:
            hint = _conversion(right.type, left.type)
            raise self.report.reject("T002", f"`{SIGNS[op]}` cannot join {left.type} and {right.type}.{hint}", span)
        return fold.convert(type_or_none, left), fold.convert(type_or_none, right), type_or_none

    def _beside(self, literal: Expr, type: Elementary, span: Span) -> Expr:
        """An untyped literal beside an operand of `type`: that type, or a larger one where it does not fit."""
        assert isinstance(literal, Const)
        if literal.type == ANY_INT and type.kind in (Kind.INT, Kind.UINT):
            low, high = bounds(type)
            if not low <= int(literal.value) <= high:
                return settle(literal)
        if literal.type == ANY_REAL and type.kind in (Kind.INT, Kind.UINT):
            return Const(LREAL, literal.value)
        return self._literal_as(literal, type, span, "The other operand")

    def _time(self, op: str, left: Expr, right: Expr, span: Span) -> Expr:
        if op in ("add", "sub") and left.type == TIME and right.type == TIME:
            return fold.binary(op, TIME, left, right)
        if left.type == TIME and op in ("mul", "div"):
            factor = settle(right)
            if isinstance(factor.type, Elementary) and factor.type.kind in (Kind.INT, Kind.UINT):
                return self._arithmetic(op, TIME, left, fold.convert(TIME, factor), span)
            if isinstance(factor.type, Elementary) and factor.type.kind is Kind.REAL:
                scaled = fold.binary(op, LREAL, fold.convert(LREAL, left), fold.convert(LREAL, factor))
                return fold.convert(TIME, scaled)
        both = f"{settle(left).type} and {settle(right).type}"
        raise self.report.reject(
            "T002", f"`{SIGNS[op]}` cannot join {both}; a TIME can be added to a TIME, or scaled by a number.", span
        )

    def _literal_as_real(self, literal: Expr, type: Elementary) -> Expr:
        return Const(type, fold.round_real(float(_plain(literal)), type))

    def _power(self, left: Expr, right: Expr, span: Span, wanted: Type | None) -> Expr:
        if is_untyped(left) and isinstance(wanted, Elementary) and wanted.kind is Kind.REAL:
            left = self._literal_as_real(left, wanted)
        left, right = settle(left), settle(right)
        types = (left.type, right.type)
        if not all(isinstance(type, Elementary) and type.kind in NUMERIC for type in types):
            raise self.report.reject("T002", f"`**` needs numbers, not {types[0]} and {types[1]}.", span)
        type = ELEMENTARY["REAL"] if left.type == ELEMENTARY["REAL"] else LREAL
        return Intrinsic("EXPT", type, (fold.convert(type, left), fold.convert(type, right)))

    # ---- places -----------------------------------------------------------------------------------------

    def place(self, node: tree.Expression) -> tuple[Place, Member | None]:
        """Where the variable lives, and the declared member it is (or is inside of)."""
        match node:
            case tree.Name(name, span):
                return self._named(name, span)
            case tree.MemberOf():
                return self._member(node)
            case tree.IndexOf():
                return self._indexed(node)
            case tree.DirectAddress(text, span):
                type = self._width(text)
                offset, bit = self.declarations.place_of(text, type, span)
                return Place(type, Base.IMAGE, offset, bit=bit, variable="@"), None
        raise self.report.reject("T010", "A variable is needed here.", node.span)

    def _width(self, text: str) -> Elementary:
        letters = "".join(char for char in text[1:] if char.isalpha()).upper()
        if len(letters) > 1 and letters[-1] in WIDTHS:
            return WIDTHS[letters[-1]]
        return BOOL if "." in text else ELEMENTARY["WORD"]

    def _named(self, name: str, span: Span) -> tuple[Place, Member | None]:
        found = self.scope.find(name)
        if found is None:
            if {(owner, name.upper()) for owner in (self.scope.pou.upper(), "GLOBAL")} & self.declarations.broken:
                raise Rejected
            if name.upper() in self.pous.functions:
                raise self.report.reject("T010", f"`{name}` is a FUNCTION; call it with `{name}(...)`.", span)
            if name.upper() in self.declarations.block_trees:
                raise self.report.reject("T010", f"`{name}` is a type; declare an instance of it in VAR.", span)
            hint = did_you_mean(name, [*self.scope.names(), *(pou.name for pou in self.pous.functions.values())])
            raise self.report.reject("T001", f"`{name}` is not declared.{hint}", span)
        member, base, owner = found
        null = 0
        if member.section is Section.IN_OUT:
            null = self.trap(TrapKind.NULL, span, f"the in-out {member.name} is not connected")
        return place_of(member, base, owner, null), member

    def _member(self, node: tree.MemberOf) -> tuple[Place, Member | None]:
        place, outer = self.place(node.owner)
        record = place.type
        if not isinstance(record, Record):
            raise self.report.reject("T010", f"{record} has no members.", node.span)
        member = record.members.get(node.name.upper())
        if member is None:
            hint = did_you_mean(node.name, [each.name for each in record.members.values()])
            raise self.report.reject("T001", f"`{record.name}` has no member `{node.name}`.{hint}", node.span)
        if record.kind is Kind.BLOCK and member.section not in (Section.INPUT, Section.OUTPUT):
            what = "an in-out" if member.section is Section.IN_OUT else "internal"
            raise self.report.reject("T010", f"`{member.name}` is {what} of {record.name}; only its inputs and outputs "
                                     "can be used from outside.", node.span)  # fmt: skip
        if member.located:
            return Place(member.type, Base.IMAGE, member.offset, bit=member.bit, variable="@"), member
        free = place.slot is not None or place.variable.startswith("@")
        variable = place.variable if free else f"{record.name}.{member.name}".upper()
        inner = replace(place, type=member.type, offset=place.offset + member.offset, variable=variable)
        keep = outer is not None and (outer.constant or record.kind is Kind.STRUCT)
        return inner, outer if keep else member

    def _indexed(self, node: tree.IndexOf) -> tuple[Place, Member | None]:
        place, member = self.place(node.array)
        type, indices = place.type, list(node.indices)
        while indices:
            if not isinstance(type, ArrayType):
                raise self.report.reject("T010", f"{type} is not an array and has no index.", node.span)
            count = len(type.bounds)
            if len(indices) < count:
                raise self.report.reject("T010", f"{type} needs {count} indices, not {len(indices)}.", node.span)
            for dimension, index in enumerate(indices[:count]):
                place = self._index(place, type, dimension, index)
            type, indices = type.element, indices[count:]
        return replace(place, type=type), member

    def _index(self, place: Place, type: ArrayType, dimension: int, node: tree.Expression) -> Place:
        low, high = type.bounds[dimension]
        stride = type.stride(dimension)
        index = settle(self.expr(node))
        if not isinstance(index.type, Elementary) or index.type.kind not in (Kind.INT, Kind.UINT):
            raise self.report.reject("T002", f"An index is an integer, not {index.type}.", node.span)
        if isinstance(index, Const):
            number = int(index.value)
            if not low <= number <= high:
                raise self.report.reject("T012", f"Index {number} is outside of {low}..{high}.", node.span)
            return replace(place, offset=place.offset + (number - low) * stride)
        trap = self.trap(TrapKind.BOUNDS, node.span, f"index outside of {low}..{high}")
        return replace(place, indices=(*place.indices, Index(index, low, high, stride, trap)))

    def target(self, node: tree.Expression) -> Place:
        """A place that may be written."""
        place, member = self.place(node)
        if member is not None:
            if member.constant:
                raise self.report.reject("T003", f"`{member.name}` is a CONSTANT and cannot be assigned.", node.span)
            owner = self.scope.find(member.name)
            own = owner is not None and owner[0] is member
            if member.section is Section.INPUT and own and self.scope.instance is not None:
                self.report.warn("W001", f"`{member.name}` is an input; the next call overwrites this.", node.span)
            if member.section is Section.OUTPUT and not own:
                raise self.report.reject("T003", f"`{member.name}` is an output; only its block writes it.", node.span)
        self.writable(place, node.span)
        return place

    def writable(self, place: Place, span: Span) -> None:
        """Refuses memory that the model protects from the program."""
        if place.variable != "@":
            return
        model = self.declarations.model
        for area in model.areas:
            start = self.declarations.areas[area.name]
            if start <= place.offset < start + area.size:
                word = (place.offset - start) // 2
                if area.access(word, "program") != "write":
                    where = model.format(area, place.offset - start, place.bit, 1 if place.bit is not None else 16)
                    raise self.report.reject(
                        "T011", f"{where} is read-only for the program on a {model.name}; it can only be read.", span
                    )


def _plain(expr: Expr) -> int | float:
    assert isinstance(expr, Const)
    assert not isinstance(expr.value, bytes)
    return expr.value


def _conversion(source: Type | None, target: Type) -> str:
    names = ("STRING" if isinstance(type, StringType) else str(type) for type in (source, target))
    first, second = names
    known = {*ELEMENTARY, "STRING"}
    return f" Convert it with {first}_TO_{second}." if {first, second} <= known else ""


def _unsigned(type: Elementary) -> str:
    names = {1: "USINT", 2: "UINT", 4: "UDINT", 8: "ULINT"}
    return f" Convert it with {type}_TO_{names[type.size]}." if type.kind is Kind.BITS else ""
