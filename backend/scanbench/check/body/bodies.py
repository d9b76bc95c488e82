"""A `Body` with all that checks it: the one place where the functions that call each other in a circle meet."""

from scanbench.check.body import calls, expressions, methods, places
from scanbench.check.body.context import Body, Call, Effects, Lookup
from scanbench.check.body.effects import PouEffects
from scanbench.check.body.lookup import PouLookup
from scanbench.check.context import Report
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.scopes import Pous, Scope
from scanbench.program.program import Pou

LOOKUP = PouLookup()
EFFECTS = PouEffects()


def body_of(
    report: Report,
    declarations: Declarations,
    pous: Pous,
    scope: Scope,
    pou: Pou | None,
    lookup: Lookup = LOOKUP,
    effects: Effects = EFFECTS,
    call: Call = calls.call,
) -> Body:
    """The body of `pou`; with None, of an expression in declarations or of one that a person typed."""
    return Body(
        report, declarations, pous, scope, pou, lookup, effects,
        expressions.expression, places.place, call, methods.property_value,
    )  # fmt: skip
