"""Runs drawings on both engines beside their straightforward evaluation."""

import traceback
from collections.abc import Callable, Sequence

from scanbench.check.build import check_sources
from scanbench.engines.engine import Reason
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native import jit
from scanbench.engines.native.emit_program import emit_program
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.program import Program
from scanbench.program.types import Record, Type
from tests.caseformat import MODELS, first_difference
from tests.drawings.drawn import Drawn

MODEL = MODELS["GENERIC-IEC"]


def program_of(drawn: Sequence[Drawn]) -> str:
    """The drawings as blocks, and a main program that calls each once."""
    blocks = [
        each.source.replace("PROGRAM Main", f"FUNCTION_BLOCK F{number}", 1).replace("END_PROGRAM", "END_FUNCTION_BLOCK")
        for number, each in enumerate(drawn)
    ]
    names = "".join(f"f{number} : F{number}; " for number in range(len(drawn)))
    calls = "".join(f"f{number}();\n" for number in range(len(drawn)))
    return f"{''.join(blocks)}PROGRAM Main\nVAR {names}END_VAR\n{calls}END_PROGRAM\n"


def failure(drawn: Sequence[Drawn], level: int) -> str:
    """How they fail, '' if they do not. The words up to the first colon are the same for the same kind of failure."""
    checked = check_sources({"main.st": program_of(drawn)}, MODEL)
    if checked.program is None:
        return "refused: " + "\n".join(map(str, checked.problems))
    try:
        return _difference(checked.program, drawn, level)
    except Exception as error:
        return f"{type(error).__name__}: {error}\n{traceback.format_exc(limit=-4)}"


def _difference(program: Program, drawn: Sequence[Drawn], level: int) -> str:
    memories = [bytearray(program.initial_image) for _ in range(2)]
    # not optimised it is one module, as of a large program that begins soon: that takes half the time of its parts
    objects = None if level else [jit.compile_object(emit_program(program), level, jit.Timings())]
    engines = [ReferenceEngine(program, memories[0]), NativeEngine(program, memories[1], level, objects)]
    running = [(each, each.begin(), places(program, number, memories)) for number, each in enumerate(drawn)]
    for scan in range(max(len(each.sets) for each in drawn)):
        for each, _, place in running:
            for name, value in each.sets[scan].items():
                place(name).write(value)
        stops = [engine.run(1) for engine in engines]
        if [each.reason for each in stops] != [Reason.DONE] * 2:
            return f"stopped: {stops} in scan {scan}"
        if found := first_difference(program, *memories):
            return f"engines: {found} after scan {scan}"
        for each, evaluate, place in running:
            for name, wanted in evaluate(scan, each.sets[scan]).items():
                if (value := place(name).read()) != wanted:
                    return f"evaluation: {name} is {value}, not {wanted} after scan {scan}"
    return ""


class _Place:
    """A variable of a drawing, in the images of all engines."""

    __slots__ = ("_bit", "_end", "_memories", "_offset")

    def __init__(self, offset: int, size: int, bit: int | None, memories: Sequence[bytearray]) -> None:
        self._offset, self._end, self._bit, self._memories = offset, offset + size, bit, memories

    def read(self) -> int:
        number = int.from_bytes(self._memories[0][self._offset : self._end], "little", signed=True)
        return number if self._bit is None else number >> self._bit & 1

    def write(self, value: int) -> None:
        assert self._bit is None, "what is written has bytes of its own"
        for memory in self._memories:
            memory[self._offset : self._end] = value.to_bytes(self._end - self._offset, "little", signed=True)


def places(program: Program, number: int, memories: Sequence[bytearray]) -> Callable[[str], _Place]:
    """The variables of a drawing by their paths. `symbols.resolve` is for the paths that people write, and takes a hundred times as long."""
    main = next(each for each in program.shown if each.name == "Main")
    known: dict[str, _Place] = {}

    def place(path: str) -> _Place:
        if path not in known:
            type: Type = main.pou.instance
            offset, bit = main.offset, None
            for name in (f"f{number}", *path.split(".")):
                assert isinstance(type, Record)
                member = type.members[name.upper()]
                offset, bit, type = offset + member.offset, member.bit, member.type
            known[path] = _Place(offset, type.size, bit, memories)
        return known[path]

    return place
