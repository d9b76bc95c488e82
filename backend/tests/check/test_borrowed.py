"""Words that the program may only read, passed to an in-out: refused where anything may write to that in-out."""

import pytest

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from tests.caseformat import MODELS

MODEL = MODELS["CJ1M-CPU63"]
INTERVAL_NS = 10_000_000
BLOCK = """
FUNCTION_BLOCK Base
VAR_IN_OUT word : WORD; END_VAR
VAR other : WORD; r : REF_TO WORD; p : POINTER TO WORD; i : UINT; END_VAR
METHOD PUBLIC Quiet : BOOL
  Quiet := word <> 0;
END_METHOD
{inside}
END_FUNCTION_BLOCK
"""
MAIN = """
FUNCTION Set : BOOL
VAR_IN_OUT w : WORD; END_VAR
  w := 1;
END_FUNCTION
{more}
PROGRAM Main
VAR flags AT A402 : WORD; it : {type}; END_VAR
  it(word := flags);
{after}
END_PROGRAM
"""


def problems(inside: str = "", more: str = "", after: str = "", type: str = "Base") -> list[tuple[str, str, int]]:
    files = {"block.st": BLOCK.format(inside=inside), "main.st": MAIN.format(more=more, after=after, type=type)}
    found = check_sources(files, MODEL, INTERVAL_NS).problems
    return [(each.code, each.span.file, each.span.line) for each in found if each.severity.value == "error"]


def line(more: str = "") -> int:
    return 9 + more.count("\n")


@pytest.mark.parametrize(
    "inside",
    [
        "other := word; IF word.%X3 THEN i := WORD_TO_UINT(word); END_IF;",
        "CASE WORD_TO_INT(word) OF 1: other := SHL(word, 2); ELSE other := THIS.word; END_CASE;",
    ],
)
def test_what_only_reads_may_have_it(inside: str) -> None:
    assert problems(inside) == []


@pytest.mark.parametrize(
    "inside",
    [
        "word := 1;", "THIS.word := 1;", "word.%X3 := TRUE;", "Set(word);", "Set(w := word);",
        "r REF= word;", "r := REF(word);", "p := ADR(word);",
        "METHOD PUBLIC Late\n  word := 1;\nEND_METHOD",
    ],
)  # fmt: skip
def test_what_may_write_is_refused(inside: str) -> None:
    assert problems(inside) == [("T011", "main.st", line())]


def test_a_block_that_extends_it_writes() -> None:
    derived = "FUNCTION_BLOCK More EXTENDS Base\n  word := 1;\nEND_FUNCTION_BLOCK\n"
    assert problems(more=derived) == [("T011", "main.st", line(derived))]


def test_instructions_of_a_list_write() -> None:
    listed = "FUNCTION_BLOCK Listed\nVAR_IN_OUT word : WORD; END_VAR\n  LD 16#1\n  ST word\nEND_FUNCTION_BLOCK\n"
    assert problems(more=listed, type="Listed") == [("T011", "main.st", line(listed))]


def test_a_method_behind_an_interface_may_write() -> None:
    """Which one runs is known only then."""
    more = (
        "INTERFACE Reader\nMETHOD Read : BOOL\nVAR_IN_OUT w : WORD; END_VAR\nEND_METHOD\nEND_INTERFACE\n"
        "CLASS One IMPLEMENTS Reader\nMETHOD PUBLIC Read : BOOL\nVAR_IN_OUT w : WORD; END_VAR\n  w := 1;\nEND_METHOD\nEND_CLASS\n"
        "FUNCTION Ask : BOOL\nVAR_INPUT reader : Reader; END_VAR\n"
        "  Ask := reader.Read(w := %A402);\nEND_FUNCTION\n"
    )
    assert [code for code, _, _ in problems(more=more)] == ["T011"]


def test_the_callee_alone_is_edited() -> None:
    whole, alone = Checks(), Checks()
    for inside in ("other := word;", "word := 1;", "other := word;", "p := ADR(word);"):
        files = {"block.st": BLOCK.format(inside=inside), "main.st": MAIN.format(more="", after="", type="Base")}
        expected = check_sources(files, MODEL, INTERVAL_NS).problems
        assert whole.check(files, MODEL, INTERVAL_NS).problems == expected
        assert alone.diagnose(files, MODEL, INTERVAL_NS).problems == expected
