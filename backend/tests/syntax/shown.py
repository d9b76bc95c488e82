"""A tree as short text without places, to compare with; everything a node holds is in it."""

from dataclasses import fields, is_dataclass

from scanbench.problems import Problem, Span
from scanbench.syntax import tree
from scanbench.syntax.parse_file import parse_file
from scanbench.syntax.source import Source

MARKS = {"add": "+", "sub": "-", "mul": "*", "div": "/", "pow": "**", "eq": "=", "ne": "<>", "lt": "<", "gt": ">"}


def read(text: str, name: str = "a.st") -> tuple[tree.File, list[Problem]]:
    return parse_file(Source(name, text))


def well(text: str, name: str = "a.st") -> tree.File:
    """The tree of a text without problems."""
    file, problems = read(text, name)
    assert not problems, "\n".join(map(str, problems))
    return file


def complaints(text: str, name: str = "a.st") -> list[str]:
    """`code line:column message` of each problem."""
    return [f"{each.code} {each.span.line}:{each.span.column} {each.message}" for each in read(text, name)[1]]


def body(text: str) -> tuple[tree.Statement, ...]:
    """The statements of a program that has this body."""
    found = well(f"PROGRAM p\n{text}\nEND_PROGRAM").pous[0].body
    assert isinstance(found, tuple)
    return found


def show_body(text: str) -> str:
    return " ".join(show(each) for each in body(text))


def show_expression(text: str) -> str:
    (statement,) = body(f"x := {text};")
    assert isinstance(statement, tree.Assignment)
    return show(statement.value)


def show(node: object) -> str:
    """Operators as `(a + b)`; every other node by its class and what it holds, defaults left out."""
    match node:
        case tree.Name(name=name):
            return name
        case tree.BinaryOp(op=op, left=left, right=right):
            return f"({show(left)} {MARKS.get(op, op)} {show(right)})"
        case tree.UnaryOp(op=op, operand=operand):
            return f"{op}({show(operand)})"
        case tree.MemberOf(owner=owner, name=name):
            return f"{show(owner)}.{name}"
        case tree.Literal(value=value, type_name=type_name):
            return f"{type_name}#{value!r}" if type_name else repr(value)
        case tree.TypedName(type_name=type_name, name=name):
            return f"{type_name}#{name}"
        case tree.NamedType(name=name):
            return name
        case tuple() | list():
            return "[" + ", ".join(show(each) for each in node if not isinstance(each, Span)) + "]"
    if is_dataclass(node) and not isinstance(node, type):
        name = type(node).__name__.removesuffix("Statement").removesuffix("Spec")
        return f"{name}({', '.join(_fields(node))})"
    return str(node)


def _fields(node: object) -> list[str]:
    assert is_dataclass(node)
    made = []
    for field in fields(node):
        value = getattr(node, field.name)
        if not isinstance(value, Span) and value not in (None, (), False, "", field.default):
            made.append(f"{field.name}={show(value)}")
    return made
