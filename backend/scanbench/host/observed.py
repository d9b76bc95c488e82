"""Observed code for the programs of one host: while somebody waits for a statement, and for no one else."""

from dataclasses import dataclass

from scanbench.program.program import Program
from scanbench.wire.host import Submit


@dataclass(frozen=True, slots=True)
class Observable:
    """The program of a version as it was checked again, with observed code; the command that waits for it follows."""

    version: int
    program: Program
    then: Submit
