"""Sources -> program and engine, inside the host."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

from scanbench.check.build import check_sources
from scanbench.check.program import Program
from scanbench.engines.engine import Engine
from scanbench.plcmodel.load import load_all, model_directory
from scanbench.plcmodel.model import Model
from scanbench.problems import Severity
from scanbench.runtime.resource import EngineFactory
from scanbench.session.protocol import Sources


class BuildFailed(Exception):
    """The sources make no program; the message says the first reason."""


@dataclass(frozen=True, slots=True)
class Engines:
    """The engine that runs programs here, and why it is not the fast one, if it is not."""

    make: EngineFactory
    message: str


@cache
def find_engines() -> Engines:
    """Native where LLVM is there, else the reference engine."""
    try:
        from scanbench.engines.native.engine import NativeEngine
    except ImportError as error:
        from scanbench.engines.interpreter.engine import ReferenceEngine

        return Engines(ReferenceEngine, f"LLVM is missing ({error}): the slow reference engine runs the program")
    return Engines(NativeEngine, "")


@cache
def find_model(name: str) -> Model:
    """The model of this name; `BuildFailed` names those that there are."""
    models, problems = load_all(model_directory())
    for model in models:
        if model.name == name:
            return model
    broken = f"; {problems[0]}" if problems else ""
    raise BuildFailed(f"no model {name}: there are {', '.join(model.name for model in models)}{broken}")


def compile_sources(sources: Sources) -> Program:
    """The checked program."""
    checked = check_sources(sources.files, find_model(sources.model), sources.interval_ns)
    if checked.program is None:
        errors = [problem for problem in checked.problems if problem.severity is Severity.ERROR]
        raise BuildFailed(f"{len(errors)} errors, the first: {errors[0]}" if errors else "nothing to run")
    return checked.program


def make_engine(program: Program, memory: bytearray) -> Engine:
    """The engine for a program, machine code and all."""
    return find_engines().make(program, memory)


EngineMaker = Callable[[Program, bytearray], Engine]
