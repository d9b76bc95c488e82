"""Names of the values of enumerations -> constants."""

from scanbench.check.body.context import Body
from scanbench.check.uses import Symbol, prefix_of, value_symbol
from scanbench.problems import Span
from scanbench.program.program import Const
from scanbench.program.shown import shown
from scanbench.program.types import Enumeration, Record, Reference, Type
from scanbench.syntax import tree


def enumeration_value(body: Body, name: str, wanted: Type | None, span: Span) -> Const | None:
    """The value of an enumeration, by its bare name: of the type wanted, else of the only one that has it."""
    if isinstance(wanted, Enumeration):
        value = _value(wanted, name)
        if value is not None:
            body.report.use(span, name, value_symbol(wanted, name))
            return value
    found = body.declarations.values.find(name, _owners(body))
    if len(found) > 1:
        choices = " or ".join(f"{type}#{name}" for type in found)
        raise body.report.reject("T001", f"`{name}` may be {choices}; write which.", span)
    if not found:
        return None
    body.report.use(span, name, value_symbol(found[0], name))
    return _value(found[0], name)


def is_value_name(body: Body, node: tree.Expression) -> bool:
    """Whether it is a bare name that may be a value of an enumeration."""
    return isinstance(node, tree.Name) and body.scope.find(node.name) is None


def _owners(body: Body) -> set[str]:
    parts = body.scope.pou.upper().split(".")
    owners = {".".join(parts[:count]) for count in range(1, len(parts) + 1)}
    for record in (body.scope.instance, body.scope.frame, *body.scope.constants):
        if record is not None:
            owners |= {record.name.upper(), *(member.home.upper() for member in record.members.values())}
    return owners


def typed(body: Body, type_name: str, span: Span) -> None:
    """Notes the type that a literal of this span names."""
    found = body.declarations.find_type(type_name, span)
    if found is not None:
        body.report.use(prefix_of(span, type_name), type_name, Symbol("type", "", found))


def value_of_type(body: Body, type_name: str, name: str, span: Span) -> Const:
    """`Color#RED`."""
    type = body.declarations.named(type_name, span)
    if not isinstance(type, Enumeration):
        raise body.report.reject("S004", f"`{type_name}` is {type}, not an enumeration with `{name}`.", span)
    value = _value(type, name)
    if value is None:
        hint = body.report.near(name, lambda: [each for each, _ in type.values], f"value:{type}")
        raise body.report.reject("T001", f"{type} has no value `{name}`.{hint}", span)
    body.report.use(span, name, value_symbol(type, name))
    return value


def qualified_value(body: Body, node: tree.MemberOf) -> Const | None:
    """`Color.RED`, as vendors write it, when there is no variable of that name."""
    owner = node.owner
    while isinstance(owner, tree.MemberOf):
        owner = owner.owner
    if not isinstance(owner, tree.Name):
        return None
    variable = body.scope.find(owner.name)
    if variable is not None and isinstance(variable[0].type, Record | Reference):
        return None
    key = body.declarations.find_type(shown(node.owner), node.span)
    if key is None or key not in body.declarations.type_trees:
        return None
    if not isinstance(body.declarations.named(shown(node.owner), node.span), Enumeration):
        return None
    body.report.use(node.owner.span, shown(node.owner), Symbol("type", "", key))
    return value_of_type(body, shown(node.owner), node.name, node.span)


def _value(type: Enumeration, name: str) -> Const | None:
    number = type.number(name)
    return None if number is None else Const(type, number)
