"""FUNCTIONs and methods of one name: a call is of the one whose inputs fit the arguments best."""

from scanbench.check.body.coercion import coerce
from scanbench.check.body.context import Body
from scanbench.check.body.generic import KINDS, TAKEN, tried
from scanbench.check.body.receivers import Receiver
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Method
from scanbench.program.program import Expr, Pou
from scanbench.program.types import ArrayType, Elementary, Member, OpenArray, Section, StringType, Type
from scanbench.program.untyped import is_untyped, settle, widens
from scanbench.syntax import tree
from scanbench.syntax.parse_generic import TYPE_PARAMETERS

SAME, LITERAL, CONVERTED, GENERIC = 4, 3, 2, 1
"""How well an argument fits: its type; a literal of its kind; one that is converted without a name; any type of a group."""


Values = list[tuple[tree.Argument, Expr]]


def overload(body: Body, key: str, node: tree.Call) -> str:
    """The key of the FUNCTION that is called; the first one where none fits, so that its problems are told."""
    keys = (key, *body.pous.overloads[key])
    values = _values(body, node)
    if values is None:
        return key
    fitting = [(each, _fit(body, each, values)) for each in keys]
    best = max(fitting, key=lambda each: (each[1], -_inputs(body.pous.functions.get(each[0]))))
    return best[0] if best[1] >= 0 else key


def of_types(body: Body, key: str, node: tree.Call | None) -> Pou | None:
    """What runs for the types of these arguments where a FUNCTION has type parameters: `Twice__INT` of `Twice<T: ANY_NUM>`."""
    if TYPE_PARAMETERS not in body.pous.generic[key].modifiers or node is None:
        return None
    keys = [each for each in body.pous.functions if each.startswith(f"{key}__")]
    values = _values(body, node) if keys else None
    if values is None:
        return None
    fitting = [(_fit(body, each, values), each) for each in keys]
    best = max(fitting, key=lambda each: each[0])
    return body.pous.functions[best[1]] if best[0] >= 0 else None


def method_overload(body: Body, receiver: Receiver, method: Method, node: tree.Call) -> Method:
    """The method that is called, of several of one name; the first one where none fits."""
    if not method.declaration.overload:
        return method
    values = _values(body, node)
    if values is None:
        return method
    fitting = [
        (each, _fit(body, each.pou, values)) for each in receiver.owner.overloads(method.declaration.name.upper())
    ]
    best = max(fitting, key=lambda each: (each[1], -_inputs(each[0].pou)))
    return best[0] if best[1] >= 0 else method


def _values(body: Body, node: tree.Call) -> Values | None:
    """What is passed; None where it is wrong, which is told when the call is made."""
    try:
        return [(each, tried(body, each.value)) for each in node.arguments if each.value is not None]
    except Rejected:
        return None


def _inputs(pou: Pou | None) -> int:
    return 0 if pou is None else len(pou.parameters)


def _fit(body: Body, callee: str | Pou | None, values: Values) -> int:
    """The sum of how well the arguments fit a FUNCTION, by its key, or a POU; -1 where one does not."""
    total = 0
    for position, (argument, value) in enumerate(values):
        pou = body.pous.functions.get(callee) if isinstance(callee, str) else callee
        generic = _of_group(body, callee, position, argument) if isinstance(callee, str) else None
        member = _member(pou, position, argument)
        wanted = generic if generic is not None or member is None else member.type
        if member is not None and member.section is Section.OUTPUT:
            fits = _takes(value, member.type)
        else:
            fits = 0 if wanted is None else _fits(body, argument, value, wanted)
        if fits == 0:
            return -1
        total += fits
    return total


def _of_group(body: Body, key: str, position: int, argument: tree.Argument) -> str | None:
    """The group of types that the input of a generic FUNCTION takes, to which an argument goes."""
    generic = body.pous.generic.get(key)
    if generic is None:
        return None
    formals = [each for section in generic.sections if section.keyword in TAKEN for each in section.variables]
    named = [each for each in formals if argument.name is not None and each.name.upper() == argument.name.upper()]
    found = named if argument.name is not None else formals[position : position + 1]
    spec = found[0].type if found else None
    return spec.name.upper() if isinstance(spec, tree.NamedType) else None


def _member(pou: Pou | None, position: int, argument: tree.Argument) -> Member | None:
    """The input or output that an argument goes to; None: there is none."""
    if pou is None:
        return None
    if argument.name is not None:
        return pou.frame.members.get(argument.name.upper())
    formals = [each for each in pou.parameters if each != "THIS" and not pou.frame.members[each].hidden]
    return pou.frame.members[formals[position]] if position < len(formals) else None


def _takes(target: Expr, output: Type) -> int:
    """How well a variable takes an output."""
    type = target.type
    same = isinstance(type, StringType) and isinstance(output, StringType) and type.width == output.width
    if type == output or same:
        return SAME
    return CONVERTED if type is not None and widens(output, type) else 0


def _fits_open(type: Type | None, wanted: OpenArray) -> int:
    """How well an array fits an ARRAY[*], which is bound to it and not converted."""
    if isinstance(type, OpenArray):
        return SAME if type == wanted else 0
    if not isinstance(type, ArrayType) or len(type.bounds) != wanted.dimensions:
        return 0
    if type.element == wanted.element:
        return SAME
    texts = isinstance(type.element, StringType) and isinstance(wanted.element, StringType)
    return CONVERTED if texts and type.element.kind is wanted.element.kind else 0


def _fits(body: Body, argument: tree.Argument, value: Expr, wanted: Type | str) -> int:
    type = value.type
    if isinstance(wanted, str):
        shown = settle(value).type
        return GENERIC if isinstance(shown, Elementary | StringType) and shown.kind in KINDS.get(wanted, ()) else 0
    if type == wanted or (
        isinstance(type, StringType) and isinstance(wanted, StringType) and type.width == wanted.width
    ):
        return SAME
    if isinstance(wanted, OpenArray):
        return _fits_open(type, wanted)
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
