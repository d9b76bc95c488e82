"""Random programs that take and give back memory: both engines, and what a plain list of blocks says. What was left in the middle goes
on to the same bytes, all of it runs again to them, and no pointer leads out of the memory."""

import random

import pytest

from scanbench.check.build import check_sources
from scanbench.check.libraries.catalogue import used_libraries
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.types import SLOT_BYTES
from scanbench.syntax.language_file import with_dialect
from tests.amounts import amount
from tests.caseformat import MODELS, find, first_difference

POINTERS, SCANS, STEPS = 6, 12, 5
CELLS = 64


def made(chance: random.Random) -> tuple[str, list[tuple[int, int, int]]]:
    """The statements of each scan, and after each scan: the sum of what all blocks hold, blocks in use, refusals."""
    blocks: dict[int, list[int]] = {}
    lines: list[str] = []
    expected: list[tuple[int, int, int]] = []
    for scan in range(SCANS):
        lines.append(f"{scan}:")
        for _ in range(STEPS):
            number = chance.randrange(POINTERS)
            block = blocks.get(number)
            if block is None:
                count = chance.randint(1, 9)
                lines.append(
                    f"  IF p[{number}] = 0 THEN p[{number}] := __NEW(DINT, {count}); n[{number}] := {count}; END_IF"
                )
                blocks[number] = [0] * count
            elif chance.random() < 0.4:
                lines.append(f"  __DELETE(p[{number}]);")
                del blocks[number]
            else:
                at, value = chance.randrange(len(block)), chance.randint(-1000, 1000)
                lines.append(f"  p[{number}][{at}] := p[{number}][{at}] + {value};")
                block[at] += value
        expected.append((sum(map(sum, blocks.values())), len(blocks), 0))
    return "\n".join(lines), expected


@pytest.mark.parametrize(
    "seed", [pytest.param(each, marks=[] if each < 10 else pytest.mark.nightly) for each in range(amount(1000, 10))]
)
def test_both_engines_hold_what_was_stored(seed: int) -> None:
    text, expected = made(random.Random(seed))
    sources = with_dialect({"a.st": PROGRAM.format(text=text, last=POINTERS - 1)}, "codesys")
    libraries = {
        each.path: each.text.replace("CELLS : DINT := 8192", f"CELLS : DINT := {CELLS}")
        for each in used_libraries(sources, "codesys")
    }
    checked = check_sources(sources | libraries, MODELS["GENERIC-IEC"])
    program = checked.program
    assert program is not None, "\n".join(map(str, checked.problems))
    memories = [bytearray(program.initial_image) for _ in range(2)]
    engines = [ReferenceEngine(program, memories[0]), NativeEngine(program, memories[1])]
    half = b""
    for scan, wanted in enumerate(expected):
        for engine in engines:
            engine.run(1)
        assert not first_difference(program, *memories)
        for number in range(POINTERS):
            at = find(program, f"Main.p[{number}]", memories[0])[0]
            assert int.from_bytes(memories[0][at : at + SLOT_BYTES], "little") < len(memories[0])
        half = bytes(memories[0]) if scan == SCANS // 2 else half
        names = ("Main.sum", "__HEAP.InUse", "__HEAP.Refused")
        assert tuple(int(find(program, name, memories[0])[2]) for name in names) == wanted
    for start, scans in ((half, SCANS - 1 - SCANS // 2), (program.initial_image, SCANS)):
        again = bytearray(start)
        ReferenceEngine(program, again).run(scans)
        assert not first_difference(program, again, memories[1])


PROGRAM = """PROGRAM Main
VAR p : ARRAY[0..{last}] OF POINTER TO DINT; n : ARRAY[0..{last}] OF INT; sum : DINT; scan, i, j : INT; END_VAR
CASE scan OF
{text}
END_CASE
scan := scan + 1;
sum := 0;
FOR i := 0 TO {last} DO
  IF p[i] <> 0 THEN
    FOR j := 0 TO n[i] - 1 DO
      sum := sum + p[i][j];
    END_FOR
  END_IF
END_FOR
END_PROGRAM
"""
