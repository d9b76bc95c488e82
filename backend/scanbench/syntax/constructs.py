"""What a file is made of: how often it uses each construct of the language."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from scanbench.syntax import tree
from scanbench.syntax.objects import MEMBER

_NAMES: dict[type, str] = {
    tree.Assignment: "assignment",
    tree.IfStatement: "IF",
    tree.CaseStatement: "CASE",
    tree.ForStatement: "FOR",
    tree.WhileStatement: "WHILE",
    tree.RepeatStatement: "REPEAT",
    tree.TryStatement: "__TRY",
    tree.ExitStatement: "EXIT",
    tree.ContinueStatement: "CONTINUE",
    tree.ReturnStatement: "RETURN",
    tree.Call: "call",
    tree.IndexOf: "array index",
    tree.MemberOf: "member access",
    tree.Dereference: "dereference ^",
    tree.PartialAccess: "partial access",
    tree.TypedName: "Type#Value",
    tree.DirectAddress: "direct address",
    tree.ArraySpec: "ARRAY",
    tree.OpenArraySpec: "ARRAY[*]",
    tree.EnumSpec: "enumeration",
    tree.SubrangeSpec: "subrange",
    tree.StringSpec: "STRING",
    tree.ArrayInit: "array initial value",
    tree.StructInit: "structure initial value",
    tree.TaskDeclaration: "TASK",
    tree.ProgramDeclaration: "program instance",
    tree.ResourceDeclaration: "RESOURCE",
    tree.Configuration: "CONFIGURATION",
    tree.AccessDeclaration: "VAR_ACCESS",
}


def count_constructs(file: tree.File) -> Counter[str]:
    """The constructs of a file by name."""
    return Counter(name for node in _nodes(file) if (name := _name(node)))


def _name(node: object) -> str:
    match node:
        case tree.PouDeclaration(kind=kind):
            return "" if kind == MEMBER else kind.upper()
        case tree.VariableSection(keyword=keyword):
            return keyword
        case tree.StructSpec(union=union):
            return "UNION" if union else "STRUCT"
        case tree.ReferenceSpec(pointer=pointer):
            return "POINTER TO" if pointer else "REF_TO"
        case tree.IlInstruction(operator=operator):
            return f"IL {operator}" if operator else "IL label"
        case tree.UnaryOp(op=op) | tree.BinaryOp(op=op):
            return f"operator {op.upper()}"
        case tree.Literal(kind=kind):
            return f"{kind} literal"
        case tree.Variable(address=str()):
            return "located variable"
    return _NAMES.get(type(node), "")


def _nodes(root: object) -> Iterator[object]:
    """Every node of the tree; a list of its own instead of recursion, as expressions may be deep."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if isinstance(node, tuple | list):
            waiting += node
        elif is_dataclass(node) and not isinstance(node, type) and type(node).__module__ == tree.__name__:
            yield node
            waiting += (getattr(node, field.name) for field in fields(node))
