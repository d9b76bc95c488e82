"""The text of one LLVM function: names, blocks, traps, temporaries. Knows nothing of the language."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

UNLIKELY = ", !prof !0"

ALIGNMENT = 16
"""Of buffers, in bytes."""


@dataclass(slots=True)
class Value:
    """A scalar in a register, with what is known of it."""

    ssa: str
    low: int = 0
    high: int = 0
    """Integer-like types: the number is certainly in low..high."""
    wide: str = ""
    """The same number as an i64, when it is at hand."""
    clean: bool = False
    """REAL, LREAL: to be stored as it is: certainly no NaN, or the canonical one, or a copy of what is in memory."""

    @property
    def range(self) -> tuple[int, int]:
        return self.low, self.high


@dataclass(frozen=True, slots=True)
class Mark:
    """A position in a function that is being written."""

    lines: int
    entry: int
    block: str
    fails: int
    failures: dict[tuple[str, str, str], str]


class FunctionText:
    """Builds the text of a function that returns a status: 0, or the number of a trap."""

    def __init__(self, header: str, scratch: str = "", first_trap: str = "") -> None:
        self.header = header
        self.first_trap = first_trap
        """Name of the number that the numbers of traps count from; none where they count from 0."""
        self.scratch = scratch
        """Name of the memory that buffers are parts of."""
        self.scratch_size = 0
        """What all buffers of one statement need, at most."""
        self._scratch_used = 0
        self._scratch_kept = 0
        self.entry: list[str] = []
        self.lines: list[str] = []
        self.block = "start"
        self._count = 0
        self._failures: dict[tuple[str, str, str], str] = {}
        self._fails = 0
        """How often a way out was asked for."""
        self._trapping_to = ""
        self._catching = "", ""
        self._rooms: dict[str, str] = {}
        self._addresses: dict[tuple[str, int], str] = {}
        """Those computed in this block."""

    # ---- instructions and blocks -----------------------------------------------------------------------

    def name(self, hint: str = "v") -> str:
        """A new name, without its sigil."""
        self._count += 1
        return f"{hint}{self._count}"

    def op(self, text: str) -> str:
        """Appends an instruction; gives the name of its result."""
        self._count += 1
        result = f"%v{self._count}"
        self.lines.append(f"  {result} = {text}")
        return result

    def do(self, text: str) -> None:
        """Appends an instruction without a result."""
        self.lines.append(f"  {text}")

    def begin(self, label: str) -> None:
        """Starts a block."""
        self.lines.append(f"{label}:")
        self.block = label
        self._addresses.clear()

    def go(self, label: str) -> None:
        """Ends the block."""
        self.lines.append(f"  br label %{label}")

    def choose(self, condition: str, yes: str, no: str, weights: str = "") -> None:
        """Ends the block with a conditional branch."""
        self.lines.append(f"  br i1 {condition}, label %{yes}, label %{no}{weights}")

    # ---- taking back -----------------------------------------------------------------------------------

    def mark(self) -> Mark:
        """What `undo` goes back to, within one statement and one block."""
        return Mark(len(self.lines), len(self.entry), self.block, self._fails, dict(self._failures))

    def failed_since(self, mark: Mark) -> bool:
        """Whether anything since then can trap, or leave the function."""
        return self._trapping_to != "" or self._fails > mark.fails

    def undo(self, mark: Mark) -> None:
        """Drops the lines since then."""
        del self.lines[mark.lines :], self.entry[mark.entry :]
        self.block, self._failures = mark.block, dict(mark.failures)
        self._addresses.clear()

    # ---- traps ------------------------------------------------------------------------------------------

    def fail(self, status: str) -> str:
        """The block that leaves the function with this status: the number of a trap, a value, or less than 0."""
        self._fails += 1
        if self._trapping_to:
            return self._trapping_to
        where = ("", "") if status.startswith("-") else self._catching
        label = self._failures.get((status, *where))
        if label is None:
            label = self._failures[status, *where] = self.name("fail")
        return label

    @contextmanager
    def catching(self, label: str, status: str) -> Iterator[None]:
        """Traps, also of callees, go on at a block meanwhile, with their status in a variable of the stack. So does a status of
        a callee that is no trap."""
        outer, self._catching = self._catching, (label, status)
        yield
        self._catching = outer

    @contextmanager
    def trapping_to(self, label: str) -> Iterator[None]:
        """What would leave the function meanwhile goes on at a block instead."""
        self._trapping_to = label
        yield
        self._trapping_to = ""

    def trap_if(self, condition: str, trap: int) -> None:
        """Leaves with the trap where the condition holds."""
        on = self.name("on")
        self.choose(condition, self.fail(str(trap)), on, UNLIKELY)
        self.begin(on)

    def check_status(self, status: str) -> None:
        """Passes on the trap of a callee."""
        self.trap_status(self.op(f"icmp ne i32 {status}, 0"), status)

    def trap_status(self, condition: str, status: str) -> None:
        """Leaves with a computed status where the condition holds."""
        on = self.name("on")
        self.choose(condition, self.fail(status), on, UNLIKELY)
        self.begin(on)

    # ---- memory -------------------------------------------------------------------------------------------

    def address(self, pointer: str, offset: int) -> str:
        """The address so many bytes on, in the same object."""
        known = self._addresses.get((pointer, offset))
        if known is None:
            known = self.op(f"getelementptr inbounds nuw i8, ptr {pointer}, i64 {offset}")
            self._addresses[pointer, offset] = known
        return known

    def alloca(self, type: str, align: int = 8) -> str:
        """A variable on the stack, for the whole call."""
        name = f"%{self.name('a')}"
        self.entry.append(f"  {name} = alloca {type}, align {align}")
        return name

    def room(self, name: str, size: int) -> str:
        """Bytes on the stack that are the same wherever this name is asked for."""
        known = self._rooms.get(name)
        if known is None:
            known = self._rooms[name] = self.alloca(f"[{size} x i8]")
        return known

    def buffer(self, size: int) -> str:
        """Bytes until the statement ends.

        Not on the stack, which strings and arrays may be too large for; where no call of the POU is open, one place for each will do.
        """
        start = self._scratch_used
        self._scratch_used += -(-size // ALIGNMENT) * ALIGNMENT
        self.scratch_size = max(self.scratch_size, self._scratch_used)
        if self.scratch.startswith("%"):  # on the stack: in which block it is needed is not known
            return self.op(f"getelementptr inbounds i8, ptr {self.scratch}, i64 {start}")
        return f"getelementptr inbounds (i8, ptr {self.scratch}, i64 {start})" if start else self.scratch

    def end_statement(self) -> None:
        """Gives the buffers back: no value lives from one statement to the next, but in what `inside_expression` keeps."""
        self._scratch_used = self._scratch_kept

    @contextmanager
    def inside_expression(self) -> Iterator[None]:
        """Statements within an expression: the buffers of what is evaluated already are kept."""
        outer, self._scratch_kept = self._scratch_kept, self._scratch_used
        yield
        self._scratch_kept = outer

    # ---- the whole ----------------------------------------------------------------------------------------

    def text(self) -> str:
        """The function, ready to be parsed."""
        failures = [line for where, label in self._failures.items() for line in (f"{label}:", *self._leaving(*where))]
        parts = [f"{self.header} {{", "entry:", *self.entry, "  br label %start", "start:", *self.lines, *failures, "}"]
        return "\n".join(parts)

    def _leaving(self, status: str, to: str, variable: str) -> list[str]:
        lines = []
        if self.first_trap and not status.startswith(("%", "-")):
            first, trap = self.name(), self.name()
            lines = [
                f"  %{first} = load i32, ptr {self.first_trap}, align 4",
                f"  %{trap} = add i32 %{first}, {status}",
            ]
            status = f"%{trap}"
        if to:
            return [*lines, f"  store i32 {status}, ptr {variable}, align 4", f"  br label %{to}"]
        return [*lines, f"  ret i32 {status}"]
