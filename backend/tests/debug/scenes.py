"""Halted programs to look at."""

from collections.abc import Mapping

from scanbench.check.build import check_sources
from scanbench.debug.scene import Scene
from scanbench.engines.debug import DebugEngine, Listen
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.program.program import Program
from tests.caseformat import MODELS


class HaltAtLine:
    """Halts before the n-th statement that begins in a line."""

    def __init__(self, engine: DebugEngine, file: str, line: int, times: int = 1) -> None:
        self.sites = frozenset(engine.sites.at_line(file, line))
        assert self.sites, f"line {line} of {file} has no statement"
        self.left = times

    def statement(self, site: int, count: int, depth: int) -> bool:
        self.left -= site in self.sites
        return self.left == 0

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        raise AssertionError("nobody listens")


def checked(sources: str | Mapping[str, str], model: str = "GENERIC-IEC") -> Program:
    """A program without a problem."""
    given = {"a.st": sources} if isinstance(sources, str) else sources
    found = check_sources(given, MODELS[model], 10_000_000)
    assert found.program is not None, [str(each) for each in found.problems]
    return found.program


def halted(program: Program, line: int, times: int = 1, file: str = "a.st", scans: int = 0) -> Scene:
    """The scene of a halt before a line, after `scans` whole scans."""
    memory = bytearray(program.initial_image)
    engine = debug_engine(program, memory)
    if scans:
        assert engine.run(scans).reason == "done"
    hook = HaltAtLine(engine, file, line, times)
    engine.hook(hook)
    engine.listen(Listen(sites=hook.sites))
    assert engine.run(1).reason == "halted"
    return Scene(program, memory, engine.sites, engine.frames())
