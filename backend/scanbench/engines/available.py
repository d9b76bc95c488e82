"""The code that this machine can make: machine code where LLVM is there, else the reference interpreter.

The one place that finds out; everybody else asks for a flavour.
"""

from functools import cache
from typing import Protocol

from scanbench.engines.cache import BlobCache
from scanbench.engines.debug import DebugEngine
from scanbench.engines.engine import Engine
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.engines.observe import Observed
from scanbench.engines.probe import MakeProbed
from scanbench.program.program import Program


class Flavours(Protocol):
    """Makes engines that work on `memory`, an image of `program`, in each flavour."""

    def run(self, program: Program, memory: bytearray) -> Engine:
        """The flavour that only runs. One thread at a time."""

    def debug(self, program: Program, memory: bytearray) -> DebugEngine:
        """The flavour that halts at statements and tells of accesses; it takes seconds for a large program. Any thread."""

    def observed(self, program: Program, memory: bytearray) -> Observed:
        """The flavour that notes what statements read and write: at once where the program was prepared. Any thread."""

    def prepare_observed(self, program: Program) -> None:
        """Compiles what `observed` would have to wait for; it takes seconds for a large program. Any thread."""

    def probed(self, *, aside: bool) -> MakeProbed | None:
        """Makes the flavour that looks for breakpoints by itself; None where only machine code can.

        `aside`: compiles in a process of its own. What is made is for one thread at a time.
        """


@cache
def no_machine_code() -> str:
    """Why there is none here; empty where there is."""
    try:
        import scanbench.engines.native.jit  # noqa: F401
    except ImportError as error:
        return str(error)
    return ""


def flavours(blobs: BlobCache | None = None) -> Flavours:
    """The best that there is; compiled code is kept in the cache."""
    if no_machine_code():
        return Reference()
    from scanbench.engines.native.flavours import Native

    return Native(blobs)


class Reference:
    """See `Flavours`: the interpreter's."""

    def run(self, program: Program, memory: bytearray) -> Engine:
        """See `Flavours`."""
        return ReferenceEngine(program, memory)

    def debug(self, program: Program, memory: bytearray) -> DebugEngine:
        """See `Flavours`."""
        return debug_engine(program, memory)

    def observed(self, program: Program, memory: bytearray) -> Observed:
        """See `Flavours`."""
        return observed_engine(program, memory)

    def prepare_observed(self, program: Program) -> None:
        """Nothing has to be compiled."""

    def probed(self, *, aside: bool) -> MakeProbed | None:
        """There is none."""
        return None
