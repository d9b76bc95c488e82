"""Siemens SCL: what is not read is told at its place, and places are those of the text as it is."""

import pytest

from scanbench.check.build import check_sources
from scanbench.language.format import formatted
from scanbench.program.types import Record
from scanbench.runtime.header import Mode, fresh_image
from scanbench.runtime.restart import retained
from scanbench.syntax.language_file import guess_dialect, with_dialect
from scanbench.syntax.scl import parse_scl
from scanbench.syntax.scl_words import name_of
from scanbench.syntax.source import Source
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]


def problems(text: str) -> list[str]:
    sources = with_dialect({"a.scl": text, "b.st": "PROGRAM Other END_PROGRAM"}, "siemens")
    return [
        f"{each.span.line}:{each.span.column} {each.code} {each.message}"
        for each in check_sources(sources, MODEL).problems
    ]


def test_places_are_those_of_the_text() -> None:
    text = 'FUNCTION "F" : Void\nVAR_INPUT\n  x : Int;\nEND_VAR\nBEGIN\n  #x := "y";\nEND_FUNCTION\n'
    assert [each[:9] for each in problems(text)] == ["6:4 W001 ", "6:10 T001"]


@pytest.mark.parametrize(
    ("value", "told"),
    [
        ("a[2] := 1;", "The index 2 is outside of 0..1."),
        ("a[0, 1] := 1;", "ARRAY[0..1] OF INT has no element of 2 indices."),
        ("b.x := 1;", "INT has no members; `x` is not among them."),
        ("c := 1;", "has no `c` to initialise."),
        ("s.d := 1;", "has no `d` to initialise."),
    ],
)
def test_a_start_value_of_what_is_not_there_is_told_at_its_place(value: str, told: str) -> None:
    text = f'DATA_BLOCK "D"\nSTRUCT\n  a : Array[0..1] of Int;\n  b : Int;\n  s : Struct\n c : Int;\nEND_STRUCT;\nEND_STRUCT;\nBEGIN\n  b := 2;\n  {value}\nEND_DATA_BLOCK\n'
    found = problems(text)
    assert [each.split()[1] for each in found] == ["D004"]
    assert found[0].startswith("11:")
    assert told in found[0]


def test_combined_assignments_are_read_one_at_a_time() -> None:
    text = 'FUNCTION "F" : Void\nVAR_TEMP\n  x : Int;\n  y : Array[0..2] of Int;\nEND_VAR\nBEGIN\n  {}\nEND_FUNCTION\n'
    for line in ("#x += 1;", "#y[#y[#x] + 1] -= #x * 2;", "IF #x = 1 THEN #x *= 2; ELSE #x /= 2; END_IF;"):
        assert problems(text.format(line)) == [], line
    assert [each[:9] for each in problems(text.format("#x += #x -= 2;"))] == ["7:12 X001"]


@pytest.mark.parametrize(
    ("quoted", "name"), [("FB_1", "FB_1"), ("My Block", "My_Block"), ("1st", "_1st"), ("Größe", "Größe")]
)
def test_a_name_between_quotes_becomes_one_of_the_standard(quoted: str, name: str) -> None:
    assert name_of(quoted) == name


def test_half_a_text_is_read_to_its_end() -> None:
    text = 'TYPE "U"\nVERSION : 0.1\nSTRUCT\n a : Int;\nEND_STRUCT;\nEND_TYPE\nDATA_BLOCK "D"\n"U"\nBEGIN\n a := 1;\nEND_DATA_BLOCK\n'
    text += 'ORGANIZATION_BLOCK "Main"\nTITLE = "x"\nVAR_TEMP\n i : Int;\nEND_VAR\nBEGIN\nREGION a\n #i := 1;\nEND_REGION\nEND_ORGANIZATION_BLOCK\n'
    for end in range(len(text)):
        parse_scl(Source("a.scl", text[:end]))
    assert problems(text) == []


def test_it_is_not_laid_out_and_tells_its_dialect() -> None:
    assert formatted("a.scl", "FUNCTION F : Void\nEND_FUNCTION\n") is None
    assert guess_dialect({"a.scl": ""}) == "siemens"
    assert guess_dialect({"src/a.st": ""}, ["apax.yml"]) == "siemens"
    assert guess_dialect({"a.st": ""}, ["Thumbs.db"]) == "iec"


def test_a_name_that_is_global_and_of_the_block_is_told_apart() -> None:
    block = (
        'FUNCTION_BLOCK "F"\nVAR\n  Speed : Int;\n  a : Int;\nEND_VAR\nBEGIN\n  #a := "Speed".{};\nEND_FUNCTION_BLOCK\n'
    )
    data = 'DATA_BLOCK "Speed"\nSTRUCT\n  v : Int;\nEND_STRUCT;\nEND_DATA_BLOCK\n'
    assert problems(block.format("v") + data) == []
    assert [each.split()[:2] for each in problems(block.format("w") + data)] == [["7:9", "T001"]]
    assert "7:9 T001 `Speed` is not declared." in problems(block.format("v"))[0]
    for name in ('"G"', "#G"):
        result = f'FUNCTION "G" : Int\nVAR_INPUT\n  a : Int;\nEND_VAR\nBEGIN\n  "G" := #a;\n  {name} := #a + 1;\nEND_FUNCTION\n'
        assert problems(result) == []


