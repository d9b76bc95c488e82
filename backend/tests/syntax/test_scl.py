"""Siemens SCL: what is not read is told at its place, and places are those of the text as it is."""

import pytest

from scanbench.check.build import check_sources
from scanbench.language.format import formatted
from scanbench.syntax.language_file import guess_dialect, with_dialect
from scanbench.syntax.scl import name_of, parse_scl
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


def test_a_start_value_inside_of_a_member_is_refused_and_not_dropped() -> None:
    text = 'DATA_BLOCK "D"\nSTRUCT\n  a : Array[0..1] of Int;\n  b : Int;\nEND_STRUCT;\nBEGIN\n  a[0] := 1;\n  b := 2;\nEND_DATA_BLOCK\n'
    assert [each[:8] for each in problems(text)] == ["7:3 X001"]


@pytest.mark.parametrize(
    ("quoted", "name"), [("FB_1", "FB_1"), ("My Block", "My_Block"), ("1st", "_1st"), ("Größe", "Größe")]
)
def test_a_name_between_quotes_becomes_one_of_the_standard(quoted: str, name: str) -> None:
    assert name_of(quoted) == name


def test_half_a_text_is_read_to_its_end() -> None:
    text = 'TYPE "U"\nVERSION : 0.1\nSTRUCT\n a : Int;\nEND_STRUCT;\nEND_TYPE\nDATA_BLOCK "D"\n"U"\nBEGIN\n a := 1;\nEND_DATA_BLOCK\n'
    text += 'ORGANIZATION_BLOCK "M"\nTITLE = "x"\nVAR_TEMP\n i : Int;\nEND_VAR\nBEGIN\nREGION a\n #i := 1;\nEND_REGION\nEND_ORGANIZATION_BLOCK\n'
    for end in range(len(text)):
        parse_scl(Source("a.scl", text[:end]))
    assert problems(text) == []


def test_it_is_not_laid_out_and_tells_its_dialect() -> None:
    assert formatted("a.scl", "FUNCTION F : Void\nEND_FUNCTION\n") is None
    assert guess_dialect({"a.scl": ""}) == "siemens"
    assert guess_dialect({"a.st": ""}, ["Thumbs.db"]) == "iec"
