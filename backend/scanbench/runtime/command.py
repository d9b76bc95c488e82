"""The contract of the one door: command -> plan -> journal entry.

A command is frozen data with an author. Its `plan` is pure: it reads a `View` and answers what would change, whole, or
why nothing will. The seam applies the plan and keeps both: the command for people, the plan for replay.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime

from scanbench.check.program import Program
from scanbench.plcmodel.model import Model
from scanbench.runtime.header import Header


@dataclass(frozen=True, slots=True)
class Patch:
    """`byte = byte & ~mask | data & mask` for each byte from `offset` on."""

    offset: int
    mask: bytes
    data: bytes

    @staticmethod
    def whole(offset: int, data: bytes) -> "Patch":
        """Replaces all the bits of these bytes."""
        return Patch(offset, b"\xff" * len(data), data)

    @staticmethod
    def of_bit(offset: int, bit: int, on: bool) -> "Patch":
        """Sets one bit."""
        return Patch(offset, bytes((1 << bit,)), bytes((on << bit,)))


@dataclass(frozen=True, slots=True)
class Plan:
    """What a command changes, and a sentence that says so."""

    patches: tuple[Patch, ...]
    message: str


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a command changes nothing, what to do next, and near matches of an unknown name."""

    message: str
    near: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Command(ABC):
    """Something from outside that wants to change a PLC."""

    author: str

    @abstractmethod
    def plan(self, view: "View") -> Plan | Refusal:
        """What it would change. Pure: the same command and view always give the same plan."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One line of the journal: applied in the seam before `scan`."""

    scan: int
    at: datetime
    command: Command
    plan: Plan


@dataclass(frozen=True, slots=True)
class View:
    """What a planner may read: the program, the image between two scans, and what happened before."""

    program: Program
    memory: bytearray | bytes | memoryview
    entries: Sequence[Entry] = ()

    @property
    def model(self) -> Model:
        """The model of this PLC."""
        return self.program.layout.model

    @property
    def header(self) -> Header:
        """The header of the image."""
        return Header(self.memory)
