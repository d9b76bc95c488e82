"""The syntax tree: what was written, with places, before any name is looked up."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeVar, dataclass_transform

from scanbench.problems import Span

if TYPE_CHECKING:
    from scanbench.syntax.chart import Chart
    from scanbench.syntax.networks import NetworkBody

T = TypeVar("T")


@dataclass_transform(frozen_default=True)
def node(made: type[T]) -> type[T]:
    """A node is never changed once made. The type checker sees to that; `frozen=True` would have Python watch every
    assignment, which makes a large file a fifth slower to read."""
    return dataclass(slots=True, unsafe_hash=True)(made)


# ---- expressions ---------------------------------------------------------------------------------------------


@node
class Literal:
    """`kind` is int, real, bool, time, date, tod, dt, string or wstring; `type_name` is what stood before the `#`.

    time, date, tod and dt are integers of nanoseconds: a duration, since 1970-01-01, since midnight, since
    1970-01-01; their `type_name` is the type (TIME, LTIME, DATE, LDATE, TIME_OF_DAY, LTIME_OF_DAY, DATE_AND_TIME,
    LDATE_AND_TIME). string has one byte a character (Latin-1), wstring is UTF-16, little endian.
    """

    kind: str
    value: int | float | bytes
    type_name: str | None
    span: Span


@node
class Name:
    name: str
    span: Span


@node
class TypedName:
    """`Color#RED`: a value of an enumeration."""

    type_name: str
    name: str
    span: Span


@node
class DirectAddress:
    """`%IX0.0` inside an expression."""

    text: str
    span: Span


@node
class MemberOf:
    owner: "Expression"
    name: str
    span: Span


@node
class IndexOf:
    array: "Expression"
    indices: tuple["Expression", ...]
    span: Span


@node
class Dereference:
    """`pointer^`."""

    reference: "Expression"
    span: Span


@node
class PartialAccess:
    """`x.3`, `x.%X3`, `x.%B1`: bit or part number `index` of a bit string or integer; `size` is X, B, W, D or L, or begins with DATA."""

    owner: "Expression"
    size: str
    index: int
    span: Span


@node
class UnaryOp:
    """`-`, `+` or `NOT`."""

    op: str
    operand: "Expression"
    span: Span


@node
class BinaryOp:
    op: str
    left: "Expression"
    right: "Expression"
    span: Span


@node
class Argument:
    """`value`, `name := value`, `name => value` or `NOT name => value` (negated); `place` is that of the name."""

    name: str | None
    output: bool
    value: "Expression | None"
    span: Span
    negated: bool = False
    place: Span | None = None


@node
class Call:
    callee: "Expression"
    arguments: tuple[Argument, ...]
    span: Span


@node
class Aggregate:
    """`[1, 2, 3(0)]` or `(x := 1, y := 2)` as what is assigned, among the statements of vendors."""

    value: "ArrayInit | StructInit"
    span: Span


Expression = (
    Literal | Name | TypedName | DirectAddress | MemberOf | IndexOf | Dereference
    | PartialAccess | UnaryOp | BinaryOp | Call | Aggregate
)  # fmt: skip
"""THIS and SUPER are a Name; `THIS^.x` (vendors) dereferences it, `THIS.x` (the standard) does not."""

# ---- declarations --------------------------------------------------------------------------------------------


@node
class NamedType:
    """`name` may be qualified: `Motion.Axis`. `values` are those of `FB<10, (2 * n)>`."""

    name: str
    span: Span
    values: tuple[Expression, ...] = ()


@node
class StringSpec:
    length: Expression | None
    span: Span
    wide: bool = False
    """WSTRING."""


@node
class ArraySpec:
    ranges: tuple[tuple[Expression, Expression], ...]
    element: "TypeSpec"
    span: Span


@node
class OpenArraySpec:
    """`ARRAY[*, *] OF element`, of an in-out."""

    dimensions: int
    element: "TypeSpec"
    span: Span


@node
class StructSpec:
    """STRUCT or UNION. Members may have a relative address (`AT %B4`), which may overlap only with OVERLAP."""

    members: tuple["Variable", ...]
    span: Span
    union: bool = False
    overlap: bool = False
    extends: NamedType | None = None


@node
class EnumSpec:
    """`(RED, GREEN := 5) INT`: the values with their numbers where they are stated."""

    values: tuple[tuple[str, Expression | None, Span], ...]
    base: "NamedType | None"
    span: Span


@node
class SubrangeSpec:
    """`INT (-6..12)`."""

    base: NamedType
    low: Expression
    high: Expression
    span: Span


@node
class ReferenceSpec:
    """`REF_TO type` or `REFERENCE TO type`; `pointer`: `POINTER TO type`, with arithmetic."""

    target: "TypeSpec"
    pointer: bool
    span: Span
    automatic: bool = False
    """`REFERENCE TO` (vendors): dereferenced wherever it is used, bound with `REF=`."""


TypeSpec = NamedType | StringSpec | ArraySpec | OpenArraySpec | StructSpec | EnumSpec | SubrangeSpec | ReferenceSpec


@node
class ArrayInit:
    """`[1, 2, 3(0)]`: each item with its number of repetitions."""

    items: tuple[tuple[Expression | None, "Initial"], ...]
    span: Span


@node
class StructInit:
    """`(a := 1, b := 2)`; of the data blocks of one vendor also values of `parts` at any depth, `(c.d := 3, e[4] := 5)`."""

    members: tuple[tuple[str, "Initial", Span], ...]
    span: Span
    parts: tuple[tuple[Expression, "Initial"], ...] = ()


Initial = Expression | ArrayInit | StructInit


@node
class Variable:
    name: str
    type: TypeSpec
    initial: Initial | None
    address: str | None
    span: Span
    address_span: Span | None = None
    arguments: tuple["Argument", ...] = ()  # `inst : FB(a := 1)` of vendors: initial values of an instance
    edge: str = ""  # R or F for an input that is declared with R_EDGE or F_EDGE
    elements: tuple[tuple["Argument", ...], ...] = ()
    """`inst : ARRAY[1..2] OF FB[(a := 1), (a := 2)]` of vendors: the arguments of each element, in the order of memory."""
    policy: str = ""  # of a value outside of its subrange, where a pragma says one: `pragmas.POLICIES`


@node
class VariableSection:
    """`keyword` is VAR, VAR_INPUT, ...; `qualifiers` CONSTANT, RETAIN, ..."""

    keyword: str
    qualifiers: tuple[str, ...]
    variables: tuple[Variable, ...]
    span: Span
    access: str = "PROTECTED"
    """PUBLIC, PROTECTED, PRIVATE or INTERNAL, of a class's or block's VAR."""
    namespace: str = ""
    list_name: str = ""
    """Name of the global variable list (`GVL.x`) that a VAR_GLOBAL came from; its variables are visible without it too."""
    kept: str = ""
    """VAR_STAT or VAR_INST, where that was written for VAR."""
    using: tuple[str, ...] = ()
    """Of a VAR_GLOBAL: the namespaces whose names its declarations see without qualification."""


@node
class TypeDeclaration:
    name: str
    type: TypeSpec
    initial: Initial | None
    span: Span
    namespace: str = ""
    using: tuple[str, ...] = ()
    access: str = "PUBLIC"  # or INTERNAL, of a namespace
    attributes: tuple[str, ...] = ()
    """Those of a vendor that mean something: of an enumeration `qualified_only` (values have its name in front) and `to_string`, of a structure `pack_mode=1`."""
    policy: str = ""  # as of a variable


@node
class IlInstruction:
    """`label: ANDN( operand`. A label alone has operator ''; a closing parenthesis has operator ')'.

    `operator` is in upper case without modifiers: LD ST S R AND OR XOR NOT ADD SUB MUL DIV MOD GT GE EQ NE LE LT JMP
    CAL RET, an input of a standard block (S1 R1 CLK CU CD PV IN PT, with the instance as operand), or the name of a
    function. `arguments` are those of CAL (after its operand), or of a function (formal ones, or operands but the first).
    """

    label: str | None
    operator: str
    negated: bool
    conditional: bool
    deferred: bool
    """The modifier `(`: the operator is applied at the closing parenthesis."""
    operand: Expression | None
    arguments: tuple[Argument, ...]
    span: Span


@node
class IlBody:
    instructions: tuple[IlInstruction, ...]
    span: Span


@node
class PouDeclaration:
    """`kind` is program, function_block, function, class, interface, method, or get and set of a property.

    A property `p` is in `methods` as one or two declarations of that name with kind get and set; `result` is
    its type for both.
    """

    kind: str
    name: str
    result: TypeSpec | None
    sections: tuple[VariableSection, ...]
    body: "tuple[Statement, ...] | IlBody | NetworkBody | Chart"
    span: Span
    """Of the name."""
    methods: tuple["PouDeclaration", ...] = ()
    extends: tuple[NamedType, ...] = ()
    """One base of a class or block; any number for an interface."""
    implements: tuple[NamedType, ...] = ()
    modifiers: tuple[str, ...] = ()
    """ABSTRACT, FINAL, OVERRIDE; of a method ACTION, and the attribute `call_after_init` in upper case; of a program STARTUP."""
    access: str = "PUBLIC"
    namespace: str = ""  # `A.B`, empty at the top
    using: tuple[str, ...] = ()
    """Namespaces whose names are visible without qualification, the enclosing ones not included."""
    in_out: str = ""
    """How it takes its in-outs, where a pragma says so: `reference` or `value`."""
    stub: bool = False
    """Whether a pragma says that its body takes the place of one that needs a device: the user sets what it gives."""
    overload: str = ""  # of the second FUNCTION of one name `(2)`, and so on; of methods of one name `(INT)`
    policy: str = ""  # of values outside of subranges in its statements, whose variables say none
    asked: tuple[NamedType, ...] = ()  # generic blocks that its statements make by `__NEW(FB<5>)`
    overlays: tuple[tuple[str, str, Span], ...] = ()  # of SCL: variables AT another one, both in upper case, and where


@node
class TaskDeclaration:
    name: str
    interval: Expression | None
    priority: Expression | None
    span: Span
    single: Expression | None = None
    """The variable whose rising edge starts the task."""


@node
class ProgramDeclaration:
    """`PROGRAM name WITH task : type (input := x, output => y, instance WITH task);`"""

    name: str
    task: str | None
    type: NamedType
    span: Span
    connections: tuple[Argument, ...] = ()
    block_tasks: tuple[tuple[str, str, Span], ...] = ()
    """(instance of a block, task): it runs in that task instead."""
    retain: bool = False  # `PROGRAM RETAIN name ...`


@node
class ResourceDeclaration:
    name: str
    globals: tuple[VariableSection, ...]
    tasks: tuple[TaskDeclaration, ...]
    programs: tuple[ProgramDeclaration, ...]
    span: Span


@node
class AccessDeclaration:
    """VAR_ACCESS: `name : resource.program.variable : type READ_WRITE;`"""

    name: str
    path: str
    type: TypeSpec
    writable: bool
    span: Span


@node
class Configuration:
    """`globals`, `tasks` and `programs` are those declared outside of a RESOURCE."""

    name: str
    globals: tuple[VariableSection, ...]
    tasks: tuple[TaskDeclaration, ...]
    programs: tuple[ProgramDeclaration, ...]
    span: Span
    resources: tuple[ResourceDeclaration, ...] = ()
    settings: tuple[Variable, ...] = ()
    """VAR_CONFIG: `name` is the path `resource.program.instance.variable`."""
    accesses: tuple[AccessDeclaration, ...] = ()
    using: tuple[str, ...] = ()
    """Namespaces whose names are visible without qualification."""


@dataclass(slots=True)
class File:
    """All that one file declares."""

    name: str
    types: list[TypeDeclaration] = field(default_factory=list)
    globals: list[VariableSection] = field(default_factory=list)
    pous: list[PouDeclaration] = field(default_factory=list)
    configurations: list[Configuration] = field(default_factory=list)
    settings: list[Variable] = field(default_factory=list)  # VAR_CONFIG outside of a CONFIGURATION
    internal: list[str] = field(default_factory=list)  # namespaces that are declared INTERNAL, by their full names
    stimuli: list["Stimulus"] = field(default_factory=list)
    members: list[PouDeclaration] = field(default_factory=list)  # of POUs in other files, see `objects.joined`


@dataclass(eq=False, slots=True)
class Stimulus:
    """A table of inputs: from each moment on, the variables have the values of its row; empty cells change nothing."""

    file: str
    text: str
    by_time: bool
    """Moments are ns since the start of the program; else scans."""
    delimiter: str
    columns: tuple[tuple[str, Span], ...]
    """The variables: as they were written, and where."""
    span: Span
    moments: list[int] = field(default_factory=list)
    """Ascending."""
    rows: list[list[str]] = field(default_factory=list)
    """What was written, for each moment; a row may end early."""
    lines: list[int] = field(default_factory=list)
    """Of the file, for each moment."""
    period: int = 0
    """After this the rows come again; 0: never."""
    known: dict[int, tuple[object, object]] = field(default_factory=dict)
    """For whoever reads the cells: by column, for which type, and what came out. It holds as long as the table."""


# ---- statements ------------------------------------------------------------------------------------------------


@node
class Assignment:
    """`operator` is `:=`, `S=` and `R=` (latch, unlatch), `REF=` (bind a reference), `?=` (assignment attempt), or one like `+=`,
    whose value is the whole sum, with the span of the operator. Of `a := b := c`, `also` is `b`."""

    target: Expression
    value: Expression
    span: Span
    operator: str = ":="
    also: tuple[Expression, ...] = ()


@node
class ExpressionStatement:
    """A call, or an expression whose value is lost."""

    expression: Expression
    span: Span


@node
class IfStatement:
    branches: tuple[tuple[Expression, tuple["Statement", ...]], ...]
    orelse: tuple["Statement", ...]
    span: Span


@node
class CaseStatement:
    """Labels are (first, last); a single label has last None."""

    selector: Expression
    branches: tuple[tuple[tuple[tuple[Expression, Expression | None], ...], tuple["Statement", ...]], ...]
    orelse: tuple["Statement", ...]
    span: Span


@node
class ForStatement:
    variable: Expression
    start: Expression
    end: Expression
    step: Expression | None
    body: tuple["Statement", ...]
    span: Span


@node
class WhileStatement:
    condition: Expression
    body: tuple["Statement", ...]
    span: Span


@node
class RepeatStatement:
    body: tuple["Statement", ...]
    until: Expression
    span: Span


@node
class ExitStatement:
    span: Span


@node
class ContinueStatement:
    span: Span


@node
class ReturnStatement:
    span: Span
    condition: Expression | None = None


@node
class TryStatement:
    """`__TRY body __CATCH(caught) handler __FINALLY final __ENDTRY`; `caught` is None where nothing is in parentheses.
    `catch` is the place of `__CATCH`."""

    body: tuple["Statement", ...]
    caught: Expression | None
    catch: Span
    handler: tuple["Statement", ...]
    final: tuple["Statement", ...]
    span: Span


@node
class LabelStatement:
    """`name:`, where a jump leads to."""

    name: str
    span: Span


@node
class JumpStatement:
    """`JMP name;`"""

    name: str
    span: Span


Statement = (
    Assignment | ExpressionStatement | IfStatement | CaseStatement | ForStatement | WhileStatement
    | RepeatStatement | ExitStatement | ContinueStatement | ReturnStatement | LabelStatement | JumpStatement
    | TryStatement
)  # fmt: skip
