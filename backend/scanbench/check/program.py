"""The checked program: what the engines run. Every name is an offset, every type is known, every conversion explicit.

The contract of the two engines; no behaviour here. Semantics that both must keep to the bit:

- Integers wrap at the declared width. `div` by zero traps, the smallest number / -1 wraps; `mod` has the sign of the
  dividend, `a MOD 0` and `smallest MOD -1` are 0. Bit strings are unsigned.
- REAL is computed in single precision, each operation rounded; LREAL in double; no contraction, no fast-math. `mod` is
  not defined for them; `div` by zero gives an infinity or NaN. A NaN is *stored* as the canonical quiet NaN
  (16#7FC0_0000, 16#7FF8_0000_0000_0000). `eq lt le gt ge` with a NaN are FALSE, `ne` is TRUE.
- `Convert`: between integers, bit strings, BOOL and TIME: sign or zero extension by the *source*, then truncation; to
  BOOL: value <> 0. Integer to REAL: nearest, ties to even, in one rounding. REAL to integer: ties to even, saturated
  at the target's bounds, NaN is 0. LREAL to REAL: nearest. To or from STRING: only STRING to STRING (cut at capacity).
- AND, OR on BOOL evaluate both sides. Operands and arguments are evaluated from left to right; an assignment evaluates
  the value, then the address of its target; the address of an output's target is taken after the call,
  and for a function after all outputs and the result are read.
- FOR: bounds and step are evaluated once, in the order start, end, step; the counter is a value of its own that is
  stored to the variable at the start of every round, and once more when the loop ends normally (the value that failed
  the test, wrapped at the width of the variable). A loop over the full range of its type ends. Step 0 gives no round.
  Budget is taken before the counter is stored; the place of the variable is evaluated at each store.
- Loop budget: `Layout.BUDGET` (i64 in the image) counts down one a round of WHILE and REPEAT, and of FOR loops with
  `exits`; a FOR without `exits` takes all its rounds from it at once before the first (saturating at i64). Where it
  falls below zero the loop traps with kind `loop` (before the round's body).
- A string value longer than the capacity of its target is cut. Only the length and the characters are written.
- A trap ends the scan at once; what was written before it stays.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from scanbench.check.types import Elementary, Record, StringType, Type
from scanbench.problems import Span

if TYPE_CHECKING:
    from scanbench.check.layout import Layout


class TrapKind(StrEnum):
    BOUNDS = "bounds"
    DIVISION = "division"
    NULL = "null"
    STRING = "string"
    LOOP = "loop"


@dataclass(frozen=True, slots=True)
class TrapSite:
    """A place that can trap; engines name it by its index in `Program.traps` plus one."""

    kind: TrapKind
    span: Span
    pou: str
    message: str


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
    """One computed array index: adds (value - low) * stride; outside low..high traps."""

    value: "Expr"
    low: int
    high: int
    stride: int
    trap: int


@dataclass(frozen=True, slots=True)
class Place:
    """Address = base + offset + the indices' strides. With `slot`, base is the reference stored there instead.

    `bit` is set for a BOOL inside an area. `variable` names the declared variable that holds this place ('' when it
    may be any, as behind an in-out): places of different variables never overlap, except that all places whose
    variable begins with '@' (areas of the model) may overlap each other.
    """

    type: Type
    base: Base
    offset: int
    indices: tuple[Index, ...] = ()
    bit: int | None = None
    slot: "Place | None" = None
    null_trap: int = 0
    variable: str = ""


# ---- expressions --------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Const:
    """int for BOOL (0, 1), integers, bit strings (unsigned) and TIME (ns); float for REAL; bytes for STRING."""

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

    `args` go with `Pou.parameters`: an Expr for an input, a Place for an in-out (its reference), a Place or None for
    an output (receives the value after the call).
    """

    pou: "Pou"
    type: Type | None
    args: tuple["Expr | Place | None", ...]


Expr = Const | Load | Unary | Binary | Compare | Convert | Intrinsic | CallFunction
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

    Then, in order of writing: each input is evaluated and stored (`inputs`: place relative to the instance, as
    Base.SELF of the callee), each in-out's reference is stored in its slot; the body runs; outputs are copied out.
    """

    instance: Place
    pou: "Pou"
    inputs: tuple[tuple[Place, Expr], ...]
    in_outs: tuple[tuple[Place, Place], ...]
    outputs: tuple[tuple[Expr, Place], ...]
    """(value, where Base.SELF is the *callee*; target, where Base.SELF is the caller)."""
    span: Span


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
    """`selector` is an integer or bit string; labels are inclusive ranges, none stands twice."""

    selector: Expr
    branches: tuple[tuple[tuple[tuple[int, int], ...], tuple["Stmt", ...]], ...]
    orelse: tuple["Stmt", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class For:
    """`start`, `end` and `step` have the type of `variable`, an integer."""

    variable: Place
    start: Expr
    end: Expr
    step: Expr
    body: tuple["Stmt", ...]
    exits: bool
    trap: int
    span: Span


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
class Return:
    span: Span


Stmt = Assign | SetBytes | CallBlock | Evaluate | If | Case | For | While | Repeat | Exit | Return


# ---- program organisation units -----------------------------------------------------------------------------------


@dataclass(eq=False, slots=True)
class Pou:
    """A PROGRAM, FUNCTION_BLOCK or FUNCTION, ready to run. `body` starts by setting its temporaries."""

    name: str
    kind: str
    """`program`, `function_block` or `function`."""
    instance: Record
    """Variables of an instance; empty for a function."""
    frame: Record
    """Temporaries; for a function: parameters, locals and the result (member with the function's name)."""
    parameters: tuple[str, ...]
    """Function: upper-case names of the inputs, in-outs and outputs, in order; keys of `frame.members`."""
    result: Type | None
    span: Span
    body: tuple[Stmt, ...] = ()
    frame_offset: int = 0
    inline: bool = False
    """Small and from the standard library: worth inlining at every call."""


@dataclass(frozen=True, slots=True)
class ProgramInstance:
    name: str
    pou: Pou
    offset: int


@dataclass(frozen=True, slots=True)
class Task:
    """Runs in every scan n for which n * base_interval is a multiple of `interval_ns`, in this order of priority."""

    name: str
    interval_ns: int
    priority: int
    every: int
    """Due in scans that are multiples of this."""
    programs: tuple[ProgramInstance, ...]


@dataclass(frozen=True, slots=True)
class Program:
    """A whole program on one model: immutable, the same for both engines. Image bytes are described by `layout`."""

    pous: tuple[Pou, ...]
    """Callees before callers."""
    tasks: tuple[Task, ...]
    interval_ns: int
    """Length of a scan in virtual time: the greatest common divisor of the tasks' intervals."""
    traps: tuple[TrapSite, ...]
    layout: "Layout"
    initial_image: bytes
