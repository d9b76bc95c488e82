"""FUNCTIONs of one name: a call is of the one whose inputs fit the arguments best."""

from scanbench.check.body.coercion import coerce
from scanbench.check.body.context import Body
from scanbench.check.body.generic import KINDS, TAKEN, tried
from scanbench.check.context import Rejected
from scanbench.program.program import Expr
from scanbench.program.types import Elementary, StringType, Type
from scanbench.program.untyped import is_untyped, settle
from scanbench.syntax import tree

SAME, LITERAL, CONVERTED, GENERIC = 4, 3, 2, 1
"""How well an argument fits: its type; a literal of its kind; one that is converted without a name; any type of a group."""


def overload(body: Body, key: str, node: tree.Call) -> str:
    """The key of the FUNCTION that is called; the first one where none fits, so that its problems are told."""
    keys = (key, *body.pous.overloads[key])
    try:
        values = [
            (each, tried(body, each.value)) for each in node.arguments if each.value is not None and not each.output
        ]
    except Rejected:
        return key
    fitting = [(each, _fit(body, each, values)) for each in keys]
    best = max(fitting, key=lambda each: (each[1], -_inputs(body, each[0])))
    return best[0] if best[1] >= 0 else key


def _inputs(body: Body, key: str) -> int:
    pou = body.pous.functions.get(key)
    return 0 if pou is None else len(pou.parameters)


def _fit(body: Body, key: str, values: list[tuple[tree.Argument, Expr]]) -> int:
    """The sum of how well the arguments fit; -1 where one does not."""
    total = 0
    for position, (argument, value) in enumerate(values):
        wanted = _wanted(body, key, position, argument)
        fits = 0 if wanted is None else _fits(body, argument, value, wanted)
        if fits == 0:
            return -1
        total += fits
    return total


def _wanted(body: Body, key: str, position: int, argument: tree.Argument) -> Type | str | None:
    """The type of the input that an argument goes to; of a generic FUNCTION the name of the group; None: there is none."""
    generic = body.pous.generic.get(key)
    if generic is not None:
        formals = [each for section in generic.sections if section.keyword in TAKEN for each in section.variables]
        named = [each for each in formals if argument.name is not None and each.name.upper() == argument.name.upper()]
        found = named if argument.name is not None else formals[position : position + 1]
        spec = found[0].type if found else None
        return spec.name.upper() if isinstance(spec, tree.NamedType) else None
    pou = body.pous.functions.get(key)
    if pou is None:
        return None
    if argument.name is None:
        member = pou.frame.members[pou.parameters[position]] if position < len(pou.parameters) else None
    else:
        member = pou.frame.members.get(argument.name.upper())
    return None if member is None else member.type


def _fits(body: Body, argument: tree.Argument, value: Expr, wanted: Type | str) -> int:
    type = value.type
    if isinstance(wanted, str):
        shown = settle(value).type
        return GENERIC if isinstance(shown, Elementary | StringType) and shown.kind in KINDS.get(wanted, ()) else 0
    if type == wanted or (
        isinstance(type, StringType) and isinstance(wanted, StringType) and type.width == wanted.width
    ):
        return SAME
    mark = body.report.mark()
    try:
        coerce(body, value, wanted, argument.span, "")
    except Rejected:
        return 0
    finally:
        body.report.undo(mark)
    natural = settle(value).type if is_untyped(value) else None
    literal = isinstance(natural, Elementary) and isinstance(wanted, Elementary) and natural.kind is wanted.kind
    return LITERAL if literal else CONVERTED
