"""Sources -> program and engine, inside the host."""

import threading
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from scanbench.check.incremental import Checks
from scanbench.engines.available import flavours, no_machine_code
from scanbench.engines.cache import BlobCache
from scanbench.engines.engine import Engine
from scanbench.host.program_cache import key_of, recall
from scanbench.plcmodel.load import NoSuchModel, load_all, model_directory, model_named
from scanbench.plcmodel.model import Model
from scanbench.problems import Problem, Severity
from scanbench.program.program import Program
from scanbench.wire.host import Sources

if TYPE_CHECKING:
    from scanbench.host.tiers import Tiers


class BuildFailed(Exception):
    """The sources make no program; the message says the first reason."""


@dataclass(frozen=True, slots=True)
class Engines:
    """The tiers of native code, or why there are none."""

    tiers: "Tiers | None"
    message: str


def find_engines(cache: BlobCache | None) -> Engines:
    """Native where LLVM is there, else the reference engine."""
    if why := no_machine_code():
        return Engines(None, f"LLVM is missing ({why}): the slow reference engine runs the program")
    from scanbench.host.tiers import Tiers

    return Engines(Tiers(cache), "")


@cache
def all_models() -> tuple[list[Model], list[Problem]]:
    """The models, as they were when this process began, and what is wrong with others."""
    return load_all(model_directory())


def find_model(name: str) -> Model:
    """The model of this name; `BuildFailed` names those that there are."""
    models, problems = all_models()
    try:
        return model_named(name, models)
    except NoSuchModel as error:
        broken = f"; {problems[0]}" if problems else ""
        raise BuildFailed(f"{error}{broken}") from None


class Builder:
    """Builds the programs of one host, one after the other. Thread-safe."""

    def __init__(self, cache: Path | None) -> None:
        self._cache = BlobCache(cache) if cache is not None else None
        self._engines = find_engines(self._cache)
        self._checks = Checks()
        self.flavours = flavours(self._cache)
        """Who notes what statements do, and who halts in the middle of a scan."""
        self._lock = threading.Lock()
        self._ready = False  # what was checked before makes the next check a short one

    @property
    def message(self) -> str:
        """Why the engine is not the fast one, if it is not."""
        return self._engines.message

    @property
    def tiers(self) -> "Tiers | None":
        """The tiers of native code."""
        return self._engines.tiers

    def build(self, sources: Sources) -> "Built":
        """The checked program: from the disk if it is known there."""
        with self._lock:
            if self._engines.tiers is not None:
                self._engines.tiers.supersede()
            model = find_model(sources.model)
            key = key_of(sources, model)
            program = None if self._ready else self._recalled(key)
            if program is None:
                program = self._checked(sources, model)
        return Built(program, key, self._engines.tiers)

    def preview(self, sources: Sources) -> Program:
        """The program that a build would make. What runs, and what is being optimised, stays as it is."""
        with self._lock:
            model = find_model(sources.model)
            program = self._recalled(key_of(sources, model))
            if program is not None:
                return program
            if self._engines.tiers is not None and not self._engines.tiers.optimising:
                return self._checked(sources, model)
            return _program(Checks(), sources, model)

    def checked_alone(self, sources: Sources) -> Program:
        """A separate check of the sources: no later check changes the statements of this program."""
        return _program(Checks(), sources, find_model(sources.model))

    def prepare(self, sources: Sources) -> None:
        """Gets ready for an edit of what was recalled: checks it after all, when nobody waits for it."""
        with self._lock:
            if self._ready or self._engines.tiers is None:
                return
            with suppress(BuildFailed):
                self._engines.tiers.prepare(self._checked(sources, find_model(sources.model)))

    def _recalled(self, key: str) -> Program | None:
        return recall(self._cache, key) if self._cache is not None else None

    def _checked(self, sources: Sources, model: Model) -> Program:
        """The next check begins with what this one found; so it changes bodies that the last program has, too."""
        if self._engines.tiers is None:  # the reference engine runs just these bodies
            return _program(Checks(), sources, model)
        program = _program(self._checks, sources, model)
        self._ready = True
        return program


def _program(checks: Checks, sources: Sources, model: Model) -> Program:
    checked = checks.check(sources.files, model, sources.interval_ns)
    if checked.program is None:
        errors = [problem for problem in checked.problems if problem.severity is Severity.ERROR]
        raise BuildFailed(f"{len(errors)} errors, the first: {errors[0]}" if errors else "nothing to run")
    return checked.program


@dataclass(frozen=True, slots=True)
class Built:
    """A checked program, and how an engine for it is made."""

    program: Program
    key: str
    tiers: "Tiers | None"

    def engine(self, program: Program, memory: bytearray) -> Engine:
        """The engine, machine code and all."""
        if self.tiers is not None:
            return self.tiers.engine(program, memory, self.key)
        from scanbench.engines.interpreter.engine import ReferenceEngine

        return ReferenceEngine(program, memory)
