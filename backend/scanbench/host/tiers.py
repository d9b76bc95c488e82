"""Two tiers of code: quick code runs at once, optimised code takes over in the seam when it is there.

The program, the image and the journal know nothing of it: both compute the same.
"""

import logging
import threading
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass

from scanbench.engines.cache import BlobCache
from scanbench.engines.engine import Engine
from scanbench.engines.native import jit
from scanbench.engines.native.compiler import FAST, Build, Compiler
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.worker import WorkerDied, optimised
from scanbench.host.program_cache import keep_code, recall_code
from scanbench.host.swaps import Recode
from scanbench.program.program import Program

log = logging.getLogger("scanbench")


@dataclass(slots=True)
class _Waiting:
    number: int
    key: str
    program: Program
    memory: bytearray
    build: Build


class Tiers:
    """Makes the native engines of one host, one program after the other."""

    def __init__(self, cache: BlobCache | None) -> None:
        self._cache = cache
        self._compiler = Compiler(cache)
        self._lock = threading.Lock()
        self._newest = 0
        self._waiting: _Waiting | None = None

    def supersede(self) -> None:
        """Gives up what is being optimised: the next program may share POUs with it, which change now."""
        with self._lock:
            self._newest += 1
            self._waiting = None

    def engine(self, program: Program, memory: bytearray, key: str) -> Engine:
        """An engine that can run soon; `key` identifies the program."""
        self.supersede()
        with self._lock:
            objects = self._recalled(key)
            if objects is None:
                build = self._compiler.build_soon(program)
                objects = build.objects
                if not build.finished:
                    self._waiting = _Waiting(self._newest, key, program, memory, build)
                else:
                    self._keep(key, build)
        return NativeEngine(program, memory, objects=objects)

    def prepare(self, program: Program) -> None:
        """Gets ready for programs that share POUs with this one, which runs code that was kept."""
        with self._lock:
            self._compiler.prepare(program)

    @property
    def optimising(self) -> bool:
        """Whether optimised code is still to come."""
        return self._waiting is not None

    def optimise(self, deliver: Callable[[Recode], None]) -> None:
        """Begins to optimise what runs quick code; `deliver` is called with the result, from a different thread."""
        waiting = self._waiting
        if waiting is not None:
            threading.Thread(target=self._optimise, args=(waiting, deliver), name="optimise", daemon=True).start()

    def _optimise(self, waiting: _Waiting, deliver: Callable[[Recode], None]) -> None:
        engine: Engine | None = None
        try:
            # of many PLCs with one program, one has it optimised; the others wait, and take what it made
            with self._cache.claimed(f"{waiting.key}.o2") if self._cache is not None else nullcontext():
                self._finish(waiting)
            if not waiting.build.finished:
                return  # superseded
            engine = NativeEngine(waiting.program, waiting.memory, objects=waiting.build.objects)
        except (WorkerDied, OSError) as error:
            log.warning("the program could not be optimised, and runs on as it is: %r", error)
        with self._lock:
            if self._newest != waiting.number:
                return
            self._waiting = None
        deliver(Recode(waiting.program, engine))

    def _finish(self, waiting: _Waiting) -> None:
        """Optimises all parts, and keeps them; some are left when the program is superseded."""
        build = waiting.build
        with self._lock:
            if self._newest != waiting.number:
                return
            if build.whole is not None:
                self._compiler.divide(build, waiting.program)
            else:
                self._compiler.take_known(build)
        if build.pending:
            for part, code in optimised(build.pending, lambda: self._newest == waiting.number):
                with self._lock:
                    self._compiler.learn(build, part, code)
        if build.finished:
            self._keep(waiting.key, build)

    def _recalled(self, key: str) -> list[bytes] | None:
        keys = recall_code(self._cache, key, jit.host()) if self._cache is not None else None
        return None if keys is None else self._compiler.recalled(keys)

    def _keep(self, key: str, build: Build) -> None:
        if self._cache is not None:
            keep_code(self._cache, key, jit.host(), [part.key(FAST) for part in build.parts])
