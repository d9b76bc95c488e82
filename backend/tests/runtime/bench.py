"""Small PLCs for the tests of runtime, faults and taps."""

from functools import cache

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.plcmodel.load import model_named
from scanbench.plcmodel.model import Model
from scanbench.program.program import Program
from scanbench.runtime.command import Entry
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import EngineFactory, Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.symbols.symbols import resolve
from scanbench.symbols.values import python_value
from scanbench.syntax.language_file import LANGUAGE_FILE, language_text

CODESYS = "// codesys\n"
"""Begins a source in that dialect."""
ENGINES: tuple[EngineFactory, ...] = (ReferenceEngine, NativeEngine)


@cache
def model(name: str = "CJ1M-CPU63") -> Model:
    return model_named(name)


@cache
def program(source: str, model_name: str = "CJ1M-CPU63") -> Program:
    sources = {"main.st": source}
    if source.startswith(CODESYS):
        sources[LANGUAGE_FILE] = language_text("codesys")
    checked = check_sources(sources, model(model_name))
    assert checked.program is not None, checked.problems
    return checked.program


def plc(source: str, engine: EngineFactory = ReferenceEngine, model_name: str = "CJ1M-CPU63") -> Resource:
    return Resource(Loaded.make(program(source, model_name), engine))


def value(resource: Resource, path: str) -> bool | int | float | str | None:
    symbol = resolve(resource.program, path)
    place = symbol.locate(resource.memory)
    assert place is not None, f"{path} is not connected"
    offset, bit = place
    data = bytes(resource.memory[offset : offset + symbol.type.size])
    return bool(data[0] >> bit & 1) if bit is not None else python_value(symbol.type, data)


def change(resource: Resource, new: Program, engine: EngineFactory = ReferenceEngine, version: int = 2) -> str:
    """Swaps a new program in; what became of the variables."""
    resource.programs = LoadedPrograms(resource.loaded, Loaded.make(new, engine, version))
    entry = resource.submit(ProgramChange("Ada", version))
    assert isinstance(entry, Entry), entry
    return entry.plan.message
