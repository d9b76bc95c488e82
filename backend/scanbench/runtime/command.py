"""The contract of the one door: command -> plan -> journal entry.

A command is frozen data with an author. Its `plan` is pure: it reads a `View` and answers what would change, whole, or
why nothing will. The seam applies the plan and keeps both: the command for people, the plan for replay.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from datetime import datetime
from typing import ClassVar, Literal, TypeVar

from scanbench.plcmodel.model import Model
from scanbench.program.program import Program
from scanbench.runtime.header import Header
from scanbench.runtime.journal import Fold, Journal
from scanbench.runtime.programs import LoadedPrograms, Programs

T = TypeVar("T")


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


RestartKind = Literal["cold", "warm", "power"]
"""cold: everything initial. warm: what is retained is kept, forces too. power: as the device does when it is switched
off and on: what is retained is kept, forces are gone."""


@dataclass(frozen=True, slots=True)
class Restarted:
    """The program begins again, with memory as this kind of restart leaves it. Scans and virtual time go on."""

    kind: RestartKind


@dataclass(frozen=True, slots=True)
class Swapped:
    """Program `version` takes over, with the variables that it has in common with the old one."""

    version: int
    fresh: bool
    """The new program starts as after a warm restart: it keeps what it has in common and retains, and no errors."""
    released: tuple[str, ...] = ()
    """Forces that the new program has no place for, as they were entered."""


@dataclass(frozen=True, slots=True)
class Numbered:
    """What was entered has a number from now on, by which others name it. Nothing else changes."""

    number: int


@dataclass(frozen=True, slots=True)
class Held:
    """Bits of the image stay as they are, whatever inputs or the program say, until they are `Freed`: a disturbed input.
    They are in the force table, but are nobody's force (`runtime.holds`)."""

    number: int
    """By which they are freed."""
    spots: tuple[tuple[int, int, int], ...]
    """Offset, mask, value."""


@dataclass(frozen=True, slots=True)
class Freed:
    """What was held by these numbers is not any more."""

    numbers: tuple[int, ...]


Effect = Restarted | Swapped | Numbered | Held | Freed
"""What a plan does that no patch can say."""


@dataclass(frozen=True, slots=True)
class Plan:
    """What a command changes, and a sentence that says so. The effect comes first, then the patches."""

    patches: tuple[Patch, ...]
    message: str
    effect: Effect | None = None

    @property
    def cuts(self) -> bool:
        """Whether what ran before cannot be compared with what runs after it: a restart or a program change."""
        return isinstance(self.effect, Restarted | Swapped)

    @property
    def starts_fresh(self) -> bool:
        """Whether the program begins as if nothing had happened: no error is present after it, no trap stops it."""
        return isinstance(self.effect, Restarted) or (isinstance(self.effect, Swapped) and self.effect.fresh)


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a command changes nothing, what to do next, and near matches of an unknown name."""

    message: str
    near: tuple[str, ...] = ()


Category = Literal["write", "force", "error", "recover", "mode", "build", "run", "disturbance", "system"]
"""What a command is to people: of a line of the log, of a mark of the timeline."""


@dataclass(frozen=True, slots=True)
class Command(ABC):
    """Something from outside that wants to change a PLC."""

    category: ClassVar[Category] = "system"
    author: str

    def settled(self, view: "View") -> "Command":
        """What the journal keeps: itself, unless what it asks for depends on the moment."""
        return self

    @abstractmethod
    def plan(self, view: "View") -> Plan | Refusal:
        """What it would change. Pure: the same command and view always give the same plan."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One line of the journal: applied in the seam before `scan`, or inside of it, where a debugger had halted it."""

    scan: int
    at: datetime
    command: Command
    plan: Plan
    step: int = 0
    """Applied before the statement of this count of the scan (`engines.debug`); 0 is the seam; one more than there are:
    after the last one. Such a plan has patches only, and may reach temporaries after `Layout.state_size`."""


@dataclass(frozen=True, slots=True)
class View:
    """What a planner may read: the program, the image between two scans, what happened before, and the programs there are."""

    program: Program
    memory: bytearray | bytes | memoryview
    journal: Journal = field(default_factory=Journal)
    programs: Programs = field(default_factory=LoadedPrograms)
    version: int = 1
    fresh: Program | None = None
    """See `Loaded`."""

    @property
    def statements(self) -> Program:
        """The program whose statements are those that run."""
        return self.fresh or self.program

    @property
    def model(self) -> Model:
        """The model of this PLC."""
        return self.program.layout.model

    @property
    def header(self) -> Header:
        """The header of the image."""
        return Header(self.memory)

    def derived(self, fold: Fold[T]) -> T:
        """What the journal adds up to."""
        return self.journal.derived(fold)
