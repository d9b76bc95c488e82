"""What places of the image are called."""

from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.program.types import BOOL, ELEMENTARY
from scanbench.symbols.names import Names
from scanbench.symbols.sites import sites_of
from scanbench.symbols.symbols import resolve
from tests.runtime.bench import program

SOURCE = """
TYPE Point : STRUCT x, y : INT; ok : BOOL; END_STRUCT; END_TYPE
VAR_GLOBAL speed : INT; END_VAR
FUNCTION_BLOCK Base VAR speed : DINT; END_VAR END_FUNCTION_BLOCK
FUNCTION_BLOCK Belt EXTENDS Base
VAR_IN_OUT level : INT; END_VAR
VAR list : ARRAY[1..2] OF Point; END_VAR
VAR_TEMP t : INT; END_VAR
  t := level; level := t + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR belt : ARRAY[0..1] OF Belt; n : INT; word AT D10 : WORD; bit AT D10.03 : BOOL; END_VAR
  belt[0](level := n); belt[1](level := n); speed := n; word := 1;
END_PROGRAM
"""


def made() -> tuple[Program, Names]:
    found = program(SOURCE)
    return found, Names(found, sites_of(found))


def place(of: Program, path: str) -> int:
    return resolve(of, path).offset


def test_a_value_a_part_of_it_and_several_at_once() -> None:
    of, names = made()
    x = place(of, "Main.belt[1].list[2].x")
    assert [each.name for each in names.at(x, 2)] == ["Main.belt[1].list[2].x"]
    assert [each.name for each in names.at(x, 1)] == ["Main.belt[1].list[2].x.%B0"]
    assert [each.name for each in names.at(x, 1, 1 << 3)] == ["Main.belt[1].list[2].x.3"]
    assert [each.name.rpartition(".")[2] for each in names.at(x, 5)] == ["x", "y", "ok"]


def test_at_addresses_the_variable_that_was_probably_meant() -> None:
    of, names = made()
    d10 = place(of, "D10")
    assert [each.name for each in names.at(d10, 2)] == ["Main.word"]
    assert [each.name for each in names.at(d10, 1, 1 << 3)] == ["Main.bit"]
    assert [each.name for each in names.at(d10 + 20, 2)] == ["D20"]
    assert names.whole(d10, 1 << 4).name == "Main.word"


def test_inside_of_a_block_its_own_names_and_those_of_what_it_was_given() -> None:
    of, names = made()
    belt = next(pou for pou in of.pous if pou.name == "Belt")
    memory = bytearray(of.initial_image)
    start, n = place(of, "Main.belt[0]"), place(of, "Main.n")
    slot = resolve(of, "Main.belt[0].level").slots[0]
    memory[slot : slot + 8] = n.to_bytes(8, "little")
    inside = names.within(names.inside(belt, start, memory))
    assert [each.name for each in inside.at(place(of, "Main.belt[0].list[1].x"), 2, 0xFF)] == ["list[1].x"]
    assert [each.name for each in inside.at(n, 2, 0xFF)] == ["level"]
    assert [each.name for each in inside.at(place(of, "speed"), 2, 0xFF)] == ["speed (global)"]
    assert [each.name for each in inside.at(belt.frame_offset, 2, 0xFF)] == ["t"]


def test_instances_by_what_they_extend_and_temporaries_by_their_pou() -> None:
    of, names = made()
    start = place(of, "Main.belt[1]")
    assert names.instance(start, "Belt") == names.instance(start, "base") == "Main.belt[1]"
    assert names.instance(place(of, "Main"), "Main.Method") == "Main"
    belt = next(pou for pou in of.pous if pou.name == "Belt")
    assert names.temporary(belt.frame_offset) == (belt, "t")
    assert names.temporary(start) is None
    assert [each.name for each in names.temporaries(belt)] == ["Belt.t"]


def test_the_symbol_of_a_place_and_its_text() -> None:
    of, names = made()
    offset = place(of, "Main.belt[1].list[1].y")
    found = names.variable((offset, None), ELEMENTARY["INT"])
    assert found is not None
    assert found.path == "Main.belt[1].list[1].y"
    assert names.variable((offset, None), ELEMENTARY["LREAL"]) is None
    assert names.text(place(of, "D10"), 3, BOOL) == "Main.word.3 (D10.03)"
    assert names.text(offset, None, ELEMENTARY["INT"]) == "Main.belt[1].list[1].y"
    assert [names.path(16), names.path(of.layout.state_size + 4096)] == [
        "number of the scan (system)",
        f"image+{of.layout.state_size + 4096}",
    ]


def test_what_the_system_keeps_has_names_for_people() -> None:
    _, names = made()
    header = [names.whole(at, 0xFF) for at in range(Layout.CLOCK, Layout.HEADER_SIZE)]
    assert all(each.offset <= at < each.offset + each.type.size for at, each in enumerate(header, Layout.CLOCK))
    named = dict.fromkeys(each.name for each in header if not each.name.startswith("header+"))
    assert {
        "errors that the program raised (system)",
        "clock at virtual time 0 (system)",
        "_SubrangeErrorCount",
    } <= set(named)
    assert "error 2 that the program raised: number (system)" in named
    checked = program("PROGRAM Main VAR n : INT(0..9); END_VAR n := n + 1; END_PROGRAM")
    begin, names = checked.layout.violations, Names(checked)
    assert [names.whole(begin + at, 0xFF).name for at in (0, 4, 8 + 4, 8 + 48 + 16)] == [
        "number of violations in the list (system)", "violations that found no room (system)", "violation 1: times (system)",
        "violation 2: value (system)",
    ]  # fmt: skip
