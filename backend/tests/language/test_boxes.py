"""The boxes that a drawing can put in, with their pins."""

from scanbench.language.boxes import Box, boxes
from tests.language.reading import FILE, marked

TEXT = """\
// Counts up.
FUNCTION_BLOCK Inc
VAR_INPUT by : INT; END_VAR
VAR_IN_OUT total : INT; END_VAR
VAR_OUTPUT n : INT; END_VAR
VAR hidden : INT; END_VAR
END_FUNCTION_BLOCK
FUNCTION Twice : INT
VAR_INPUT value : INT; END_VAR
Twice := 2 * value;
END_FUNCTION
PROGRAM Main
VAR inc : Inc; jam : TON; point : STRUCT x : INT; END_STRUCT; END_VAR
NETWORK
    |
END_NETWORK
END_PROGRAM
"""


def offered() -> dict[str, Box]:
    reading, position = marked(TEXT)
    return {each.name: each for each in boxes(reading, FILE, position)}


def test_instances_come_first_with_the_pins_of_their_blocks() -> None:
    found = offered()
    assert list(found)[:4] == ["inc", "jam", "Inc", "Twice"]
    assert (found["inc"].kind, found["inc"].type) == ("instance", "Inc")
    assert (found["inc"].inputs, found["inc"].outputs) == (("by", "total"), ("n",))
    assert (found["jam"].inputs, found["jam"].outputs) == (("IN", "PT"), ("Q", "ET"))
    assert found["jam"].types == found["TON"].types == ("BOOL", "TIME", "BOOL", "TIME")


def test_blocks_and_functions_have_pins_and_say_what_they_do() -> None:
    found = offered()
    assert found["Inc"] == Box(
        "Inc", "block", "", ("by", "total"), ("n",), ("INT", "INT", "INT"), False, False, "Counts up."
    )
    assert found["Twice"] == Box("Twice", "function", "", ("value",), (), ("INT",), False, False, "")
    assert (found["TON"].kind, found["TON"].inputs, found["TON"].outputs) == ("block", ("IN", "PT"), ("Q", "ET"))
    both, limit = found["AND"], found["LIMIT"]
    assert (both.inputs, both.by_position, both.more) == (("IN1", "IN2"), True, True)
    assert (limit.inputs, limit.more) == (("MN", "IN", "MX"), False)
    for each in (found["TON"], limit, found["MUX"]):
        assert each.comment
        assert "\n- " not in each.comment
    assert not any(name.startswith("__") for name in found)


def test_outside_of_pous_there_is_nothing() -> None:
    reading, _ = marked(TEXT)
    assert boxes(reading, FILE, len(reading.text(FILE))) == []
