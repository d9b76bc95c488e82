"""Literals and the names of values -> constants."""

import math
from dataclasses import replace

from scanbench.check.body.references import ReferenceChecker
from scanbench.check.context import did_you_mean
from scanbench.problems import Span
from scanbench.program.numbers import round_real
from scanbench.program.program import Const, Expr, Intrinsic
from scanbench.program.shown import shown
from scanbench.program.types import (
    ABBREVIATIONS,
    BOOL,
    CHAR,
    ELEMENTARY,
    LINT,
    TIME,
    ULINT,
    WCHAR,
    Elementary,
    Enumeration,
    Kind,
    Record,
    Reference,
    StringType,
    Subrange,
    Type,
    base_of,
)
from scanbench.program.untyped import ANY_INT, ANY_REAL, bounds
from scanbench.syntax import tree

MOMENTS = {"time": Kind.TIME, "date": Kind.DATE, "tod": Kind.DATE, "dt": Kind.DATE}
EXAMPLES = {
    "TIME": "T#5s", "LTIME": "LTIME#5s", "DATE": "D#2026-11-21", "LDATE": "LDATE#2026-11-21", "TIME_OF_DAY": "TOD#12:30:00",
    "LTIME_OF_DAY": "LTOD#12:30:00", "DATE_AND_TIME": "DT#2026-11-21-12:30:00",
    "LDATE_AND_TIME": "LDT#2026-11-21-12:30:00",
}  # fmt: skip


