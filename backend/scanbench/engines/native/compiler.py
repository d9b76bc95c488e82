"""Programs to object code, in tiers: what was optimised before is taken, the rest is compiled quickly and optimised later."""

from collections import OrderedDict
from collections.abc import Iterable
from dataclasses import dataclass, field
from time import perf_counter_ns

from scanbench.engines.cache import BlobCache
from scanbench.engines.native import inlining, jit
from scanbench.engines.native.emit_program import emit_program
from scanbench.engines.native.flavour import RUN, Flavour
from scanbench.engines.native.parts import Part, Parts
from scanbench.garbage import without_collection
from scanbench.program.program import Program

QUICK, FAST = 0, 2
"""The levels of optimisation: built fast, and running fast."""

AT_ONCE = 64_000
"""Characters of modules that are optimised while somebody waits: some 50 ms of work."""
WHOLE = 400
"""Statements from which on a program that is new is compiled as a whole first."""
REMEMBERED_BYTES = 32 << 20


@dataclass(slots=True)
class Build:
    """The object code of a program: of each part the optimised code, or the quick one until that is there."""

    parts: list[Part]
    timings: jit.Timings
    fast: dict[Part, bytes] = field(default_factory=dict)
    quick: dict[Part, bytes] = field(default_factory=dict)
    whole: bytes | None = None
    """All in one, quick; until the parts are known."""

    @property
    def objects(self) -> list[bytes]:
        """What is to be linked."""
        if self.whole is not None:
            return [self.whole]
        return [self.fast[part] if part in self.fast else self.quick[part] for part in self.parts]

    @property
    def pending(self) -> list[Part]:
        """The parts that are to be optimised yet."""
        return [part for part in self.parts if part not in self.fast]

    @property
    def finished(self) -> bool:
        """Whether all of it is optimised."""
        return self.whole is None and not self.pending


class Compiler:
    """Compiles program after program. Not thread-safe."""

    def __init__(self, cache: BlobCache | None = None) -> None:
        self._cache = cache
        self._parts = Parts()
        self._recent: OrderedDict[str, bytes] = OrderedDict()
        self._recent_bytes = 0

    def build(self, program: Program, opt_level: int = FAST) -> Build:
        """All of the program at this level."""
        build = self.emitted(program)
        codes = build.fast if opt_level == FAST else build.quick
        codes.update({part: self._compiled(part, opt_level, build.timings) for part in build.parts})
        return build

    def build_soon(self, program: Program) -> Build:
        """Code that runs soon: of each part the best that exists; parts that are not `finished` are optimised later, in the background.

        Of a large program that has no part in common with the last one, the whole is compiled at once: that takes half
        the time that its parts take. Then `divide` comes before the optimisation.
        """
        first = self._parts.fresh
        if first and sum(inlining.size(pou.body) for pou in program.pous) > WHOLE:
            return self._whole(program)
        build = self.emitted(program)
        self.take_known(build)
        # only the first program: each run of LLVM's passes leaks some memory, and there are many edits
        if first and sum(len(part.text) for part in build.pending) <= AT_ONCE:
            build.fast |= {part: self._compiled(part, FAST, build.timings) for part in build.pending}
        build.quick = {part: self._compiled(part, QUICK, build.timings) for part in build.pending}
        return build

    def divide(self, build: Build, program: Program) -> None:
        """Finds the parts of a program that runs as a whole, and those that were optimised before."""
        build.parts = self._parts.of(program)
        self.take_known(build)
        if not build.pending:
            build.whole = None

    def _whole(self, program: Program) -> Build:
        build = Build([], jit.Timings())
        start = perf_counter_ns()
        with without_collection():
            text = emit_program(program)
        build.timings.emit = (perf_counter_ns() - start) / 1e6
        build.whole = jit.compile_object(text, QUICK, build.timings)
        return build

    def take_known(self, build: Build) -> None:
        """Takes the optimised code of every part that is kept by now, whoever made it."""
        for part in build.parts:
            code = self._known(part.key(FAST))
            if code is not None:
                build.fast[part] = code
                build.quick.pop(part, None)

    def recalled(self, keys: Iterable[str]) -> list[bytes] | None:
        """Object code by its keys; None when some of it is gone."""
        codes = [self._known(key) for key in keys]
        found = [code for code in codes if code is not None]
        return found if len(found) == len(codes) else None

    def prepare(self, program: Program) -> None:
        """Gets ready for programs that share POUs with this one, which was recalled."""
        self._parts.of(program)

    def learn(self, build: Build, part: Part, code: bytes) -> None:
        """Takes the optimised code of a part that somebody else compiled."""
        build.fast[part] = code
        build.quick.pop(part, None)
        if not build.pending:
            build.whole = None
        self._keep(part.key(FAST), code)

    def emitted(self, program: Program, flavour: Flavour = RUN) -> Build:
        """The parts of a program, of which nothing is compiled yet."""
        start = perf_counter_ns()
        build = Build(self._parts.of(program, flavour), jit.Timings())
        build.timings.emit = (perf_counter_ns() - start) / 1e6
        return build

    def _compiled(self, part: Part, opt_level: int, timings: jit.Timings) -> bytes:
        key = part.key(opt_level)
        code = self._known(key)
        if code is None:
            code = jit.compile_object(part.text, opt_level, timings)
            if opt_level == FAST:
                self._keep(key, code)
            else:  # it is made as soon as it is read
                self._remember(key, code)
        return code

    def _known(self, key: str) -> bytes | None:
        code = self._recent.get(key)
        if code is not None:
            self._recent.move_to_end(key)
            return code
        code = self._cache.get(key) if self._cache is not None else None
        if code is not None:
            self._remember(key, code)
        return code

    def _keep(self, key: str, code: bytes) -> None:
        self._remember(key, code)
        if self._cache is not None:
            self._cache.put(key, code)

    def _remember(self, key: str, code: bytes) -> None:
        if key in self._recent:
            return
        self._recent[key] = code
        self._recent_bytes += len(code)
        while self._recent_bytes > REMEMBERED_BYTES:
            _, dropped = self._recent.popitem(last=False)
            self._recent_bytes -= len(dropped)