def test_an_organization_block_of_an_event_does_not_run_in_every_cycle() -> None:
    text = 'ORGANIZATION_BLOCK "Interval"\nTITLE = "Cyclic interrupt"\nBEGIN\nEND_ORGANIZATION_BLOCK\n'
    assert [each[:9] for each in problems(text)] == ["1:20 W007"]
    cyclic = 'ORGANIZATION_BLOCK "Second"\nTITLE = "Main Program Sweep (Cycle)"\nBEGIN\nEND_ORGANIZATION_BLOCK\n'
    assert problems(cyclic) == []


def test_a_data_block_is_kept_over_a_restart_as_it_says() -> None:
    text = 'DATA_BLOCK "D"\nVAR RETAIN\n  x : Int;\nEND_VAR\nBEGIN\n x := 1;\nEND_DATA_BLOCK\n'
    file, found = parse_scl(Source("a.scl", text))
    assert (file.globals[0].qualifiers, found) == (("RETAIN",), [])
    mixed = text.replace("BEGIN", "VAR\n  y : Int;\nEND_VAR\nBEGIN")
    program = check_sources({"a.scl": mixed, "b.st": "PROGRAM Other END_PROGRAM"}, MODEL).program
    assert program is not None
    assert program.layout.globals is not None
    [each] = program.layout.globals.members.values()
    assert isinstance(each.type, Record)
    x, y = (each.offset + each.type.members[name].offset for name in "XY")
    kept = retained(program, fresh_image(program, Mode.RUN))
    assert (x, 2) in kept
    assert (y, 2) not in kept


def test_a_type_that_is_not_there_is_told_once_and_not_at_every_call() -> None:
    text = "CLASS C\nVAR\n  t : Missing;\nEND_VAR\nMETHOD PUBLIC Run\n  t(signal := TRUE);\n  t(signal := FALSE);\nEND_METHOD\nEND_CLASS\n"
    for dialect in ("iec", "siemens"):
        found = check_sources(with_dialect({"a.st": text}, dialect), MODEL).problems
        assert [each.code for each in found] == ["D011", "D002"], dialect


def test_a_time_is_compared_with_a_number_of_milliseconds() -> None:
    text = 'FUNCTION "F" : Bool\nVAR_INPUT\n  t : Time;\nEND_VAR\nBEGIN\n  #F := #t - T#1s < {};\nEND_FUNCTION\n'
    assert [each.split()[1] for each in problems(text.format("0"))] == ["W006"]
    assert [each.split()[1] for each in problems(text.format("0.5"))] == ["T002"]


@pytest.mark.parametrize(
    ("line", "code", "told"),
    [
        ("#i := DB_ANY_TO_VARIANT(IN := #w);", "X001", "no numbers here"),
        ("#i := VariantGet(SRC := #i, DST => #s);", "T010", "is a statement"),
        ("VariantGet(SRC := #i, DST => #s);", "T002", "is a Variant"),
        ("VariantPut(SRC := #i);", "T004", "SRC and DST"),
        ("#i := CountOfElements(3);", "T004", "one variable"),
        ("SCATTER(IN := #w, OUT => #a);", "T002", "ARRAY of 16 BOOL"),
        ("STRG_VAL(IN := 'a', FORMAT := 0, P := 1, OUT => #w);", "T002", "a number at OUT"),
        ("MOVE_BLK(IN := #a[0], COUNT := 0, OUT => #a[1]);", "T004", "1 at least"),
        ("MOVE_BLK(IN := #a, COUNT := 2, OUT => #a[1]);", "T002", "`a[0]`"),
        ("MOVE_BLK(IN := #a[0], OUT => #a[1]);", "T004", "IN, COUNT, OUT"),
        ("RESET_TIMER(#i);", "X001", "IN := FALSE"),
        ("#i := #missing;", "T001", "`missing` is not declared"),
        ("#s := #v;", "D002", "library Siemens"),
        ("VariantPut(SRC := #i, DST := #v);", "D002", "library Siemens"),
    ],
)
def test_what_is_refused_is_told_once_with_what_to_do(line: str, code: str, told: str) -> None:
    variant = "  v : Variant;\n" if "#v" in line else ""
    text = f'FUNCTION "F" : Void\nVAR_INPUT\n{variant}  i : Int;\nEND_VAR\nVAR_TEMP\n  w : Word;\n  s : Int;\n  a : Array[0..3] of Int;\nEND_VAR\nVAR_IN_OUT\n  p : TP_TIME;\nEND_VAR\nBEGIN\n  {line}\nEND_FUNCTION\n'
    found = [each for each in problems(text) if not each.split()[1].startswith("W")]
    assert [each.split()[1] for each in found] == [code]
    assert told in found[0]
