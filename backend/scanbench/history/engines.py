"""Programs of a run file as questions about its past need them: fast at once, with other flavours when they are needed."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from scanbench.engines.available import flavours
from scanbench.engines.cache import BlobCache
from scanbench.engines.probe import MakeProbed
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.timeline import ProgramsOf
from scanbench.runtime.programs import Loaded, NoProgram
from scanbench.verify.engines import Make

ProgramOf = Callable[[KeptProgram], Program]
"""Builds a program; `NoProgram` says why it cannot be built."""


def past_engines(cache: BlobCache | None = None) -> tuple[Make, MakeProbed | None]:
    """Makes programs ready to run, and code with probes: on machine code where LLVM is there."""
    code = flavours(cache)

    def make(version: int, program: Program) -> Loaded:
        memory = bytearray(program.layout.size)
        return Loaded(version, program, memory, code.run(program, memory), make_debug=code.debug)

    return make, code.probed(aside=False)


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
