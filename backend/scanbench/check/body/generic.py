"""FUNCTIONs with variables of ANY_NUM and its like: one POU for each combination of types that they are called with."""

from dataclasses import replace

from scanbench.check.body.context import Body
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import called_pou
from scanbench.check.declare.frames import frame
from scanbench.check.declare.names import Space, qualified
from scanbench.check.declare.scopes import Instance
from scanbench.problems import Span
from scanbench.program.program import Expr, Pou
from scanbench.program.types import ELEMENTARY, Elementary, Kind, Record, StringType, Subrange, base_of
from scanbench.program.untyped import common, is_untyped, settle
from scanbench.syntax import tree
from scanbench.syntax.parse_generic import TYPE_PARAMETERS

WHOLE = (Kind.INT, Kind.UINT)
MOMENTS = (Kind.DATE,)
KINDS: dict[str, tuple[Kind, ...]] = {
    "ANY": tuple(Kind),
    "ANY_ELEMENTARY": tuple(kind for kind in Kind if kind is not Kind.REF),
    "ANY_MAGNITUDE": (*WHOLE, Kind.REAL, Kind.TIME),
    "ANY_NUM": (*WHOLE, Kind.REAL),
    "ANY_REAL": (Kind.REAL,),
    "ANY_INT": WHOLE,
    "ANY_SIGNED": (Kind.INT,),
    "ANY_UNSIGNED": (Kind.UINT,),
    "ANY_DURATION": (Kind.TIME,),
    "ANY_BIT": (Kind.BOOL, Kind.BITS),
    "ANY_CHARS": (Kind.STRING, Kind.CHAR),
    "ANY_STRING": (Kind.STRING,),
    "ANY_CHAR": (Kind.CHAR,),
    "ANY_DATE": MOMENTS,
}
"""The kinds of types that belong to each generic type."""
TAKEN = ("VAR_INPUT", "VAR_IN_OUT")


def instantiated(body: Body, declaration: tree.PouDeclaration, node: tree.Call) -> Pou:
    """The POU for the types of these arguments; those of one generic type have a common type."""
    types: dict[str, Elementary | StringType] = {}
    arguments = [
        (_generic_name(variable.type), variable.name, value, tried(body, value))
        for variable, value in _generic_arguments(declaration, node)
    ]
    for generic, name, value, expr in sorted(arguments, key=lambda each: is_untyped(each[3])):
        if not is_untyped(expr) or generic not in types:  # a literal takes the type of the others
            _take(body, types, generic, name, value, expr)
    for missing in _generics(declaration):
        if missing not in types:
            raise body.report.reject(
                "T004", f"`{declaration.name}` needs an argument to find out what {missing} is.", node.span
            )
    return _of_types(body, declaration, types).pou


def of_chosen_type(body: Body, key: str, type_name: str, node: tree.Call | None, span: Span) -> Pou:
    """What `f<DINT>(...)` calls: `f__DINT` where there is one, else `f` with this type for its type parameter."""
    declaration = body.pous.generic.get(key)
    if declaration is None or TYPE_PARAMETERS not in declaration.modifiers:
        raise body.report.reject(
            "T004", f"`{key.lower()}` has no type parameter; call it without `<{type_name}>`.", span
        )
    special = body.pous.functions.get(f"{key}__{type_name}")
    if special is not None:
        return special
    groups, type = set(_generics(declaration)), ELEMENTARY.get(type_name)
    if len(groups) != 1 or type is None or node is None:
        raise body.report.reject(
            "X001", f"`{declaration.name}<{type_name}>` is not supported: only one type parameter of an elementary type is chosen "
            "so. Let the arguments choose.", span,
        )  # fmt: skip
    group = groups.pop()
    if type.kind not in KINDS[group]:
        raise body.report.reject("T002", f"`{declaration.name}` takes {group}, not {type}.", span)
    return _of_types(body, declaration, {group: type}).pou


