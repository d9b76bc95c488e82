"""The programs of one run, by version: built when they are needed, and again when a run goes back to one of them."""

import threading
from collections.abc import Callable, Mapping

from scanbench.engines.engine import Engine
from scanbench.host.build import Builder, BuildFailed
from scanbench.program.program import Program
from scanbench.recording.programs import ProgramCache
from scanbench.runtime.programs import Loaded, NoProgram
from scanbench.wire.host import Sources, SourcesOf, WantSources

_KEPT = 3
"""Programs that stay ready: the one that runs, and those that were run or looked at last."""


class _Once:
    """Makes a program when it is first asked for, in any thread."""

    def __init__(self, make: Callable[[], Program]) -> None:
        self._make = make
        self._made: Program | None = None
        self._lock = threading.Lock()

    def __call__(self) -> Program:
        with self._lock:
            if self._made is None:
                self._made = self._make()
            return self._made


class HostPrograms:
    """`runtime.Programs` of a host. The loop's thread alone asks; `make` is for any."""

    def __init__(self, builder: Builder, sources: Mapping[int, Sources]) -> None:
        self._builder = builder
        self._sources = dict(sources)
        self._cache = ProgramCache(self._load)

    def sources(self, version: int) -> Sources:
        """What a version is made of; `NoProgram` when there is none."""
        if version not in self._sources:
            raise NoProgram(f"there is no program version {version} in this run")
        return self._sources[version]

    def told(self, wanted: WantSources) -> SourcesOf:
        """What a version is made of, for the parent; in any thread."""
        try:
            return SourcesOf(wanted.ref, self.sources(wanted.version))
        except NoProgram as error:
            return SourcesOf(wanted.ref, None, str(error))

    def get(self, version: int) -> Loaded:
        """The program of a version, ready to run."""
        return self._cache.get(version)

    def _load(self, version: int) -> Loaded:
        try:
            return self.make(self.sources(version))
        except BuildFailed as error:
            raise NoProgram(f"program version {version} cannot be built any more: {error}") from error

    def make(self, sources: Sources) -> Loaded:
        """Builds; in any thread, one build at a time."""
        built = self._builder.build(sources)
        memory = bytearray(built.program.layout.size)
        loaded = Loaded(sources.version, built.program, memory, built.engine(built.program, memory))
        loaded.renew = _Once(lambda: self._builder.checked_alone(sources))
        return loaded

    def put(self, loaded: Loaded, sources: Sources) -> None:
        """Takes a program that was built in the background."""
        self._sources[loaded.version] = sources
        self._cache.put(loaded)

    def drop_idle(self, *in_use: int) -> None:
        """Lets go of what was not used for long; the versions given stay."""
        self._cache.keep(_KEPT, *in_use)

    def recode(self, program: Program, engine: Engine) -> None:
        """Optimised code for a program, if it is still here."""
        for loaded in self._cache.loaded:
            if loaded.program is program:
                loaded.engine = engine
