"""What is said of the standard library: everything has a text, and the text names every parameter."""

import re

import pytest

from scanbench.check.standard.functions import FUNCTIONS
from scanbench.check.standard.library import library
from scanbench.language.describe import said_in_library
from scanbench.language.standard import parameter, summary, text_of
from scanbench.language.standard_texts import TEXTS

POUS = {pou.name: pou for file in library() for pou in file.pous if not pou.name.startswith("__")}


def untold(text: str, names: list[str]) -> list[str]:
    """Parameters that neither have a line nor are in the sentences."""
    words = re.findall(r"\w+", summary(text))
    return [name for name in names if not parameter(text, name) and name not in words]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_is_told_with_its_parameters(name: str) -> None:
    text, formals = text_of(name), list(FUNCTIONS[name].formals)
    assert text.endswith(".") or "\n- " in text
    assert not untold(text, [each for each in formals if not re.fullmatch(r"IN\d", each)])


@pytest.mark.parametrize("name", POUS)
def test_a_block_is_told_with_its_parameters(name: str) -> None:
    text = said_in_library(POUS[name].span)
    sections = [each for each in POUS[name].sections if each.keyword in ("VAR_INPUT", "VAR_OUTPUT")]
    assert summary(text).endswith(".")
    assert not untold(text, [variable.name.upper() for each in sections for variable in each.variables])


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("MAX_INT", TEXTS["MAX"]), ("ADD_TOD_TIME", TEXTS["ADD"]), ("MULTIME", TEXTS["MUL"]),
        ("INT_TO_REAL", "Converts IN from INT to REAL."), ("TO_INT", "Converts IN to INT."),
        ("BCD_TO_INT", "The number that the digits of IN in BCD are."), ("INT_TO_BCD_WORD", "The digits of the number IN in BCD."),
        ("NOTHING", ""),
    ],
)  # fmt: skip
def test_names_that_are_in_no_table_have_a_text(name: str, said: str) -> None:
    assert text_of(name) == said
