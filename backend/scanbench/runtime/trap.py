"""A trap: the program did what no PLC can do. It stops, and says where."""

from dataclasses import dataclass

from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.program.sites import TrapKind, TrapSite
from scanbench.runtime.command import Command, Entry, Patch, Plan, Refusal, View
from scanbench.runtime.header import Halt
from scanbench.runtime.journal import Fold
from scanbench.runtime.modes import outputs_off


@dataclass(frozen=True, slots=True)
class TrapInfo:
    """Why and where the program stopped by itself; lines and columns count from 1."""

    kind: str
    message: str
    file: str
    line: int
    column: int
    scan: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.message} (scan {self.scan})"


@dataclass(frozen=True, slots=True)
class Trapped(Command):
    """Entered by the resource itself, after the part of `scan` that ran before the trap; replay runs into it again."""

    info: TrapInfo

    def plan(self, view: View) -> Plan | Refusal:
        """Keeps the program stopped, outputs off. What an instruction's own error does to memory is in that error's plan."""
        halt = bytes((view.header.halt | Halt.TRAP,))
        off = () if self.info.kind == TrapKind.FATAL else outputs_off(view)
        return Plan((Patch.whole(Layout.FATAL, halt), *off), str(self.info))


def trap_info(program: Program, trap: int, scan: int) -> TrapInfo:
    """The trap that an engine names by its number."""
    site: TrapSite = program.traps[trap - 1]
    span = site.span
    return TrapInfo(site.kind.value, site.message, span.file, span.line, span.column, scan)


def _step(info: TrapInfo | None, entry: Entry) -> TrapInfo | None:
    return entry.command.info if isinstance(entry.command, Trapped) else info


TRAPPED: Fold[TrapInfo | None] = Fold(None, _step)
"""The last trap, whether it is over or not."""
