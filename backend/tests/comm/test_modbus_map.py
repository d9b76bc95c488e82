"""The map of Modbus that a project has of its own."""

import pytest

from scanbench.comm.modbus.map_file import read_map
from scanbench.comm.modbus.mapping import as_csv, default
from scanbench.wire.refused import Refused
from tests.comm.bench import machine

HEAD = "group,first,last,from,to,registers of a value"
OMRON = machine().program.layout.model


@pytest.mark.parametrize("name", ["CJ1M-CPU13", "Q03UD", "GENERIC-IEC"])
def test_what_is_exported_can_be_read_again(name: str) -> None:
    model = machine(name).program.layout.model
    assert read_map(model, as_csv(default(model))) == default(model)


def test_a_short_table_with_comments_as_a_spreadsheet_writes_it() -> None:
    text = "\ufeff# of the line\r\n\r\nGroup;From;First;Last\r\ncoil;CIO10.00;5;24\r\nHolding register;W3;0;1\r\n"
    coils, words = read_map(OMRON, text)
    assert (coils.group, coils.first, coils.count, coils.area, coils.word) == ("coil", 5, 20, "CIO", 10)
    assert (coils.begins, coils.ends) == ("CIO10.00", "CIO11.03")
    assert (words.group, words.word, words.count, words.begins, words.ends) == ("holding register", 3, 2, "W3", "W4")


@pytest.mark.parametrize(
    ("lines", "why"),
    [
        (["coil,0,15,CIO0.00,,1", "coil,15,20,CIO5.00,,1"], "line 3: line 2 has some of these already"),
        (["coils,0,15,CIO0.00,,1"], "line 2: 'coils' is no group"),
        (["coil,zero,15,CIO0.00,,1"], "line 2: first is a whole number, not 'zero'"),
        (["coil,9,8,CIO0.00,,1"], "line 2: 9 to 8 is no range"),
        (["coil,0,70000,CIO0.00,,1"], "line 2: 0 to 70000 is no range"),
        (["# one", "coil,0,1,nowhere,,1"], "line 3: 'nowhere' is not an address"),
        (["coil,0,1,CIO0.01,,1"], "line 2: a range begins at bit 0 of a word, and CIO0.01 is none"),
        (["coil,0,1,D0,,1"], "line 2: a range begins at bit 0 of a word, and D0 is none"),
        (["holding register,0,1,CIO0.00,,1"], "line 2: a range begins at a word, and CIO0.00 is none"),
        (["holding register,0,1,D32767,,1"], "line 2: 2 from D32767 on do not fit into D"),
        (["holding register,0,2,D0,,2"], "line 2: 3 of 2 registers a value"),
        (["holding register,0,3,D0,D9,1"], "line 2: it ends at D3, not at D9"),
        (["coil,0,1," + "x" * 140_000], "line 2: this is no line of a table"),
        ([], "has no range"),
    ],
)
def test_a_wrong_line_is_named(lines: list[str], why: str) -> None:
    with pytest.raises(Refused) as refused:
        read_map(OMRON, "\n".join([HEAD, *lines]))
    assert why in refused.value.message
    assert refused.value.message.startswith("modbus.csv")


def test_columns_are_named() -> None:
    with pytest.raises(Refused, match="line 1: there is no column 'area'"):
        read_map(OMRON, "group,first,last,area\n")
    with pytest.raises(Refused, match="line 1: the column 'from' is missing"):
        read_map(OMRON, "group,first,last\n")
