"""The checked program: what the engines run. Every name is an offset, every type is known, every conversion explicit.

The contract of the two engines; no behaviour here. Semantics that both must keep to the bit:

- Integers wrap at the declared width. `div` by zero traps, the smallest number / -1 wraps; `mod` has the sign of the dividend, `a MOD 0` and `smallest MOD -1`
  are 0. Bit strings are unsigned.
- REAL is computed in single precision, each operation rounded; LREAL in double; no contraction, no fast-math. `mod` is not defined for them; `div` by zero
  gives an infinity or NaN. A NaN is *stored* as the canonical quiet NaN (16#7FC0_0000, 16#7FF8_0000_0000_0000), unless the assignment copies a variable
  (`bodies.keeps_bits`). `eq lt le gt ge` with a NaN are FALSE, `ne` is TRUE.
- `Convert`: between integers, bit strings, BOOL and TIME: sign or zero extension by the *source*, then truncation; to BOOL: value <> 0. Integer to REAL:
  nearest, ties to even, in one rounding. REAL to integer: ties to even, saturated at the target's bounds, NaN is 0. LREAL to REAL: nearest. To or from STRING:
  only STRING to STRING (cut at capacity).
- AND, OR on BOOL evaluate both sides. Operands and arguments are evaluated from left to right; an assignment evaluates the value, then the address of its
  target; that of an output's target comes after the call, of a function after all it gives is read.
- FOR: bounds and step are evaluated once, in the order start, end, step; the counter is a value of its own that is stored to the variable at the start of every round, and
  once more when the loop ends normally (the value that failed the test, wrapped at the width of the variable). A loop over the full range of its type ends. Step 0 gives no round.
  Budget is taken before the counter is stored; the place of the variable is evaluated at each store. With `again`: store, end and step, test, budget, body, step to be added.
- Loop budget: `Layout.BUDGET` (i64 in the image) counts down one a round of WHILE and REPEAT, and of FOR loops with `exits`; a FOR without `exits` takes all its rounds from it
  at once before the first (saturating at i64). Below zero the loop traps with kind `loop` (before the round's body). CONTINUE goes on with FOR's count, WHILE's condition, REPEAT's UNTIL.
- Types are seen by `kind` and `size` alone: an Enumeration, Subrange or Reference computes like its base (a reference like an unsigned 64-bit integer), DATE
  like TIME, CHAR like a bit string.
- A reference or in-out slot holds a byte offset in bits 0-31 and a bit number, which BOOL alone looks at, in bits 32-34. It traps at `null_trap` (0 is NULL),
  before the indices are evaluated, where bits 35-63 are not 0, or the byte offset is below `Layout.HEADER_SIZE`, or byte offset + `Place.offset` + the largest
  distance of the indices with fixed bounds + the size of `Place.type` is beyond the end: for a slot that of the image, for `Place.reference` that of the state
  (`Layout.state_size`), because a program must not depend on the contents of frames between calls. With an index of computed bounds the place that was found
  must lie in there too. After a reference nothing is known of alignment.
- A BOOL in a whole byte is written as 0 or 1, and read as bit 0.
- A string value longer than the capacity of its target is cut. Only the length and the characters are written.
- A trap ends the scan at once; what was written before it stays.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from scanbench.problems import Span
from scanbench.program.sites import CallSite, CheckSite, TrapSite
from scanbench.program.types import Elementary, Member, Record, Reference, Section, StringType, Type
from scanbench.syntax.language_file import DialectName

if TYPE_CHECKING:
    from scanbench.program.layout import Layout
    from scanbench.program.tasks import AccessPath, ProgramInstance, Task


# ---- places: where a value lives -------------------------------------------------------------------------------


class Base(StrEnum):
    IMAGE = "image"
    """`offset` counts from the start of the image (globals, areas, program instances)."""
    SELF = "self"
    """`offset` counts from the instance that runs."""
    FRAME = "frame"
    """`offset` counts from `Pou.frame_offset`: temporaries, and all variables of a FUNCTION."""


@dataclass(frozen=True, slots=True)
class Index:
    """One computed array index: adds (value - low) * stride; outside low..high traps.

    `low`, `high` and `stride` are expressions of LINT without effects for an ARRAY[*], all three.
    """

    value: "Expr"
    low: "int | Expr"
    high: "int | Expr"
    stride: "int | Expr"
    trap: int


@dataclass(frozen=True, slots=True)
class Place:
    """Address = base + offset + the indices' strides. With `slot`, base is the reference stored there instead.

    With `reference`, base is the value of that expression, of a Reference type (evaluated before the indices). `bit` is set for one bit of a byte: a BOOL
    inside an area, or a bit of an integer. A BOOL reached through a slot or reference without `bit` is the bit that the reference says. `type` may be smaller
    than the variable (a part of an integer, a member of a union), so places of one variable may overlap in any way. `variable` names the declared variable that
    holds this place ('' when it may be any, as through an in-out): places of different variables never overlap, except that all places whose variable begins
    with '@' (areas of the model) may overlap each other."""

    type: Type
    base: Base
    offset: int
    indices: tuple[Index, ...] = ()
    bit: int | None = None
    slot: "Place | None" = None
    null_trap: int = 0
    variable: str = ""
    reference: "Expr | None" = None


# ---- expressions --------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Const:
    """int for BOOL (0, 1), integers, bit strings, CHAR (unsigned), TIME, DATE (ns) and references; float for REAL;
    bytes for STRING (Latin-1) and WSTRING (UTF-16, little endian)."""

    type: Elementary | StringType
    value: int | float | bytes


@dataclass(frozen=True, slots=True)
class Load:
    place: Place

    @property
    def type(self) -> Type:
        return self.place.type


@dataclass(frozen=True, slots=True)
class Unary:
    """`neg` on numbers and TIME, `not` on BOOL and bit strings."""

    op: str
    type: Elementary
    operand: "Expr"


@dataclass(frozen=True, slots=True)
class Binary:
    """add sub mul div mod on numbers and TIME; and or xor on BOOL and bit strings. Both operands have `type`."""

    op: str
    type: Elementary
    left: "Expr"
    right: "Expr"
    trap: int = 0
    short: bool = False
    """AND_THEN or OR_ELSE, where evaluating the right side in any case makes no difference but to who observes reads."""


@dataclass(frozen=True, slots=True)
class Compare:
    """eq ne lt le gt ge on two operands of the same kind; strings by code, the shorter first. Gives BOOL."""

    op: str
    type: Elementary
    left: "Expr"
    right: "Expr"


@dataclass(frozen=True, slots=True)
class Convert:
    type: Elementary | StringType
    operand: "Expr"


@dataclass(frozen=True, slots=True)
class Intrinsic:
    """A standard function that ST cannot say; names and rules in `check/standard/__init__.py`."""

    name: str
    type: Elementary | StringType
    args: tuple["Expr", ...]


@dataclass(frozen=True, slots=True)
class CallFunction:
    """A user's (or an ST library's) FUNCTION. All of `args` are evaluated, in order, before anything is stored.

    `args` go with `Pou.parameters`: an Expr for an input, a Place for an in-out (its reference), a Place or None for an output (receives the value after the
    call)."""

    pou: "Pou"
    type: Type | None
    args: tuple["Expr | Place | None", ...]
    site: int = 0


@dataclass(frozen=True, slots=True)
class RefOf:
    """REF(place): its offset, and for a BOOL its bit number, as a reference. Never of a temporary."""

    place: Place
    type: Reference


@dataclass(frozen=True, slots=True)
class Limit:
    """A subrange check: the value, of `type` or a wider integer, brought to low..high; one outside is recorded at `site` (`Layout.violations`).
    With `site` 0 it is known to be inside, and nothing is done."""

    type: Elementary
    value: "Expr"
    low: int
    high: int
    site: int
    bound: "Place | None" = None
    """What is checked by the name of an in-out, or through a reference: an entry says which variable it was."""


@dataclass(frozen=True, slots=True)
class Violates:
    """BOOL: whether the value is outside of low..high; recorded at `site` when it is, unless `site` is 0. `bound` as in `Limit`."""

    type: Elementary
    value: "Expr"
    low: int
    high: int
    site: int
    bound: "Place | None" = None


@dataclass(frozen=True, slots=True)
class Sequence:
    """Runs the statements (none leaves: no EXIT, RETURN, CONTINUE or jump out), then gives the value."""

    body: tuple["Stmt", ...]
    value: "Expr"

    @property
    def type(self) -> Type | None:
        return self.value.type


Expr = (
    Const | Load | Unary | Binary | Compare | Convert | Intrinsic | CallFunction | RefOf | Limit | Violates | Sequence
)
"""Every expression has `.type`. A Load or CallFunction may have an aggregate type (whole array, STRUCT)."""


# ---- statements -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Assign:
    """Scalar, string (cut) or whole aggregate (bytes; source and target have the same type, and may overlap)."""

    target: Place
    value: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class SetBytes:
    """Fixed bytes into a place: start values of local aggregates at each call."""

    target: Place
    data: bytes
    span: Span


@dataclass(frozen=True, slots=True)
class CallBlock:
    """Runs a FUNCTION_BLOCK instance. The instance's address is computed once, first.

    Then, in order of writing: each input is evaluated and stored (`inputs`: place relative to the instance, as Base.SELF of the callee), each in-out's
    reference is stored in its slot; the body runs; outputs are copied out."""

    instance: Place
    pou: "Pou"
    inputs: tuple[tuple[Place, Expr], ...]
    in_outs: tuple[tuple[Place, Place], ...]
    outputs: tuple[tuple[Expr, Place], ...]
    """(value, where Base.SELF is the *callee*; target, where Base.SELF is the caller)."""
    span: Span
    site: int = 0


@dataclass(frozen=True, slots=True)
class Evaluate:
    """A function called for its effects; the result is dropped."""

    call: CallFunction
    span: Span


@dataclass(frozen=True, slots=True)
class If:
    """`branches`: condition and body, in order; then `orelse`."""

    branches: tuple[tuple[Expr, tuple["Stmt", ...]], ...]
    orelse: tuple["Stmt", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Case:
    """`selector` is an integer or bit string; labels are inclusive ranges that do not overlap."""

    selector: Expr
    branches: tuple[tuple[tuple[tuple[int, int], ...], tuple["Stmt", ...]], ...]
    orelse: tuple["Stmt", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class For:
    """`start`, `end`, `step` have the type of `variable`, an integer. A variable of up to 32 bits: the loop `follows` what the body writes, and evaluates `again`."""

    variable: Place
    start: Expr
    end: Expr
    step: Expr
    body: tuple["Stmt", ...]
    exits: bool
    trap: int
    span: Span
    bounds: tuple[int, int] | None = None
    """Of a subrange variable: the value stored when the loop ends is brought between these, without a record."""
    given: tuple[tuple[Place, int, int], ...] = ()
    """Where all of these are between their bounds as the loop begins, `inside` does the same as `body`, with fewer checks."""
    inside: tuple["Stmt", ...] = ()
    follows: bool = False
    again: bool = False


@dataclass(frozen=True, slots=True)
class While:
    condition: Expr
    body: tuple["Stmt", ...]
    trap: int
    span: Span


@dataclass(frozen=True, slots=True)
class Repeat:
    body: tuple["Stmt", ...]
    until: Expr
    trap: int
    span: Span


@dataclass(frozen=True, slots=True)
class Exit:
    span: Span


@dataclass(frozen=True, slots=True)
class Continue:
    span: Span


@dataclass(frozen=True, slots=True)
class Return:
    span: Span


@dataclass(frozen=True, slots=True)
class Blocks:
    """With labels: runs the blocks one after the other; `Jump` goes on at the start of one. Never in a loop or other Blocks."""

    blocks: tuple[tuple["Stmt", ...], ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Jump:
    """Goes on at block `target` of the Blocks around, also out of what is in its block. A jump to its own or an earlier block takes one from the loop budget."""

    target: int
    back: bool
    trap: int
    span: Span


@dataclass(frozen=True, slots=True)
class Try:
    """Runs `body`. A trap in it, also in what it calls, whose kind has a code (`sites.EXCEPTIONS`), ends the body there: `Layout.DEPTH` becomes what it was at
    the beginning, the code is stored in `code`, and `handler` runs.

    Then `final` runs, also where body or handler leave (EXIT, CONTINUE, RETURN, a jump) or the handler traps itself with such a kind; after it what was
    interrupted goes on. Nothing leaves `final`. A trap without a code ends the scan at once."""

    body: tuple["Stmt", ...]
    code: Place
    """A temporary, UDINT."""
    handler: tuple["Stmt", ...]
    final: tuple["Stmt", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Halt:
    """Traps, always."""

    trap: int
    span: Span


Stmt = (
    Assign | SetBytes | CallBlock | Evaluate | If | Case | For | While | Repeat | Exit | Continue | Return | Blocks | Jump | Halt
    | Try
)  # fmt: skip


@dataclass(eq=False, slots=True)
class Pou:
    """A PROGRAM, FUNCTION_BLOCK or FUNCTION, ready to run. `body` starts by setting its temporaries."""

    name: str
    kind: str
    """`program`, `function_block` or `function`; a method is a function with the in-out THIS."""
    instance: Record
    """Variables of an instance; empty for a function."""
    frame: Record
    """Temporaries; for a function: parameters, locals and the result (see `returned`)."""
    parameters: tuple[str, ...]
    """Function: upper-case names of the inputs, in-outs and outputs, in order; keys of `frame.members`."""
    result: Type | None
    span: Span
    body: tuple[Stmt, ...] = ()
    frame_offset: int = 0
    inline: bool = False
    """Small and from the standard library: worth inlining at every call."""
    recursive: bool = False
    """It may be called while it runs: its caller keeps what is in its frame while it stores arguments, until it has the results."""
    addressed: bool = False
    """A reference is made to a variable of its frame, which is part of the state then."""
    first_trap: int = 0
    """Trap sites in the body count from here (`Program.traps[first_trap + number - 1]`); checks from `first_check`, calls from `first_call`."""
    first_check: int = 0
    first_call: int = 0
    called_at: int = 0
    """Where in the image its caller writes who calls (`Layout.PATH_LIMIT`); 0 where nothing in it, or in what it calls, can be outside of a subrange."""

    @property
    def this(self) -> Member | None:
        """The slot of a method that holds its instance."""
        member = self.frame.members.get("THIS")
        return member if member is not None and member.hidden else None

    @property
    def returned(self) -> Member | None:
        """The member of the frame that holds a function's result: the one of Section.RESULT."""
        if self.result is None:
            return None
        return next((each for each in self.frame.members.values() if each.section is Section.RESULT), None)


