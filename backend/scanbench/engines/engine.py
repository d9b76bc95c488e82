"""The contract of the engines: run scans of a checked program on an image they are given.

One scan, in the order of the design:

1. common processing: `Layout.CLOCK` := `Layout.ORIGIN` + `Layout.SCAN` * interval, without its sign bit;
   `Layout.BUDGET` := `Layout.BUDGET_LIMIT`; `Layout.INTERVAL` := interval; `Layout.ASKED_COUNT` := 0; then `Program.common`,
   and `Program.life`
2. input refresh (`Program.plant`; inputs are also changed from outside, in the seam), then the force table is applied
3. the user program: every due task in order, every program instance of it in order
4. the force table is applied again; output refresh
and, when all went well, `Layout.SCAN` += 1.

The force table (`Layout.FORCES`): a u32 count at `Layout.FORCE_COUNT`, then entries of 8 bytes: u32 offset, u8 mask,
u8 value, u8 before, u8 after the program; applying is `byte = byte & ~mask | value & mask`, after the byte was stored in the
entry, in `before` in phase 2, in `after the program` in phase 4; an entry whose offset is beyond the image does nothing (an
image may come from a file).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from enum import StrEnum

from scanbench.check.typed.condition import Condition
from scanbench.engines.sample import Sampling
from scanbench.program.program import Program


class Reason(StrEnum):
    DONE = "done"
    """The scans asked for are run."""
    INTERRUPTED = "interrupted"
    """Somebody called `interrupt`: the engine is between two scans."""
    ASKED = "asked"
    """The program asked for something (`Layout.ASKED_COUNT` is not 0) in the scan that just ended."""
    CONDITION = "condition"
    """The condition holds after the scan that just ended. It takes precedence over ASKED: requests of the program stay in the
    image, but nobody can find out later that the condition held."""
    TRAP = "trap"
    """The program trapped; the scan is not counted, phase 4 did not run."""
    HALTED = "halted"
    """A debug engine halted inside of a scan, see `engines.debug`; the scan is not counted."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Why `run` came back. `trap` is an index into `Program.traps` plus one, or 0."""

    reason: Reason
    trap: int = 0


@dataclass(slots=True)
class Pace:
    """Real time for scans: scan k of this run starts at `deadline_ns` + k * `period_ns` of CLOCK_MONOTONIC.

    `run` moves `deadline_ns` on by the scans it ran, and counts what it measured. A deadline more than ten periods
    (and at least 100 ms) in the past is moved to now: lost time is not made up for at full speed.
    """

    period_ns: int
    deadline_ns: int
    late_ns: int = 0
    """Sum of the lateness of scan starts, each after its deadline as it was before it was moved."""
    worst_ns: int = 0
    """The most of them."""
    busy_ns: int = 0
    """Sum of the time spent inside scans."""
    scans: int = 0
    late_scans: int = 0
    """Scans that began after the next one was due; a moved deadline counts as one."""


class Engine(ABC):
    """Runs one program on one image. Not thread-safe, except for `interrupt`."""

    name: str

    @abstractmethod
    def __init__(self, program: Program, memory: bytearray) -> None:
        """`memory` has `program.layout.size` bytes, stays the same object, and is owned by the caller."""

    @abstractmethod
    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """Runs up to `scans` scans, as fast as possible (no pace, or period 0) or at a pace; returns after a scan in
        which the program asked for something, or after which the condition holds, and at once after an interrupt or a trap.
        An interrupt that is pending when the last scan is done is reported as INTERRUPTED.

        An interrupt that came before the call makes it return without running a scan. Returning for any reason clears the
        interrupt: whoever interrupts puts what he wants where the caller looks after every return. An interrupt ends a wait for a
        deadline at once.
        """

    @abstractmethod
    def stop_when(self, condition: Condition | None, *others: Condition) -> None:
        """From now on `run` comes back after every scan after which one of these conditions, made for this engine's
        program, holds; None takes them away. Not while `run` is running. A trap inside of one is FALSE, and hides no other.

        The conditions are the engine's: whoever swaps the engine gives them to the next one.
        """

    @abstractmethod
    def holds(self, condition: Condition) -> bool:
        """Whether the condition, made for this engine's program, holds now. Not while `run` is running."""

    def truth(self, condition: Condition) -> bool | None:
        """The same, but None where it has no value."""
        if not self.holds(replace(condition, unknown=True)):
            return False
        return True if self.holds(replace(condition, unknown=False)) else None

    @abstractmethod
    def sample(self, *samplings: Sampling) -> None:
        """From now on these samplings, made for this engine's program, get a row for each scan that ends (`engines.sample`);
        none of them: nothing is sampled. Not while `run` is running. A full ring makes `run` come back as for an interrupt.

        The samplings are the engine's: whoever swaps the engine gives them to the next one.
        """

    @abstractmethod
    def interrupt(self) -> None:
        """Asks `run`, from any thread, to come back after the current scan."""
