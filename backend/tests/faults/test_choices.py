"""Which details of an error a sweep raises: those that the program tells apart."""

import pytest

from scanbench.faults.reaction.choices import Choices
from scanbench.faults.reference import ErrorRef
from tests.faults.reacting import checked

HEAD = "PROGRAM Main\nVAR lamp AT CIO 100.00 : BOOL; "


def raised(variables: str, body: str, error: str) -> list[str]:
    program = checked({"main.st": f"{HEAD}{variables} END_VAR\n  {body}\nEND_PROGRAM\n"})
    return [str(each) for each in Choices(program).of(error)]


@pytest.mark.parametrize(
    ("variables", "body", "found"),
    [
        ("", "lamp := TRUE;", [""]),
        ("unit AT A418.03 : BOOL;", "lamp := unit;", [":unit=3"]),
        ("one AT A418.03 : BOOL; two AT A418.05 : BOOL;", "lamp := one OR two;", [":unit=3", ":unit=5"]),
        ("one AT A418.00 : BOOL; two AT A418.05 : BOOL;", "lamp := one OR two;", ["", ":unit=5"]),
        ("any AT A402.06 : BOOL; unit AT A418.03 : BOOL;", "lamp := any AND unit;", ["", ":unit=3"]),
        ("units AT A418 : WORD;", "lamp := units <> 0;", [""]),  # all units of the word, the default too
        ("units AT A419 : WORD;", "lamp := units <> 0;", [":unit=16"]),
        ("code AT A400 : WORD;", "lamp := code = 16#0307;", [":unit=7"]),
        ("code AT A400 : WORD;", "CASE code OF 16#0300, 16#0309: lamp := TRUE; END_CASE;", ["", ":unit=9"]),
        ("n : WORD;", "lamp := n = 16#0307;", [""]),  # a number of a program that never looks at the code
    ],
)
def test_a_choice_is_told_apart_by_its_bits_or_its_code(variables: str, body: str, found: list[str]) -> None:
    assert raised(variables, body, "special-io-unit-error") == [f"special-io-unit-error{each}" for each in found]


def test_a_list_is_told_apart_by_its_bits() -> None:
    variables = "table AT A403.05 : BOOL;"
    assert raised(variables, "lamp := table;", "memory-error") == ["memory-error:location=io-table-checksum"]


def test_what_has_details_already_stays_and_each_is_raised_once() -> None:
    program = checked({"main.st": f"{HEAD} unit AT A418.03 : BOOL; END_VAR\n  lamp := unit;\nEND_PROGRAM\n"})
    unit = ErrorRef("special-io-unit-error", (("unit", "3"),))
    battery = ErrorRef("battery-error")
    assert Choices(program).expand([ErrorRef("special-io-unit-error"), battery, unit]) == [unit, battery]
