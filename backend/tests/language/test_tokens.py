"""What kind of thing each name is shown as."""

import json
import re
from pathlib import Path
from typing import get_args

from scanbench.language.tokens import Modifier, TokenKind, tokens
from tests.language.reading import FILE, marked, read

TEXT = """\
TYPE Color : (RED, GREEN); END_TYPE
TYPE Point : STRUCT x : INT; END_STRUCT; END_TYPE
NAMESPACE Plant
FUNCTION Half : INT
VAR_INPUT v : INT; END_VAR
Half := v / 2;
END_FUNCTION
END_NAMESPACE
FUNCTION_BLOCK Inc
VAR_OUTPUT n : INT; END_VAR
METHOD PUBLIC Reset : BOOL
END_METHOD
PROPERTY PUBLIC speed : INT
GET
speed := n;
END_GET
END_PROPERTY
END_FUNCTION_BLOCK
PROGRAM Main
VAR CONSTANT MOST : INT := 9; END_VAR
VAR a : INT; c : Color; p : Point; inc : Inc; t : TON; b : BOOL; END_VAR
a := MOST; c := RED; p.x := inc.n; b := inc.Reset(); a := inc.speed;
a := Plant.Half(a) + LIMIT(0, a, 5); t(IN := b);
END_PROGRAM
"""


def shown(text: str, start: int = 0, end: int | None = None) -> list[str]:
    """`name kind modifiers` of each token."""
    reading = read(text)
    found = tokens(reading, FILE, start, len(text) if end is None else end)
    return [" ".join((reading.text(FILE)[each.start : each.end], each.kind, *each.modifiers)) for each in found]


def test_uses_are_shown_as_what_they_mean() -> None:
    assert shown(TEXT, TEXT.index("a := MOST"), TEXT.index("b := inc.R")) == [
        "a variable", "MOST variable readonly", "c variable", "RED enumMember", "p variable", "x property", "inc variable",
        "n parameter",
    ]  # fmt: skip
    assert shown(TEXT, TEXT.index("Reset()"), TEXT.index("t(IN")) == [
        "Reset method", "a variable", "inc variable", "speed property", "a variable", "Half function", "a variable",
        "LIMIT function defaultLibrary", "a variable",
    ]  # fmt: skip
    assert shown(TEXT, TEXT.index("IN := b")) == ["IN parameter defaultLibrary", "b variable"]


def test_declarations_are_told_from_uses() -> None:
    assert shown(TEXT, 0, TEXT.index("NAMESPACE")) == [
        "Color type declaration", "RED enumMember declaration", "GREEN enumMember declaration", "Point type declaration",
        "x property declaration",
    ]  # fmt: skip
    assert shown(TEXT, TEXT.index("Half :"), TEXT.index("END_FUNCTION")) == [
        "Half function declaration", "v parameter declaration", "Half function", "v parameter",
    ]  # fmt: skip
    assert shown(TEXT, TEXT.index("Inc\n"), TEXT.index("GET")) == [
        "Inc class declaration", "n parameter declaration", "Reset method declaration", "speed property declaration",
    ]  # fmt: skip
    assert shown(TEXT, TEXT.index("MOST : "), TEXT.index("a := MOST")) == [
        "MOST variable readonly declaration", "a variable declaration", "c variable declaration", "Color type",
        "p variable declaration", "Point type", "inc variable declaration", "Inc class", "t variable declaration",
        "TON class defaultLibrary", "b variable declaration",
    ]  # fmt: skip


def test_symbols_of_the_model_are_of_its_library() -> None:
    reading, position = marked("PROGRAM Main VAR b : BOOL; END_VAR\nb := |P_On;\nEND_PROGRAM", "CJ1M-CPU63")
    (found,) = tokens(reading, FILE, position, position + 4)
    assert (found.kind, found.modifiers) == ("variable", ("defaultLibrary",))


def test_a_text_that_does_not_compile_is_shown_as_far_as_it_is_understood() -> None:
    text = "PROGRAM Main VAR n : INT; END_VAR\nn := LIMIT(0, undeclared, );\nn := n"
    assert shown(text, text.index("n := LIMIT")) == [
        "n variable", "LIMIT function defaultLibrary", "n variable", "n variable",
    ]  # fmt: skip


def test_the_page_counts_kinds_and_modifiers_in_the_same_order() -> None:
    page = Path(__file__).parents[3] / "frontend/src/panels/project/editor/semanticTokens.ts"
    lists = re.findall(r"token(?:Types|Modifiers): (\[[^\]]*\])", page.read_text("utf-8"))
    assert [json.loads(each) for each in lists] == [list(get_args(TokenKind)), list(get_args(Modifier))]