@dataclass(frozen=True, slots=True)
class Program:
    """A whole program on one model: immutable, the same for both engines. Image bytes are described by `layout`."""

    pous: tuple[Pou, ...]
    """Callees before callers."""
    tasks: tuple["Task", ...]
    interval_ns: int
    """Length of a scan in virtual time: the greatest common divisor of the tasks' intervals."""
    traps: tuple[TrapSite, ...]
    layout: "Layout"
    initial_image: bytes
    checks: tuple[CheckSite, ...] = ()
    calls: tuple[CallSite, ...] = ()
    accesses: tuple["AccessPath", ...] = ()
    common: tuple["ProgramInstance", ...] = ()
    """Phase 1: keeps the model's system words alive (first cycle flag, clock pulses, clock). Made from the model."""
    life: tuple["ProgramInstance", ...] = ()
    """Phase 1, after `common`: at most one, which initialises new instances (FB_init). What it calls is observed like a task."""
    called: tuple["ProgramInstance", ...] = ()
    """Of programs that no task runs, but other POUs may call."""
    plant: tuple["ProgramInstance", ...] = ()
    """Phase 2: the project's `plant/`: programs and stimuli that drive the inputs, before the forces."""
    tasked: tuple[Pou, ...] = ()
    """Those of `pous` that tasks or `life` run, themselves or through others; the plant may run them too."""
    dialect: DialectName = "iec"
    """In which it is written: what people type about it is understood in the same way."""

    @property
    def instances(self) -> tuple["ProgramInstance", ...]:
        """Every instance of a program: of common processing, of the tasks, of the plant. Blocks that a task runs are none."""
        tasks = (each for task in self.tasks for each in task.programs if each.pou.kind == "program")
        return (*self.common, *self.life, *tasks, *self.called, *self.plant)

    @property
    def shown(self) -> tuple["ProgramInstance", ...]:
        """The same without what was made from the model, and what initialises instances."""
        return self.instances[len(self.common) + len(self.life) :]
