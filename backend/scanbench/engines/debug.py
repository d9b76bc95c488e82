"""The contract of the debug flavour: code that can halt before any statement, and tells of reads and writes.

A *position* inside of a scan is a count: the number of statements with a site (`symbols.sites`) that have begun in the scan,
including the next one; 0 is the seam before the scan. Image and journal determine a run, so running the scan again from its
beginning reaches the same position: of a halted scan only its beginning has to be kept, and a step back is a run to a smaller
count. The image of a halted scan is complete: it has all variables, with temporaries and parameters in their frames (no
register holds any). `Layout.SCAN` is still that of the scan.

Other code pays nothing: this is a separate flavour, which the owner of the engine puts in place between two scans. It is
observed code too (`observer`). It passes over statements without a site, and those of the library, the system program and the
plant, and reports nothing of them, except that it reports the accesses of a library function as those of the statement that
called it.
"""

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from scanbench.engines.engine import Engine
from scanbench.engines.observe import Observer
from scanbench.program.program import Pou
from scanbench.program.types import Section
from scanbench.symbols.sites import Sites

READ, WRITE = 1, 2
"""Bits of `Listen.bytes`."""


@dataclass(frozen=True, slots=True)
class Frame:
    """A POU of the user's that runs."""

    pou: Pou
    instance: int
    """Byte offset of the instance in the image; 0 in a FUNCTION (a method's instance is what its THIS refers to)."""
    site: int
    """The statement that is next (innermost frame) or that calls the next frame."""


def frame_of(pou: Pou, instance: int, site: int, memory: bytearray) -> Frame:
    """The frame of a POU that runs now; the instance of a method is read from its THIS."""
    this = pou.frame.members.get("THIS") if pou.kind == "function" else None
    if this is None or this.section is not Section.IN_OUT:
        return Frame(pou, instance, site)
    at = pou.frame_offset + this.offset
    return Frame(pou, int.from_bytes(memory[at : at + 4], "little"), site)


@dataclass(frozen=True, slots=True)
class Listen:
    """What the hook is called for."""

    sites: frozenset[int] = frozenset()
    """When one of these statements is to begin."""
    every: bool = False
    """When any statement is to begin."""
    count: int = 0
    """When the statement of this count is to begin; 0: none."""
    bytes: Mapping[int, int] = field(default_factory=dict)
    """Byte offset (anywhere in the image) -> READ | WRITE: which accesses of the user's program are told."""
    accesses: int = 0
    """READ | WRITE: which accesses are told, whatever their bytes are."""


NOTHING = Listen()


class Hook(Protocol):
    """Decides where to halt. Called in the thread that runs, in the middle of a scan: it may read and write the image, and
    call `DebugEngine.listen`, `frames`, `interrupt`, nothing else. What it raises ends the scan and comes out of `run`."""

    def statement(self, site: int, count: int, depth: int) -> bool:
        """The statement is to begin, `depth` frames deep (1: a program's body). True halts before it."""

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """The statement has read, or written, these bytes, of which at least one is listened for. Told after a write,
        and after or before a read. To halt after the statement's access: listen to `every` statement, and `interrupt`."""


class DebugEngine(Engine):
    """`run` ends with `Reason.HALTED` when the hook halts. The image is then that inside of the scan. To continue, the owner
    restores `begin` and runs again, with a hook that lets the scan pass up to the position that it wants."""

    sites: Sites
    observer: Observer

    @abstractmethod
    def hook(self, hook: Hook | None) -> None:
        """Who is called from now on."""

    @abstractmethod
    def listen(self, listen: Listen) -> None:
        """What the hook is called for from now on, at once when it is called from the hook."""

    @property
    @abstractmethod
    def bits(self) -> int:
        """While the hook's `access` is called: the bits of its one byte that it is about; 0xFF where it is about whole bytes."""

    @property
    @abstractmethod
    def begin(self) -> bytes:
        """The whole image as the scan began that is halted, or that ran last."""

    @property
    @abstractmethod
    def count(self) -> int:
        """Statements that have begun in the scan that is halted (including the next one) or ran last."""

    @abstractmethod
    def frames(self) -> tuple[Frame, ...]:
        """Innermost first, where it halted, or where the hook is called now."""
