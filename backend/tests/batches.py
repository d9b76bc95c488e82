"""Many random drawings in one program: each is a block with an instance of its own, so that the compiler is called once for all of them."""

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from tests.caseformat import MODELS, find, first_difference, write

MODEL = MODELS["GENERIC-IEC"]
SIZE = 25 if os.environ.get("SCANBENCH_EXPLORE") else 1
"""So many in a program. One where hypothesis makes a failure small: it has to see each alone."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """One drawing, and what is expected of it."""

    source: str
    """A `PROGRAM Main`."""
    sets: Sequence[dict[str, str]]
    """Before each scan, what is written."""
    expected: Callable[[int], dict[str, str]]
    """After a scan, in their order, all that it has to have."""


def program_of(drawn: Sequence[Drawn]) -> str:
    """The drawings as blocks, and a main program that calls each once."""
    blocks = [
        each.source.replace("PROGRAM Main", f"FUNCTION_BLOCK F{number}", 1).replace("END_PROGRAM", "END_FUNCTION_BLOCK")
        for number, each in enumerate(drawn)
    ]
    names = "".join(f"f{number} : F{number}; " for number in range(len(drawn)))
    calls = "".join(f"f{number}();\n" for number in range(len(drawn)))
    return f"{''.join(blocks)}PROGRAM Main\nVAR {names}END_VAR\n{calls}END_PROGRAM\n"


def collect(batch: list[Drawn], drawn: Drawn) -> None:
    """One more drawing; when there are enough of them they are compared."""
    batch.append(drawn)
    if len(batch) == SIZE:
        taken = list(batch)
        batch.clear()
        compare(taken)


def compare(drawn: Sequence[Drawn]) -> None:
    """Both engines leave the same bytes after each scan, and in them is what is expected of each drawing."""
    source = program_of(drawn)
    checked = check_sources({"main.st": source}, MODEL)
    program = checked.program
    assert program is not None, "\n".join([*map(str, checked.problems), source])
    memories = [bytearray(program.initial_image) for _ in range(2)]
    engines = [ReferenceEngine(program, memories[0]), NativeEngine(program, memories[1])]
    for scan in range(max(len(each.sets) for each in drawn)):
        for path, value in _written(drawn, scan):
            for memory in memories:
                write(program, path, value, memory)
        for engine in engines:
            engine.run(1)
        assert not first_difference(program, *memories), f"scan {scan}\n{source}"
        for number, each in enumerate(drawn):
            wanted = each.expected(scan)
            found = {name: find(program, f"Main.f{number}.{name}", memories[0])[2] for name in wanted}
            assert found == wanted, f"scan {scan}\n{each.source}"


def _written(drawn: Sequence[Drawn], scan: int) -> Iterator[tuple[str, str]]:
    for number, each in enumerate(drawn):
        for name, value in each.sets[scan].items():
            yield f"Main.f{number}.{name}", value