class LiteralChecker(ReferenceChecker):
    def literal(self, node: tree.Literal, wanted: Type | None) -> Const:
        if node.kind in MOMENTS:
            type = (
                ELEMENTARY[ABBREVIATIONS[name].name]
                if (name := _upper(node.type_name)) in ABBREVIATIONS
                else ELEMENTARY.get(name, TIME)
            )
            if isinstance(wanted, Elementary) and wanted.name == f"L{type.name}":
                type = wanted  # T#5s is as good for an LTIME
            return Const(type, node.value)
        if node.type_name is not None:
            return self._typed(node, node.type_name)
        match node.kind:
            case "int":
                return self.in_64_bits(Const(ANY_INT, node.value), node.span)
            case "real":
                return Const(ANY_REAL, node.value)
            case "bool":
                return Const(BOOL, node.value)
        return _text(node)

    def in_64_bits(self, expr: Const, span: Span) -> Const:
        """Refuses an integer constant that no type can hold."""
        if not bounds(LINT)[0] <= int(expr.value) <= bounds(ULINT)[1]:
            raise self.report.reject("S004", f"{expr.value!r} does not fit any integer type.", span)
        return expr

    def _typed(self, node: tree.Literal, name: str) -> Const:
        """`INT#5`, `CHAR#'a'`, `STRING#'text'`, `Level#5` of a type of the user."""
        if isinstance(node.value, bytes):
            text = _text(node)
            if name.upper().startswith("W") and node.kind == "string":
                text = _text(replace(node, kind="wstring", value=node.value.decode("latin-1").encode("utf-16-le")))
            if name.upper() in ("CHAR", "WCHAR"):
                return self._character(text, CHAR if name.upper() == "CHAR" else WCHAR, node.span)
            if name.upper() in ("STRING", "WSTRING"):
                return text
        type = ABBREVIATIONS.get(name.upper()) or ELEMENTARY.get(name.upper())
        if type is None:
            known = did_you_mean(name, [*ELEMENTARY, *self.declarations.type_trees])
            if self.declarations.find_type(name, node.span) is None:
                raise self.report.reject("D002", f"There is no type `{name}` for a literal.{known}", node.span)
            declared = self.declarations.named(name, node.span)
            if not isinstance(declared, Elementary) or isinstance(declared, Enumeration):
                raise self.report.reject("S004", f"This is not a value of {declared}.", node.span)
            type = declared
        if node.kind == "bool" and type == BOOL:
            return Const(BOOL, node.value)
        if node.kind == "int" and type.kind is Kind.CHAR:
            return Const(type, self._in_range(int(node.value), type, node.span))
        if node.kind not in ("int", "real"):
            raise self.report.reject("S004", f"This is not a value of {name}.", node.span)
        value = Const(ANY_INT if node.kind == "int" else ANY_REAL, node.value)
        made = self.literal_as(value, base_of(type), node.span, "The literal")
        if isinstance(type, Subrange):
            self.into(made, type, node.span, "The literal")
        return made

    def _in_range(self, value: int, type: Elementary, span: Span) -> int:
        low, high = bounds(type)
        if not low <= value <= high:
            raise self.report.reject("S004", f"{value} does not fit {type} ({low} to {high}).", span)
        return value

    def _character(self, text: Const, type: Elementary, span: Span) -> Const:
        assert isinstance(text.type, StringType)
        assert isinstance(text.value, bytes)
        if len(text.value) != text.type.width or text.type.width != type.size:
            quotes = "'a'" if type.size == 1 else '"a"'
            raise self.report.reject("S004", f"A {type} is one character in quotes, {quotes}.", span)
        return Const(type, int.from_bytes(text.value, "little"))

    def literal_as(self, expr: Const, type: Elementary, span: Span, what: str) -> Const:
        """An untyped number as one of `type`."""
        value = expr.value
        assert not isinstance(value, bytes)
        if type.kind is Kind.REAL:
            rounded = round_real(float(value), type)
            if math.isinf(rounded) and not math.isinf(value):
                raise self.report.reject("S004", f"{value} does not fit {type}.", span)
            return Const(type, rounded)
        if isinstance(type, Enumeration):
            example = next((f" Write {type}#{name}." for name, number in type.values if number == value), "")
            raise self.report.reject("T002", f"{what} is {type}, but this is the number {value}.{example}", span)
        if expr.type == ANY_REAL or type.kind in (Kind.TIME, Kind.DATE, Kind.CHAR, Kind.REF):
            hint = f" Write it like {EXAMPLES[type.name]}." if type.name in EXAMPLES else ""
            if type.kind in (Kind.INT, Kind.UINT, Kind.BITS):
                hint = f" Use TRUNC or LREAL_TO_{type}."
            raise self.report.reject("T002", f"{what} is {type}, but this is the number {value}.{hint}", span)
        return Const(type, self._in_range(int(value), type, span))

    # ---- strings and characters -------------------------------------------------------------------------

    def as_text(self, expr: Expr, type: Type, span: Span) -> Expr | None:
        """A character as a string, or a string literal of one character as that, where that is wanted; or None."""
        source = expr.type
        if isinstance(type, Elementary) and type.kind is Kind.CHAR:
            if isinstance(expr, Const) and isinstance(source, StringType) and source.width == type.size:
                return self._character(expr, type, span)
        if isinstance(type, StringType) and isinstance(source, Elementary) and source.kind is Kind.CHAR:
            if source.size == type.width:
                return Intrinsic("CHAR_STR", StringType(1, source.size), (expr,))
        return None

    # ---- enumerations -----------------------------------------------------------------------------------

    def enumeration_value(self, name: str, wanted: Type | None, span: Span) -> Const | None:
        """The value of an enumeration, by its bare name: of the type wanted, else of the only one that has it."""
        if isinstance(wanted, Enumeration):
            value = _value(wanted, name)
            if value is not None:
                return value
        found = self.declarations.values.find(name, self._owners())
        if len(found) > 1:
            choices = " or ".join(f"{type}#{name}" for type in found)
            raise self.report.reject("T001", f"`{name}` may be {choices}; write which.", span)
        return _value(found[0], name) if found else None

    def is_value_name(self, node: tree.Expression) -> bool:
        """Whether it is a bare name that may be a value of an enumeration."""
        return isinstance(node, tree.Name) and self.scope.find(node.name) is None

    def _owners(self) -> set[str]:
        parts = self.scope.pou.upper().split(".")
        owners = {".".join(parts[:count]) for count in range(1, len(parts) + 1)}
        for record in (self.scope.instance, self.scope.frame, *self.scope.constants):
            if record is not None:
                owners |= {record.name.upper(), *(member.home.upper() for member in record.members.values())}
        return owners

    def value_of_type(self, type_name: str, name: str, span: Span) -> Const:
        """`Color#RED`."""
        type = self.declarations.named(type_name, span)
        if not isinstance(type, Enumeration):
            raise self.report.reject("S004", f"`{type_name}` is {type}, not an enumeration with `{name}`.", span)
        value = _value(type, name)
        if value is None:
            hint = did_you_mean(name, [each for each, _ in type.values])
            raise self.report.reject("T001", f"{type} has no value `{name}`.{hint}", span)
        return value

    def qualified_value(self, node: tree.MemberOf) -> Const | None:
        """`Color.RED`, as vendors write it, when there is no variable of that name."""
        owner = node.owner
        while isinstance(owner, tree.MemberOf):
            owner = owner.owner
        if not isinstance(owner, tree.Name):
            return None
        variable = self.scope.find(owner.name)
        if variable is not None and isinstance(variable[0].type, Record | Reference):
            return None
        key = self.declarations.find_type(shown(node.owner), node.span)
        if key is None or key not in self.declarations.type_trees:
            return None
        if not isinstance(self.declarations.named(shown(node.owner), node.span), Enumeration):
            return None
        return self.value_of_type(shown(node.owner), node.name, node.span)


def _value(type: Enumeration, name: str) -> Const | None:
    number = type.number(name)
    return None if number is None else Const(type, number)


def _text(node: tree.Literal) -> Const:
    assert isinstance(node.value, bytes)
    width = 2 if node.kind == "wstring" else 1
    return Const(StringType(max(len(node.value) // width, 1), width), node.value)


def _upper(name: str | None) -> str:
    return (name or "TIME").upper()
