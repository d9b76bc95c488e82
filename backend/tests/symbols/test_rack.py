"""The terminals of a PLC: what a program uses of its inputs and outputs, in every model."""

import pytest

from scanbench.check.build import check_sources
from scanbench.symbols.rack import INPUT, OUTPUT, terminals
from tests.caseformat import MODELS

PROGRAM = """PROGRAM Main
VAR {inside} n : INT; END_VAR
n := n + 1;
END_PROGRAM
"""


def shown(model: str, inside: str) -> list[str]:
    checked = check_sources({"Main.st": PROGRAM.format(inside=inside)}, MODELS[model])
    assert checked.program is not None, checked.problems
    sides = (INPUT, OUTPUT)
    return [
        f"{each.section} {each.path}" if each.section in sides else each.path for each in terminals(checked.program)
    ]


def test_a_word_that_is_used_is_shown_bit_by_bit_with_the_variables_in_it() -> None:
    found = shown("CJ1M-CPU63", "start AT CIO 2.01 : BOOL; motor AT CIO 100.00 : BOOL; belt AT D100.00 : BOOL;")
    assert found[:4] == ["input CIO2", "CIO2.00", "Main.start", "CIO2.02"]
    assert found[17:20] == ["output CIO100", "Main.motor", "CIO100.01"]
    assert len(found) == 2 * 17


def test_a_variable_that_is_larger_than_a_bit_has_its_word_alone() -> None:
    assert shown("GENERIC-IEC", "speed AT %QW4 : INT; level AT %IW2 : WORD;") == [
        "input %IW2",
        "Main.level",
        "output %QW4",
        "Main.speed",
    ]


@pytest.mark.parametrize("model", sorted(MODELS))
def test_every_model_with_inputs_and_outputs_has_terminals_without_a_variable(model: str) -> None:
    letters = {each.letter for each in MODELS[model].iec_maps}
    found = shown(model, "")
    assert len(found) == 17 * len(letters & {"I", "Q"})
    assert len(set(found)) == len(found) or any(each.area.unit == "bit" for each in MODELS[model].iec_maps)
