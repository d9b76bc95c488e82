"""An expression where a value of some type is required: it is settled, converted, or refused."""

from scanbench.check.body import wide
from scanbench.check.body.context import Body
from scanbench.check.body.lenient import coerced
from scanbench.check.body.literals import as_text, literal_as
from scanbench.check.body.open_references import open_value
from scanbench.check.body.references import as_reference
from scanbench.check.body.subrange_checks import into, plain
from scanbench.check.body.subrange_copies import landed
from scanbench.check.context import Rejected
from scanbench.check.declare.open_references import array_of
from scanbench.problems import Span
from scanbench.program.program import Const, Expr
from scanbench.program.types import (
    ELEMENTARY,
    Elementary,
    Enumeration,
    Kind,
    OpenArray,
    Record,
    Reference,
    StringType,
    Subrange,
    Type,
    base_of,
)
from scanbench.program.untyped import is_untyped, settle, widens
from scanbench.syntax import tree

SHORT = {"TIME_OF_DAY": "TOD", "LTIME_OF_DAY": "LTOD", "DATE_AND_TIME": "DT", "LDATE_AND_TIME": "LDT"}
"""As the names of conversions have it."""


def value_of(body: Body, node: tree.Expression) -> Expr:
    """The expression, its type settled."""
    return settle(body.expression(node))


def as_type(body: Body, node: tree.Expression, type: Type, what: str) -> Expr:
    """The expression as a value of `type`, widened where that loses nothing."""
    return coerce(body, body.expression(node, type), type, node.span, what)


def coerce(body: Body, expr: Expr, type: Type, span: Span, what: str) -> Expr:
    """The value as one of `type`, widened where that loses nothing; `what` it is, for people."""
    expr = plain(body, expr, span)
    if isinstance(type, OpenArray):
        raise body.report.reject("T003", "An ARRAY[*] cannot be assigned as a whole; assign its elements.", span)
    if isinstance(type, Record) and expr.type != type and array_of(type) is not None:
        return open_value(body, expr, type, span, what)
    if isinstance(type, Subrange):
        inner = coerce(body, expr, base_of(type), span, what)
        return into(body, inner, type, span, what.strip("`"))
    if isinstance(type, Reference):
        reference = as_reference(body, expr, type, span)
        if reference is not None:
            return reference
    elif isinstance(expr, Const) and isinstance(type, Elementary) and is_untyped(expr):
        return literal_as(body, expr, type, span, what)
    text = as_text(body, expr, type, span)
    if text is not None:
        return text
    source = expr.type
    if source == type:
        return landed(body, expr, type, span, what.strip("`"))
    if source is not None and widens(source, type):
        if isinstance(type, StringType):
            return expr
        assert isinstance(type, Elementary)
        return wide.converted(body, type, expr)
    lenient = coerced(body, expr, type, span, what)
    if lenient is not None:
        return lenient
    if isinstance(source, Reference) and isinstance(source.target, Record) and source.target.open:
        raise Rejected  # who knows what it is derived from
    if isinstance(source, Record) and isinstance(type, Record) and source.written_out and type.written_out:
        message = f"{what} and the value are of two STRUCTs, each written out in a declaration. Declare one TYPE, and both variables of it."
        raise body.report.reject("T002", message, span)
    said = "nothing" if source is None else str(settle(expr).type)
    if isinstance(expr, Const) and isinstance(source, StringType) and isinstance(type, StringType):
        hint = "Write the text in single quotes." if source.width == 2 else "Write the text in double quotes."
        raise body.report.reject("T002", f"{what} is {type}, but this is {said}. {hint}", span)
    raise body.report.reject("T002", f"{what} is {type}, but this is {said}.{_hint(source, type)}", span)


def constant(body: Body, node: tree.Expression, type: Type | None) -> Const:
    """A constant expression; of `type`, if one is asked for."""
    expr = body.expression(node, type) if type is None else as_type(body, node, type, "The value wanted here")
    if not isinstance(expr, Const):
        raise body.report.reject("D004", "A constant is needed here: a literal or a CONSTANT.", node.span)
    return expr


def conversion_hint(source: Type | None, target: Type) -> str:
    """` Convert it with INT_TO_REAL.`, where there is such a function."""
    if isinstance(source, Reference) or isinstance(target, Reference | Record):
        return ""
    first, second = (name_in_conversions(type) for type in (source, target))
    known = {*ELEMENTARY, *SHORT.values(), "STRING", "WSTRING"}
    return f" Convert it with {first}_TO_{second}." if {first, second} <= known else ""


def name_in_conversions(type: Type | None) -> str:
    if isinstance(type, StringType):
        return "WSTRING" if type.width == 2 else "STRING"
    name = str(base_of(type)) if isinstance(type, Elementary) else str(type)
    return SHORT.get(name, name)


def _hint(source: Type | None, target: Type) -> str:
    """What to do about a value that does not fit."""
    if isinstance(target, Enumeration) and target.values:
        return f" Write one of its values, e.g. {target.values[0][0]}."
    if isinstance(target, Reference):
        instance = isinstance(target.target, Record) and target.target.kind is Kind.INTERFACE
        if isinstance(source, Reference):
            return ""
        if instance:
            return " Assign an instance that implements it."
        return " Write ADR(variable)." if target.pointer else " Write REF(variable)."
    if isinstance(source, Reference) and source.target == target:
        return " Dereference it with `^`."
    return conversion_hint(source, target)
