"""Programs ready to run on either side: a run flavour, and a debug flavour that tells of every access, on one memory."""

from collections.abc import Callable

from scanbench.engines.available import flavours
from scanbench.engines.cache import BlobCache
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.program.program import Program
from scanbench.runtime.programs import Loaded

Make = Callable[[int, Program], Loaded]
"""Makes a version of a program ready to run, with both flavours."""


def reference(version: int, program: Program) -> Loaded:
    """On the reference interpreter: one flavour is both."""
    memory = bytearray(program.layout.size)
    engine = debug_engine(program, memory)
    return Loaded(version, program, memory, engine, debug=engine)


def native(cache: BlobCache | None = None) -> Make:
    """On machine code where LLVM is there, else on the reference interpreter."""
    code = flavours(cache)

    def make(version: int, program: Program) -> Loaded:
        memory = bytearray(program.layout.size)
        return Loaded(version, program, memory, code.run(program, memory), debug=code.debug(program, memory))

    return make
