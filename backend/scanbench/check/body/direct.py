"""Arguments of inputs: a value, or where a REFERENCE TO is wanted and the dialect has it so, the variable itself."""

from scanbench.check.body.allowed import may, used
from scanbench.check.body.any_inputs import any_of, is_any
from scanbench.check.body.coercion import as_type, coerce
from scanbench.check.body.context import Body
from scanbench.check.body.places import VARIABLES, given_reference, raw_place
from scanbench.check.body.referring import refer
from scanbench.check.body.variants import is_variant, variant_of
from scanbench.check.dialect import Allowance
from scanbench.program.program import Expr, Load
from scanbench.program.shown import shown
from scanbench.program.types import Record, Reference, Type, is_derived
from scanbench.syntax import tree


def as_argument(body: Body, node: tree.Expression, type: Type, what: str) -> Expr:
    """What is passed to an input of this type, or what it starts with; `what` it is, for people."""
    if isinstance(type, Record) and is_variant(body, type):
        return variant_of(body, node, type, what)
    if isinstance(type, Record) and is_any(type):
        return any_of(body, node, type, what)
    if isinstance(type, Reference) and type.automatic and isinstance(node, VARIABLES):
        given = given_reference(body, node)
        if given is not None:
            return coerce(body, given, type, node.span, what)
        place, _ = raw_place(body, node)
        if isinstance(place.type, Reference) and place.type.automatic and may(body, Allowance.DIRECT_REFERENCES):
            return coerce(body, Load(place), type, node.span, what)  # also one that refers to nothing
    if _is_variable(body, node, type):
        used(
            body, Allowance.DIRECT_REFERENCES, node.span, f"{what} is {type}, and this is a variable",
            f"`REF({shown(node)})`",
        )  # fmt: skip
        return coerce(body, refer(body, node), type, node.span, what)
    return as_type(body, node, type, what)


def _is_variable(body: Body, node: tree.Expression, type: Type) -> bool:
    """Whether it names a variable of the type that is referred to, also through a reference."""
    if not isinstance(type, Reference) or not type.automatic or not isinstance(node, VARIABLES):
        return False
    if not may(body, Allowance.DIRECT_REFERENCES):
        return False
    mark = body.report.mark()
    found, _ = body.place(node)
    body.report.undo(mark)
    given, wanted = found.type, type.target
    return given == wanted or (isinstance(given, Record) and isinstance(wanted, Record) and is_derived(given, wanted))
