"""Three hundred random programs on both engines; the same ones on every run. `make fuzz N=100000` takes others, and more."""

import pytest

from tests.programs import INGREDIENTS, conditions, generate
from tests.programs.compare import checked, compare, levels
from tests.programs.reduce import reduced

PROGRAMS = 300
CONDITIONS = 200
"""Programs that a random condition is evaluated on."""
BY_VALUE = 100
"""Programs whose blocks take their in-outs by value."""
BATCH = 50
MOST_REFUSED = BATCH // 5
"""Programs of a batch with a constant that the checker must refuse."""


@pytest.mark.parametrize("first", range(0, PROGRAMS, BATCH))
def test_engines_agree(first: int) -> None:
    compared = 0
    for seed in range(first, first + BATCH):
        source = generate(seed)
        for level in levels(seed):
            try:
                compared += compare(source, level) and level == 0
            except Exception as error:
                error.add_note(f"seed {seed} at O{level}:\n{source}")
                raise
    assert compared >= BATCH - MOST_REFUSED


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


@pytest.mark.parametrize("first", range(0, CONDITIONS, BATCH))
def test_conditions_hold_after_the_same_scans(first: int) -> None:
    results = []
    for seed in range(first, first + BATCH):
        source = generate(seed)
        program = checked(source)
        words = conditions.text(seed, program) if program is not None else "FALSE"
        try:
            results.append(conditions.compare(source, words))
        except Exception as error:
            error.add_note(f"seed {seed}, {words}:\n{source}")
            raise
    assert results.count(True) >= BATCH // 2


def test_a_seed_gives_the_same_program_again() -> None:
    assert [generate(seed) for seed in range(20)] == [generate(seed) for seed in range(20)]


def test_programs_have_everything() -> None:
    """What the ingredients are there for stands in some program."""
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
