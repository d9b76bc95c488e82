"""Expressions as text, for messages and for the names of what is checked."""

from scanbench.syntax import tree
from scanbench.syntax.lexer import DATA


def shown(node: tree.Expression) -> str:
    """As people write it, in short."""
    match node:
        case tree.Name(name):
            return name
        case tree.TypedName(type_name, name):
            return f"{type_name}#{name}"
        case tree.MemberOf(owner, name):
            return f"{shown(owner)}.{name}"
        case tree.IndexOf(array, indices):
            return f"{shown(array)}[{', '.join(map(shown, indices))}]"
        case tree.Dereference(reference):
            return f"{shown(reference)}^"
        case tree.PartialAccess(owner, size, index):
            return f"{shown(owner)}.{_part(size, index)}"
        case tree.DirectAddress(text):
            return text
        case tree.Literal("int", value):
            return str(value)
        case tree.Call(callee):
            return f"{shown(callee)}(...)"
        case tree.UnaryOp("neg", operand):
            return f"-{shown(operand)}"
        case tree.BinaryOp(op, left, right) if op in OPERATORS:
            return f"{shown(left)} {OPERATORS[op]} {shown(right)}"
    return "..."


def _part(size: str, index: int) -> str:
    if size.startswith(DATA):
        return f"{size}{index // 8}" + (f".{index % 8}" if size.endswith("X") else "")
    return str(index) if size == "X" else f"%{size}{index}"


OPERATORS = {
    "add": "+", "sub": "-", "mul": "*", "div": "/", "mod": "MOD", "pow": "**", "and": "AND", "or": "OR", "xor": "XOR",
    "assign": ":=", "eq": "=", "ne": "<>", "lt": "<", "le": "<=", "gt": ">", "ge": ">=", "and_then": "AND_THEN", "or_else": "OR_ELSE",
}  # fmt: skip
