"""A memory area word by word: addresses in each vendor's notation, what lies there, where a value is."""

import pytest

from scanbench.check.build import check_sources
from scanbench.program.program import Program
from scanbench.symbols.memory import NoSuchArea, find, words
from tests.caseformat import MODELS

PROGRAM = """TYPE Pair : STRUCT low : INT; high : DINT; END_STRUCT; END_TYPE
PROGRAM Main
VAR {inside} n : INT; END_VAR
n := n + 1;
END_PROGRAM
"""


def program(model: str, inside: str = "") -> Program:
    checked = check_sources({"Main.st": PROGRAM.format(inside=inside)}, MODELS[model])
    assert checked.program is not None, checked.problems
    return checked.program


def shown(program: Program, area: str, first: int, count: int) -> list[str]:
    return [
        " ".join((each.address, *(symbol.path for symbol in each.symbols)))
        for each in words(program, area, first, count)
    ]


def test_a_word_has_its_address_and_the_variables_that_lie_in_it_even_in_part() -> None:
    made = program("CJ1M-CPU63", "a AT D10 : INT; b AT D11.03 : BOOL; c AT D11.00 : BOOL; d AT D12 : DINT;")
    assert shown(made, "D", 9, 6) == ["D9", "D10 Main.a", "D11 Main.c Main.b", "D12 Main.d", "D13 Main.d", "D14"]


def test_structures_and_arrays_lie_there_as_their_members() -> None:
    made = program("CJ1M-CPU63", "p AT D20 : Pair; f AT D30 : ARRAY[1..3] OF INT;")
    found = [path for each in shown(made, "D", 20, 20) for path in each.split()[1:]]
    assert list(dict.fromkeys(found)) == ["Main.p.low", "Main.p.high", "Main.f[1]", "Main.f[2]", "Main.f[3]"]


def test_areas_that_count_bits_and_iec_areas_have_words_too() -> None:
    melsec = program("Q03UD", "go AT X1F : BOOL;")
    assert shown(melsec, "X", 0, 2) == ["K4X0", "K4X10 Main.go"]
    assert shown(program("GENERIC-IEC", "speed AT %MW3 : INT;"), "M", 3, 1) == ["%MW3 Main.speed"]


@pytest.mark.parametrize("model", sorted(MODELS))
def test_the_address_of_each_first_and_last_word_of_a_model_is_an_address(model: str) -> None:
    made = program(model)
    for area in made.layout.model.areas:
        for word in (0, area.words - 1):
            (found,) = words(made, area.name, word, 5)[:1]
            place = MODELS[model].locate(found.address)
            assert place is not None
            assert (place.area.name, place.word, place.bits) == (area.name, word, 16)
        assert words(made, area.name, area.words, 5) == []


def test_a_value_is_found_where_words_begin_and_only_in_its_area() -> None:
    made = program("CJ1M-CPU63")
    image = bytearray(made.layout.size)
    at = made.layout.areas["D"]
    for word, value in ((3, 0x1234), (5, 0x1234), (7, 0x5678)):
        image[at + 2 * word : at + 2 * word + 2] = value.to_bytes(2, "little")
    image[at + 21 : at + 23] = b"\x34\x12"  # across two words
    assert find(made, image, "D", b"\x34\x12", 0, 9) == [3, 5]
    assert find(made, image, "D", b"\x34\x12", 4, 9) == [5]
    assert find(made, image, "D", b"\x00\x00", 0, 4) == [0, 1, 2, 4]
    assert find(made, image, "W", b"\x34\x12", 0, 9) == []


def test_an_area_that_the_model_does_not_have_is_refused_with_those_it_has() -> None:
    with pytest.raises(NoSuchArea, match="no memory area 'Z'; the areas are CIO, "):
        words(program("CJ1M-CPU63"), "Z", 0, 1)


def test_of_a_large_array_the_array_is_told_and_what_has_no_address_is_not_looked_through() -> None:
    made = program("CJ1M-CPU63", "many : ARRAY[0..30000] OF Pair; f AT D0 : ARRAY[0..9999] OF INT; last AT W7 : INT;")
    assert shown(made, "D", 9999, 2) == ["D9999 Main.f", "D10000"]
    assert shown(made, "W", 7, 1) == ["W7 Main.last"]
