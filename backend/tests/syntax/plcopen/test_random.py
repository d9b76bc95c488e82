"""Random drawings that are written as PLCopen XML and as IEC 61131-10 and read again compute what they did, or are left out and told."""

from collections.abc import Sequence
from random import Random

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.native import jit
from scanbench.engines.native.emit_program import emit_program
from scanbench.engines.native.engine import NativeEngine
from scanbench.garbage import without_collection
from scanbench.problems import Severity
from scanbench.syntax.plcopen.project import read_project
from scanbench.syntax.plcopen.write import Form, write_project
from tests.amounts import amount, nightly
from tests.caseformat import MODELS
from tests.drawings import charts, diagrams, ladder, mixed
from tests.drawings.compare import places, program_of
from tests.drawings.drawn import Drawn
from tests.drawings.draws import again, noted, smaller

KINDS = {"ladder": ladder.drawn, "diagram": diagrams.drawn, "chart": charts.drawn, "mixed": mixed.drawn}
EACH = 30
BATCHES = amount(34, 1)
"""Of 30 drawings for each kind and form."""
LEFT = {"ladder": 0.85, "diagram": 0.95, "chart": 0.0, "mixed": 0.8}
"""The part of the drawings that may be left out at most: loops, outputs of a box with EN that a network cannot keep, what IEC 61131-10 has no form for."""


class Running:
    """A program of drawings on the native engine."""

    def __init__(self, source: str, count: int) -> None:
        checked = check_sources({"main.st": source}, MODELS["GENERIC-IEC"])
        self.problems = [str(each) for each in checked.problems if each.severity is Severity.ERROR]
        if checked.program is None:
            return
        self.memory = bytearray(checked.program.initial_image)
        objects = [jit.compile_object(emit_program(checked.program), 0, jit.Timings())]
        self.engine = NativeEngine(checked.program, self.memory, 0, objects)
        self.places = [places(checked.program, f"f{number}", [self.memory]) for number in range(count)]

    def run(self, drawn: Sequence[Drawn], scan: int) -> list[dict[str, int]]:
        """The variables of each drawing after a scan."""
        for each, place in zip(drawn, self.places, strict=True):
            for name, value in each.sets[scan].items() if scan < len(each.sets) else ():
                place(name).write(value)
        self.engine.run(1)
        return [
            {name: place(name).read() for name in each.begin()(0, each.sets[0])}
            for each, place in zip(drawn, self.places, strict=True)
        ]


def difference(drawn: Sequence[Drawn], form: Form) -> tuple[str, int]:
    """What is different after it was written and read again, and how many drawings are left out."""
    source = mixed.FUNCTION + program_of(drawn)
    written = write_project("Random", {"main.st": source}, form)
    left = {each.split(",")[0] for each in written.left_out}
    files = read_project(written.data).files
    texts = {f"F{number}": files.get(f"F{number}.st", "") for number in range(len(drawn))}
    for name in left:
        texts[name] = _alone(source, name)
    other = mixed.FUNCTION + "".join(texts.values()) + source[source.index("PROGRAM Main") :]
    before, after = Running(source, len(drawn)), Running(other, len(drawn))
    assert before.problems == [], source
    if after.problems:
        return f"refused: {after.problems}\n{other}", len(left)
    for scan in range(max(len(each.sets) for each in drawn)):
        for number, (one, two) in enumerate(zip(before.run(drawn, scan), after.run(drawn, scan), strict=True)):
            if one != two:
                return f"scan {scan}: {one} became {two}\n{texts[f'F{number}']}", len(left)
    return "", len(left)


def _alone(source: str, name: str) -> str:
    at = source.index(f"FUNCTION_BLOCK {name}\n")
    return source[at : source.index("END_FUNCTION_BLOCK\n", at)] + "END_FUNCTION_BLOCK\n"


def explained(kind: str, notes: Sequence[list[int]], form: Form) -> str:
    """The failure of one drawing, made small."""
    make = KINDS[kind]

    def fails(fewer: list[int]) -> str:
        return difference([make(again(fewer))], form)[0]

    for each in notes:
        if fails(each):
            least = smaller(each, lambda fewer: bool(fails(fewer)))
            drawn = make(again(least))
            return f"{fails(least)}\nwas\n{drawn.source}before each scan: {drawn.sets}"
    return "only together"


@nightly
@pytest.mark.parametrize("seed", range(BATCHES))
@pytest.mark.parametrize("form", Form)
@pytest.mark.parametrize("kind", KINDS)
def test_drawings_compute_the_same_when_they_are_read_again(kind: str, form: Form, seed: int) -> None:
    random = Random(f"round trip {seed}")
    notes: list[list[int]] = [[] for _ in range(EACH)]
    with without_collection():
        drawn = [KINDS[kind](noted(random, each)) for each in notes]
        found, left = difference(drawn, form)
    assert not found, f"{found}\n{explained(kind, notes, form)}"
    assert left <= LEFT[kind] * EACH or (kind == "chart" and form is Form.PART10), f"{left} are left out"


def test_nearly_half_of_the_ladders_are_written() -> None:
    random = Random("round trip 0")
    drawn = [ladder.drawn(noted(random, [])) for _ in range(120)]
    left = write_project("Random", {"main.st": program_of(drawn)}).left_out
    assert len({each.split(",")[0] for each in left}) <= 66, left


def test_a_link_after_contacts_and_one_from_a_negated_output_are_written() -> None:
    """Both are read again as a network."""
    source = (
        "FUNCTION_BLOCK F0\nVAR_INPUT a, b, c : BOOL; END_VAR\nVAR k : CTU; q, r : BOOL; END_VAR\n"
        "RUNG\n    < k(EN := < [a] >, CU := ~, R := b, PV := 2, NOT Q => #low).Q (q) | [c] #low (r) >\nEND_RUNG\n"
        "END_FUNCTION_BLOCK\n"
    )
    written = write_project("Random", {"main.st": source})
    assert written.left_out == []
    text = read_project(written.data).files["F0.st"]
    assert "NETWORK" in text
    assert "NOT #" in text
