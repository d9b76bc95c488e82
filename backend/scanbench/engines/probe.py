"""The contract of probed code: the run flavour, as fast, but for tests at chosen statements.

For what seldom happens: breakpoints in lines, and the question when in a million scans a statement last ran. Nothing else
can be asked of it: where a probe halts, variables may be in registers, so the image is of no use. The owner goes back to
the beginning of that scan, and runs it in the debug flavour up to the statement.
"""

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from scanbench.engines.engine import Engine
from scanbench.program.program import Expr, Program
from scanbench.symbols.sites import StatementSite


@dataclass(frozen=True, slots=True)
class Probe:
    """Looks each time when a statement is to begin; not while common processing or the plant runs."""

    site: int
    """Index into `Sites.statements`."""
    condition: Expr | None = None
    """A BOOL in the scope of the statement's POU (`check.typed.local`), without calls of the program's POUs; a trap inside of it
    is FALSE. Of a line of a CONFIGURATION, one on the whole program. Only where it holds, the statement counts as
    reached."""
    halt: bool = True
    """Whether `run` ends with `Reason.HALTED` when the statement is reached, in that scan; else it is noted, no more. A
    scan that traps after that has halted."""


class BadProbe(ValueError):
    """A probe that no code can be made for."""

    def __init__(self, probe: Probe, site: StatementSite | None, why: str) -> None:
        where = f"statement {probe.site}" if site is None else str(site.span)
        super().__init__(f"no probe can be put at {where}: {why}")


class ProbedEngine(Engine):
    """An engine whose code has probes. The scan that a probe halted is not counted."""

    probes: tuple[Probe, ...]

    @property
    @abstractmethod
    def halted(self) -> int | None:
        """Index of a probe that ended the last run with `Reason.HALTED`; None after any other. Others may have been reached
        in that scan too, before or after it."""

    @property
    @abstractmethod
    def reached(self) -> tuple[int | None, ...]:
        """Of each probe the number of the scan that last reached it since it was made, or since `forget`."""

    @abstractmethod
    def forget(self) -> None:
        """No probe was reached."""


MakeProbed = Callable[[Program, bytearray, Sequence[Probe]], ProbedEngine]
"""Makes an engine with probes on a program's image. Raises `BadProbe`."""
