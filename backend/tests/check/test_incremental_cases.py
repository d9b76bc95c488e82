"""Random edits of the programs of the case files: a check after an edit, and the modules that stay, are those of a fresh start."""

import random
import re
from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from scanbench.engines.native import parts
from scanbench.engines.native.parts import Parts
from scanbench.program.program import Program
from tests.amounts import amount, nightly, some
from tests.caseformat import MODELS, Case, read_cases

CASES = [
    case
    for path in some(sorted((Path(__file__).parents[1] / "cases").glob("*.case")), 3)
    for case in some(read_cases(path), 12)
]
EDITS = amount(2, 4)
INTERVAL_NS = 1_000_000
WORD = re.compile(r"[A-Za-z_]\w*")


def edited(text: str, chance: random.Random) -> str:
    """With a line twice, one more, one less, another number, another word, or half a line."""
    lines = text.split("\n")
    at = chance.randrange(len(lines))
    words = WORD.findall(lines[at])
    match chance.randrange(6):
        case 0:
            lines.insert(at, lines[at])
        case 1:
            lines.insert(at, "")
        case 2:
            del lines[at]
        case 3:
            lines[at] = re.sub(r"\b\d+\b", str(chance.randrange(9)), lines[at], count=1)
        case 4 if words:
            lines[at] = lines[at].replace(chance.choice(words), chance.choice(WORD.findall(text)), 1)
        case _:
            lines[at] = lines[at][: chance.randrange(len(lines[at]) + 1)]
    return "\n".join(lines)


def modules(program: Program | None, memory: Parts) -> list[str]:
    return [] if program is None else [part.text for part in memory.of(program)]


@nightly
@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_edits(case: Case, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parts, "SMALL", 0)  # parts of small programs, too
    chance, model = random.Random(case.name), MODELS[case.model]
    whole, problems, memory = Checks(), Checks(), Parts()
    text = case.source
    for _ in range(EDITS):
        files = {"case.st": text}
        expected = check_sources(files, model, INTERVAL_NS)
        found = whole.check(files, model, INTERVAL_NS)
        assert (found.problems, found.pous, found.checks) == (expected.problems, expected.pous, expected.checks)
        assert modules(found.program, memory) == modules(expected.program, Parts())
        if found.program is not None and expected.program is not None:
            assert found.program.traps == expected.program.traps
            assert found.program.initial_image == expected.program.initial_image
        said = problems.diagnose(files, model, INTERVAL_NS)
        assert (said.problems, said.pous, said.checks) == (expected.problems, expected.pous, expected.checks)
        text = edited(text if chance.random() < 0.6 else case.source, chance)
