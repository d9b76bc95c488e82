"""Values as text: every type reads back what it shows, and refuses what does not fit."""

import pytest

from scanbench.program.types import ELEMENTARY, NULL, Enumeration, Kind, Reference, StringType, Subrange, Type
from scanbench.symbols.values import format_value, parse_value, python_value

COLOR = Enumeration("Color", Kind.INT, 2, (("RED", 0), ("GREEN", 5)))
TO_INT = Reference("REF_TO INT", Kind.REF, 8, ELEMENTARY["INT"])
LEVEL = Subrange("Level", Kind.INT, 2, 0, 100)

SHOWN: list[tuple[Type, str, str]] = [
    (ELEMENTARY["DATE"], "date#2026-11-21", "D#2026-11-21"),
    (ELEMENTARY["DATE"], "1969-07-20", "D#1969-07-20"),
    (ELEMENTARY["LDATE"], "LD#2012-02-29", "LD#2012-02-29"),
    (ELEMENTARY["TIME_OF_DAY"], "TIME_OF_DAY#1:02:03.5", "TOD#01:02:03.5"),
    (ELEMENTARY["DATE_AND_TIME"], "DT#1984-06-25-15:36:55.36", "DT#1984-06-25-15:36:55.36"),
    (ELEMENTARY["LDATE_AND_TIME"], "LDT#1969-12-31-23:59:59.999999999", "LDT#1969-12-31-23:59:59.999999999"),
    (ELEMENTARY["LTIME"], "LTIME#1us2ns", "LT#1us2ns"),
    (ELEMENTARY["CHAR"], "'$0A'", "'$0A'"),
    (ELEMENTARY["WCHAR"], '"ä"', '"ä"'),
    (StringType(4, 2), '"€uro"', '"€uro"'),
    (StringType(4, zero=True), "'full'", "'full'"),
    (COLOR, "Color#green", "GREEN"),
    (COLOR, "Color.RED", "RED"),
    (COLOR, "5", "GREEN"),
    (LEVEL, "1200", "1200"),
    (NULL, "null", "NULL"),
]


@pytest.mark.parametrize(("type", "text", "shown"), SHOWN, ids=[text for _, text, _ in SHOWN])
def test_values_read_back(type: Type, text: str, shown: str) -> None:
    data = parse_value(type, text)
    assert format_value(type, data) == shown
    assert parse_value(type, shown) == data


REFUSED: list[tuple[Type, str, str]] = [
    (COLOR, "BLUE", "RED, GREEN"),
    (ELEMENTARY["DATE"], "D#2026-02-30", "no such day"),
    (ELEMENTARY["TIME_OF_DAY"], "25:00:00", "TOD#12:30:15.5"),
    (ELEMENTARY["CHAR"], "'ab'", "one character"),
    (StringType(2, 2), '"abc"', "at most 2"),
    (StringType(4, zero=True), "'a$00b'", "16#00"),
    (StringType(4, zero=True), "'ab cd'", "at most 4"),
    (TO_INT, "4660", "write NULL, or the variable"),
    (TO_INT, "16#1234", "write NULL, or the variable"),
]


@pytest.mark.parametrize(("type", "text", "said"), REFUSED, ids=[text for _, text, _ in REFUSED])
def test_what_does_not_fit_is_refused_with_what_does(type: Type, text: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        parse_value(type, text)


def test_a_string_is_its_bytes_up_to_the_first_zero_where_the_dialect_has_it_so() -> None:
    ended = StringType(4, zero=True)
    assert (ended.size, ended.align) == (5, 1)
    assert parse_value(ended, "'ab'") == b"ab\0"
    for data, text in ((b"ab\0xy", "ab"), (b"\0bcde", ""), (b"abcd\0", "abcd"), (b"abcde", "abcd")):
        assert python_value(ended, data) == text


def test_a_number_without_a_name_is_shown_as_it_is() -> None:
    assert format_value(COLOR, b"\7\0") == "7"
    assert python_value(COLOR, b"\5\0") == "GREEN"
    assert python_value(ELEMENTARY["DATE"], bytes(8)) == 0


def test_a_number_too_large_is_refused_in_both_widths() -> None:
    for name, text in (("REAL", "1e39"), ("LREAL", "1e400")):
        with pytest.raises(ValueError, match=f"too large for {name}"):
            parse_value(ELEMENTARY[name], text)
    assert format_value(ELEMENTARY["LREAL"], parse_value(ELEMENTARY["LREAL"], "-inf")) == "-inf"
