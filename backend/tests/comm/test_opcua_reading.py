"""Values of a controller that is read by OPC UA, as the cells of a log."""

import pytest
from asyncua import ua

from scanbench.comm.opcua.reading import cell_text
from scanbench.program.types import StringType
from scanbench.symbols.values import parse_value, python_value

TEXTS = ["", "seven", " a ", "'", "'a'", '"a"', "it's", "5$", "$N", "$$'", "a\nb", "\t"]


@pytest.mark.parametrize("text", TEXTS)
@pytest.mark.parametrize("width", [1, 2])
def test_a_string_is_the_same_in_the_program(text: str, width: int) -> None:
    type = StringType(20, width)
    cell = cell_text(ua.Variant(text, ua.VariantType.String))
    assert python_value(type, parse_value(type, cell)) == text
