"""Operands and operators of IL -> pieces of the tree of ST, and what is known of them before anything is checked."""

from scanbench.check.body.context import Body
from scanbench.check.declare.scopes import Scope
from scanbench.problems import Span
from scanbench.program.program import Const
from scanbench.program.types import ArrayType, Elementary, Member, OpenArray, Record, Section, Type, base_of
from scanbench.program.untyped import ANY_INT, is_untyped
from scanbench.syntax import tree

BINARY = {
    "AND": "and", "&": "and", "OR": "or", "XOR": "xor", "ADD": "add", "SUB": "sub", "MUL": "mul", "DIV": "div",
    "MOD": "mod", "GT": "gt", "GE": "ge", "EQ": "eq", "NE": "ne", "LE": "le", "LT": "lt",
}  # fmt: skip


def wanted_by(scope: Scope, node: tree.IlInstruction) -> Elementary | None:
    """The type of what the instruction works on: that which a literal before it takes."""
    takes = node.operator == "ST" or (node.operator in BINARY and not node.arguments)
    type = type_of(scope, node.operand) if takes and node.operand is not None else None
    return base_of(type) if isinstance(type, Elementary) else None


def type_of(scope: Scope, node: tree.Expression) -> Type | None:
    """The type of a variable, without a word where there is none: nothing is checked yet."""
    match node:
        case tree.Name(name):
            found = scope.find(name)
            return found[0].type if found else None
        case tree.MemberOf(owner, name):
            record = type_of(scope, owner)
            member = record.members.get(name.upper()) if isinstance(record, Record) else None
            return member.type if member else None
        case tree.IndexOf(array):
            type = type_of(scope, array)
            return type.element if isinstance(type, ArrayType | OpenArray) else None
    return None


def hidden(body: Body, name: str, type: Type, span: Span) -> Member:
    """The temporary of this name and type in the frame of the POU, made where there is none yet."""
    frame = body.scope.frame
    assert frame is not None
    while (known := frame.members.get(name.upper())) is not None:
        if known.type == type:
            return known
        name += "'"  # a different type with the same name
    member = Member(name, type, Section.TEMP, span, hidden=True)
    frame.place(member)
    frame.close()
    return member


def literal(node: tree.Expression, value: object) -> tree.Expression | None:
    """The literal that goes on as current result, to take the type that it meets; None for what has its type."""
    if not isinstance(value, Const):
        return None
    if is_untyped(value):
        return tree.Literal("int" if value.type == ANY_INT else "real", value.value, None, node.span)
    return node if isinstance(node, tree.Literal) and node.type_name is None else None


def negated(node: tree.Expression) -> tree.Expression:
    """NOT of it."""
    return tree.UnaryOp("not", node, node.span)


def callee(node: tree.IlInstruction) -> tree.Expression:
    """What the operator names, when it is a call."""
    first, *rest = node.operator.split(".")
    callee: tree.Expression = tree.Name(first, node.span)
    for name in rest:
        callee = tree.MemberOf(callee, name, node.span)
    return callee


def shown(node: tree.IlInstruction) -> str:
    """The operator as it was written."""
    conditional = "C" if node.conditional else ""
    return f"{node.operator}{conditional}{'N' if node.negated else ''}{'(' if node.deferred else ''}"
