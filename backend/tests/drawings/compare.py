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
LEFT_OUT = 3
"""The second instances are not called in each third scan."""


def program_of(drawn: Sequence[Drawn]) -> str:
    """The drawings as blocks, and a main program that calls two instances of each; the second one not in every scan."""
    blocks = [
        each.source.replace("PROGRAM Main", f"FUNCTION_BLOCK F{number}", 1).replace("END_PROGRAM", "END_FUNCTION_BLOCK")
        for number, each in enumerate(drawn)
    ]
    names = "".join(f"f{number}, g{number} : F{number}; " for number in range(len(drawn)))
    first, second = ("".join(f"{kind}{number}();\n" for number in range(len(drawn))) for kind in "fg")
    late = f"scan := scan + 1;\nIF scan MOD {LEFT_OUT} <> 0 THEN\n{second}END_IF;\n"
    return f"{''.join(blocks)}PROGRAM Main\nVAR scan : INT; {names}END_VAR\n{first}{late}END_PROGRAM\n"


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
    running = [
        (kind, each.sets[:: 1 if kind == "f" else -1], each.begin(), places(program, f"{kind}{number}", memories))
        for number, each in enumerate(drawn)
        for kind in "fg"
    ]
    for scan in range(max(len(each.sets) for each in drawn)):
        called = [each for each in running if each[0] == "f" or (scan + 1) % LEFT_OUT]
        for _, sets, _, place in called:
            for name, value in sets[scan].items():
                place(name).write(value)
        stops = [engine.run(1) for engine in engines]
        if [each.reason for each in stops] != [Reason.DONE] * 2:
            return f"stopped: {stops} in scan {scan}"
        if found := first_difference(program, *memories):
            return f"engines: {found} after scan {scan}"
        for kind, sets, evaluate, place in called:
            for name, wanted in evaluate(scan, sets[scan]).items():
                if (value := place(name).read()) != wanted:
                    which = "" if kind == "f" else " in the second instance"
                    return f"evaluation: {name} is {value}, not {wanted} after scan {scan}{which}"
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


def places(program: Program, instance: str, memories: Sequence[bytearray]) -> Callable[[str], _Place]:
    """The variables of a drawing by their paths. `symbols.resolve` is for the paths that people write, and takes a hundred times as long."""
    main = next(each for each in program.shown if each.name == "Main")
    known: dict[str, _Place] = {}

    def place(path: str) -> _Place:
        if path not in known:
            type: Type = main.pou.instance
            offset, bit = main.offset, None
            for name in (instance, *path.split(".")):
                assert isinstance(type, Record)
                member = type.members[name.upper()]
                offset, bit, type = offset + member.offset, member.bit, member.type
            known[path] = _Place(offset, type.size, bit, memories)
        return known[path]

    return place
