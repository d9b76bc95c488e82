"""Programs of a run file as questions about its past need them: fast at once, with other flavours when they are needed."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from scanbench.check.program import Program
from scanbench.debug.probing import Prober
from scanbench.engines.cache import BlobCache
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.runtime.contents import KeptProgram
from scanbench.runtime.programs import Loaded, NoProgram
from scanbench.runtime.timeline import ProgramsOf
from scanbench.verify.engines import Make

ProgramOf = Callable[[KeptProgram], Program]
"""Builds a program; `NoProgram` says why it cannot be built."""


def past_engines(cache: BlobCache | None = None) -> tuple[Make, Prober | None]:
    """Makes programs ready to run, and code with probes: on machine code where LLVM is there."""
    try:
        from scanbench.engines.native.compiler import Compiler
        from scanbench.engines.native.debugged import DebugBuilds
        from scanbench.engines.native.engine import NativeEngine
        from scanbench.engines.native.probed import ProbedBuilds
    except ImportError:
        return lambda version, program: Loaded.make(program, ReferenceEngine, version), None
    compiler, builds = Compiler(cache), DebugBuilds(cache)

    def make(version: int, program: Program) -> Loaded:
        memory = bytearray(program.layout.size)
        engine = NativeEngine(program, memory, objects=compiler.build(program).objects)
        return Loaded(version, program, memory, engine, make_debug=builds.engine)

    return make, ProbedBuilds(cache).engine


def programs_of(program_of: ProgramOf, make: Make) -> ProgramsOf:
    """For `Reading`: each call gives programs with a memory of their own, made when they are first needed."""
    return lambda kept: _Programs(kept, program_of, make)


@dataclass
class _Programs:
    """See `Programs`. The mapping grows with the run."""

    kept: Mapping[int, KeptProgram]
    program_of: ProgramOf
    make: Make
    known: dict[int, Loaded] = field(default_factory=dict)

    def get(self, version: int) -> Loaded:
        """See `Programs`."""
        if version not in self.known:
            if version not in self.kept:
                raise NoProgram(f"there is no program version {version} in the run")
            self.known[version] = self.make(version, self.program_of(self.kept[version]))
        return self.known[version]
