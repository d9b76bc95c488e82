"""The syntax tree: what was written, with places, before any name is looked up."""

from dataclasses import dataclass, field

from scanbench.problems import Span

# ---- expressions ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Literal:
    """`kind` is int, real, time, string or bool; `type_name` is what stood before the `#`, if anything."""

    kind: str
    value: int | float | bytes
    type_name: str | None
    span: Span


@dataclass(frozen=True, slots=True)
class Name:
    name: str
    span: Span


@dataclass(frozen=True, slots=True)
class DirectAddress:
    """`%IX0.0` inside an expression."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class MemberOf:
    owner: "Expression"
    name: str
    span: Span


@dataclass(frozen=True, slots=True)
class IndexOf:
    array: "Expression"
    indices: tuple["Expression", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class UnaryOp:
    """`-`, `+` or `NOT`."""

    op: str
    operand: "Expression"
    span: Span


@dataclass(frozen=True, slots=True)
class BinaryOp:
    op: str
    left: "Expression"
    right: "Expression"
    span: Span


@dataclass(frozen=True, slots=True)
class Argument:
    """`value`, `name := value` or `name => value`."""

    name: str | None
    output: bool
    value: "Expression | None"
    span: Span


@dataclass(frozen=True, slots=True)
class Call:
    callee: "Expression"
    arguments: tuple[Argument, ...]
    span: Span


Expression = Literal | Name | DirectAddress | MemberOf | IndexOf | UnaryOp | BinaryOp | Call

# ---- declarations --------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class NamedType:
    name: str
    span: Span


@dataclass(frozen=True, slots=True)
class StringSpec:
    length: Expression | None
    span: Span


@dataclass(frozen=True, slots=True)
class ArraySpec:
    ranges: tuple[tuple[Expression, Expression], ...]
    element: "TypeSpec"
    span: Span


@dataclass(frozen=True, slots=True)
class StructSpec:
    members: tuple["Variable", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class UnsupportedSpec:
    """A type that was reported as not supported; what is declared with it is known, but has no type."""

    span: Span
    values: tuple[str, ...] = ()
    """Names that an enumeration would declare."""


TypeSpec = NamedType | StringSpec | ArraySpec | StructSpec | UnsupportedSpec


@dataclass(frozen=True, slots=True)
class ArrayInit:
    """`[1, 2, 3(0)]`: each item with how often it stands."""

    items: tuple[tuple[Expression | None, "Initial"], ...]
    span: Span


@dataclass(frozen=True, slots=True)
class StructInit:
    """`(a := 1, b := 2)`."""

    members: tuple[tuple[str, "Initial", Span], ...]
    span: Span


Initial = Expression | ArrayInit | StructInit


@dataclass(frozen=True, slots=True)
class Variable:
    name: str
    type: TypeSpec
    initial: Initial | None
    address: str | None
    span: Span
    address_span: Span | None = None


@dataclass(frozen=True, slots=True)
class VariableSection:
    """`keyword` is VAR, VAR_INPUT, ...; `qualifiers` CONSTANT, RETAIN, ..."""

    keyword: str
    qualifiers: tuple[str, ...]
    variables: tuple[Variable, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class TypeDeclaration:
    name: str
    type: TypeSpec
    initial: Initial | None
    span: Span


@dataclass(frozen=True, slots=True)
class PouDeclaration:
    """`kind` is program, function_block or function."""

    kind: str
    name: str
    result: TypeSpec | None
    sections: tuple[VariableSection, ...]
    body: tuple["Statement", ...]
    span: Span
    """Of the name."""


@dataclass(frozen=True, slots=True)
class TaskDeclaration:
    name: str
    interval: Expression | None
    priority: Expression | None
    span: Span


@dataclass(frozen=True, slots=True)
class ProgramDeclaration:
    """`PROGRAM name WITH task : type;`"""

    name: str
    task: str | None
    type_name: str
    span: Span


@dataclass(frozen=True, slots=True)
class Configuration:
    name: str
    globals: tuple[VariableSection, ...]
    tasks: tuple[TaskDeclaration, ...]
    programs: tuple[ProgramDeclaration, ...]
    span: Span


@dataclass(slots=True)
class File:
    """All that one file declares."""

    name: str
    types: list[TypeDeclaration] = field(default_factory=list)
    globals: list[VariableSection] = field(default_factory=list)
    pous: list[PouDeclaration] = field(default_factory=list)
    configurations: list[Configuration] = field(default_factory=list)


# ---- statements ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Assignment:
    target: Expression
    value: Expression
    span: Span


@dataclass(frozen=True, slots=True)
class ExpressionStatement:
    """A call, or an expression whose value is lost."""

    expression: Expression
    span: Span


@dataclass(frozen=True, slots=True)
class IfStatement:
    branches: tuple[tuple[Expression, tuple["Statement", ...]], ...]
    orelse: tuple["Statement", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class CaseStatement:
    """Labels are (first, last); a single label has last None."""

    selector: Expression
    branches: tuple[tuple[tuple[tuple[Expression, Expression | None], ...], tuple["Statement", ...]], ...]
    orelse: tuple["Statement", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class ForStatement:
    variable: Expression
    start: Expression
    end: Expression
    step: Expression | None
    body: tuple["Statement", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class WhileStatement:
    condition: Expression
    body: tuple["Statement", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class RepeatStatement:
    body: tuple["Statement", ...]
    until: Expression
    span: Span


@dataclass(frozen=True, slots=True)
class ExitStatement:
    span: Span


@dataclass(frozen=True, slots=True)
class ReturnStatement:
    span: Span


Statement = (
    Assignment
    | ExpressionStatement
    | IfStatement
    | CaseStatement
    | ForStatement
    | WhileStatement
    | RepeatStatement
    | ExitStatement
    | ReturnStatement
)
