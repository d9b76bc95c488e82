"""Random programs on both engines; the same ones on every run. `make fuzz N=100000` takes others, and more."""

import pytest

from scanbench.engines.native.compiler import Compiler
from tests.amounts import amount, nightly
from tests.programs import INGREDIENTS, conditions, generate
from tests.programs.compare import checked, compare, difference, levels
from tests.programs.reduce import reduced

PROGRAMS = amount(1000, 50)
BY_VALUE = amount(300, 16)
"""Programs whose blocks take their in-outs by value."""
BATCH = 50
MOST_REFUSED = BATCH // 5
"""Programs of a batch with a constant that the checker must refuse."""


@nightly
@pytest.mark.parametrize("first", range(0, PROGRAMS, BATCH))
def test_engines_agree(first: int) -> None:
    """On the images after every scan, and on the scan in which a random condition holds. A program is compiled once a level."""
    compared = conditioned = 0
    for seed in range(first, first + BATCH):
        source = generate(seed)
        try:
            program = checked(source)
            if program is None:
                continue
            compared += 1
            code = {level: Compiler().build(program, level).objects for level in levels(seed)}
            for level, objects in code.items():
                assert not (found := difference(program, level, objects)), f"O{level}: {found}"
            conditioned += conditions.compare(program, conditions.text(seed, program), code[0])
        except Exception as error:
            error.add_note(f"seed {seed}:\n{source}")
            raise
    assert compared >= BATCH - MOST_REFUSED
    assert conditioned >= BATCH // 2


@nightly
@pytest.mark.parametrize("first", range(PROGRAMS, PROGRAMS + BY_VALUE, BATCH))
def test_engines_agree_on_in_outs_by_value(first: int) -> None:
    copied = 0
    for seed in range(first, first + BATCH):
        source = generate(seed)
        for level in levels(seed):
            try:
                copied += compare(source, level, "value") and "VAR_IN_OUT" in source
            except Exception as error:
                error.add_note(f"seed {seed} at O{level}, in-outs by value:\n{source}")
                raise
    assert copied


def test_a_seed_gives_the_same_program_again() -> None:
    assert [generate(seed) for seed in range(20)] == [generate(seed) for seed in range(20)]


def test_programs_have_everything() -> None:
    """Each construct that the generator can make is in some program."""
    everything = "\n".join(generate(seed) for seed in range(200))
    for word in (
        "CONTINUE", "EXIT", "RETURN", "WHILE", "REPEAT", "Color#", "SUBRANGE_ERROR", "%X", "UNION", "ARRAY[*]", "WSTRING",
        "LDT#", "SUPER.Up", "ups.Up", "ENO =>", "JMPC", "SINGLE", "REF(", "^.next",
    ):  # fmt: skip
        assert word in everything, word
    assert len(INGREDIENTS) >= 13


def test_reduction_keeps_what_fails() -> None:
    source = "\n".join(f"line {number}" for number in range(100))
    assert reduced(source, lambda text: "line 17" in text and "line 80" in text).splitlines() == ["line 17", "line 80"]