def _of_types(body: Body, declaration: tree.PouDeclaration, types: dict[str, Elementary | StringType]) -> Instance:
    suffix = ".".join(str(types[name]) for name in sorted(types))
    key = f"{qualified(declaration.namespace, declaration.name)}<{suffix}>"
    known = body.pous.instances.get(key)
    made = known or _make(body, key, declaration, types)
    body.pous.instances[key] = made
    return made


def _generic_arguments(
    declaration: tree.PouDeclaration, node: tree.Call
) -> list[tuple[tree.Variable, tree.Expression]]:
    formals = [each for section in declaration.sections if section.keyword in TAKEN for each in section.variables]
    by_name = {each.name.upper(): each for each in formals}
    found = []
    for position, argument in enumerate(node.arguments):
        if argument.name is not None:
            formal = by_name.get(argument.name.upper())
        else:
            formal = formals[position] if position < len(formals) else None
        if formal is not None and argument.value is not None and _generic_name(formal.type):
            found.append((formal, argument.value))
    return found


def _take(
    body: Body, types: dict[str, Elementary | StringType], generic: str, name: str, value: tree.Expression, expr: Expr
) -> None:
    type = settle(expr).type
    if isinstance(type, Subrange):
        type = base_of(type)
    if not isinstance(type, Elementary | StringType) or type.kind not in KINDS[generic]:
        raise body.report.reject("T002", f"`{name}` is {generic}; this is {type}.", value.span)
    known = types.get(generic, type)
    if isinstance(known, StringType) and isinstance(type, StringType) and known.width == type.width:
        types[generic] = StringType(max(known.capacity, type.capacity), type.width)
        return
    both = common(known, type) if isinstance(known, Elementary) and isinstance(type, Elementary) else None
    if both is None or both.kind not in KINDS[generic]:
        raise body.report.reject("T002", f"{known} and {type} have no common type of {generic}.", value.span)
    types[generic] = both


def tried(body: Body, value: tree.Expression) -> Expr:
    """The argument, only to see its type: it is checked once more when it is bound."""
    mark = body.report.mark()
    expr = body.expression(value)
    body.report.undo(mark)
    return expr


def _make(
    body: Body, key: str, declaration: tree.PouDeclaration, types: dict[str, Elementary | StringType]
) -> Instance:
    sections = tuple(
        replace(section, variables=tuple(replace(each, type=_settled(each.type, types)) for each in section.variables))
        for section in declaration.sections
    )
    result = None if declaration.result is None else _settled(declaration.result, types)
    made = replace(declaration, sections=sections, result=result)
    declared = body.declarations
    with declared.names.within(Space(declaration.namespace, declaration.using)), declared.later.under(()):
        own = frame(declared, made, Record(key, Kind.BLOCK))
    if _generic_name(declaration.result) and result is declaration.result:
        raise Rejected
    return Instance(called_pou(key, made, own), made)


def is_generic(declaration: tree.PouDeclaration, values: bool = True) -> bool:
    """Whether a FUNCTION has parameters of a generic type. Without `values` the dialect has its own meaning of ANY_NUM and its like."""
    named = values or TYPE_PARAMETERS in declaration.modifiers
    return named and declaration.kind == "function" and bool(_generics(declaration))


def _generics(declaration: tree.PouDeclaration) -> list[str]:
    specs = [variable.type for section in declaration.sections for variable in section.variables]
    return [name for spec in (*specs, declaration.result) if (name := _generic_name(spec))]


def _generic_name(spec: tree.TypeSpec | None) -> str:
    name = spec.name.upper() if isinstance(spec, tree.NamedType) else ""
    return name if name in KINDS else ""


def _settled(spec: tree.TypeSpec, types: dict[str, Elementary | StringType]) -> tree.TypeSpec:
    type = types.get(_generic_name(spec))
    if type is None:
        return spec
    span: Span = spec.span
    if isinstance(type, StringType):
        return tree.StringSpec(tree.Literal("int", type.capacity, None, span), span, type.width == 2)
    return tree.NamedType(type.name, span)
