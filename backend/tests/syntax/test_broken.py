"""Whatever text comes, parsing ends soon with problems, never with a crash."""

from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.syntax.cursor import MAX_DEPTH, MAX_PROBLEMS
from scanbench.syntax.lexer import KEYWORDS, MAX_UNREADABLE
from scanbench.syntax.tree import File
from tests.amounts import amount, slow
from tests.syntax.shown import complaints, read, show

WORDS = [
    *KEYWORDS,
    *"""METHOD CLASS INTERFACE PROPERTY PROPERTY_GET GET SET ACTION NAMESPACE USING EXTENDS IMPLEMENTS ABSTRACT FINAL OVERRIDE
    PUBLIC PRIVATE INTERNAL THIS SUPER NULL UNION OVERLAP REF_TO POINTER REFERENCE REF S R BY ON TASK RESOURCE WITH CONSTANT
    RETAIN CONTINUE JMP LD LDN ST ANDN JMPCN CAL CALC RET REGION BEGIN VERSION __TRY __NEW x y Main INT BOOL STRING WSTRING
    := => ?= = <> < > <= >= ** + - * / & ( ) [ ] , ; ; ; : . .. ^ # % { } (* *) // /* */ ' " $ ? ! @
    1 2.5 16#FF T#5s D#2000-02-30 TOD#1:2 INT#5 Color#RED 'a' "b" %IX0.0 %B1 %I* \ufeff ä""".split(),
    "\n",
    "\n",
]
SETTINGS = settings(max_examples=amount(800, 133), deadline=None)
PROGRAM = """NAMESPACE N
TYPE C : (A, B := 2) INT; S : STRUCT a : INT (0..5); b AT %B2 : BOOL; END_STRUCT; END_TYPE
FUNCTION_BLOCK ABSTRACT F EXTENDS G IMPLEMENTS I VAR_INPUT c : BOOL R_EDGE; i : H(a := 1); END_VAR
METHOD PUBLIC m : REF_TO INT VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR LD a
AND( b
)
JMPC x
x: CAL t(IN := a)
END_METHOD
PROPERTY p : INT GET p := 1; END_GET END_PROPERTY
CASE c OF A, N.C#B: x.%X1 := p^[1]; 1..3: ; ELSE FOR i := 1 TO 3 BY 2 DO f(a := NOT b, NOT q => c); END_FOR; END_CASE
END_FUNCTION_BLOCK
END_NAMESPACE
CONFIGURATION X RESOURCE r ON p TASK t(INTERVAL := T#1s); PROGRAM a WITH t : b(c := d); END_RESOURCE END_CONFIGURATION
"""


@SETTINGS
@given(st.lists(st.sampled_from(WORDS), max_size=80).map(" ".join))
def test_any_words(text: str) -> None:
    _answered(text)


@SETTINGS
@given(st.sampled_from(("PROGRAM p", "FUNCTION_BLOCK b VAR", "PROGRAM p\nLD x", "CLASS c METHOD m", "TYPE t :", "CONFIGURATION c")),
       st.lists(st.sampled_from(WORDS), max_size=50).map(" ".join))  # fmt: skip
def test_any_words_after_a_beginning(beginning: str, text: str) -> None:
    _answered(f"{beginning} {text}")
    _answered(f"{beginning}\n{text}\nEND_METHOD END_CLASS END_PROGRAM END_FUNCTION_BLOCK END_TYPE END_CONFIGURATION")


@SETTINGS
@given(st.text(max_size=100), st.sampled_from(("a.st", "a.TcPOU")))
def test_any_text(text: str, name: str) -> None:
    read(text, name)


@SETTINGS
@given(st.integers(0, len(PROGRAM)), st.integers(0, 40), st.sampled_from(["", *WORDS]))
def test_a_program_with_a_hole_or_a_word_too_many(at: int, gone: int, word: str) -> None:
    _answered(f"{PROGRAM[:at]} {word} {PROGRAM[at + gone :]}")


def test_every_cut_of_a_program() -> None:
    for end in range(len(PROGRAM)):
        _answered(PROGRAM[:end])


def _answered(text: str) -> File:
    """Reads it; every problem is in the text, and what was read can be shown."""
    file, problems = read(text)
    lines = text.count("\n") + 1
    for each in problems:
        assert 1 <= each.span.line <= lines
        assert each.message.endswith(".") or "Did you mean" in each.message
    show([file.types, file.pous, file.globals, file.configurations])
    return file


BOMBS = {
    "parentheses": "x := " + "(" * 50_000,
    "calls": "x := " + "f(" * 50_000,
    "indices": "x := " + "a[" * 50_000,
    "NOT": "x := " + "NOT " * 50_000,
    "signs": "x := " + "-" * 50_000 + "1;",
    "IF": "IF a THEN " * 30_000,
    "CASE": "CASE a OF 1: " * 30_000,
    "conditions": "IF " * 50_000,
    "types": "END_PROGRAM TYPE T : " + "ARRAY[1..2] OF " * 30_000,
    "structures": "END_PROGRAM TYPE T : " + "STRUCT a : " * 30_000,
    "references": "END_PROGRAM TYPE T : " + "REF_TO " * 30_000,
    "initial values": "END_PROGRAM TYPE T : INT := " + "[" * 50_000,
    "members": "END_PROGRAM TYPE T : S := " + "(a := " * 30_000,
    "counts": "END_PROGRAM TYPE T : S := [" + "2(" * 30_000,
    "namespaces": "END_PROGRAM " + "NAMESPACE n " * 30_000,
    "IL": "LD a\n" + "AND( b\n" * 30_000,
    "IL calls": "LD a\nCAL f(x := " + "g(" * 30_000,
    "chain": "x := 1" + " + 1" * 50_000 + ";",
    "path": "x := a" + ".b" * 50_000 + ";",
    "pointer": "x := p" + "^" * 50_000 + ";",
    "labels": "CASE a OF " + "1, " * 50_000,
    "ranges": "END_PROGRAM TYPE T : " + "a (" * 30_000,
    "comments": "(*" * 100_000,
    "comments of two kinds": "(* /* " * 50_000,
    "pragmas": "{" * 100_000,
    "strings": "'" * 100_001,
    "dollars": "'" + "$" * 100_001,
    "line": "x := 1; " * 30_000,
    "bad statements": "x y z\n" * 30_000,
    "bad declarations": "END_PROGRAM PROGRAM q VAR " + "x y z; " * 30_000,
    "bad characters": "?" * 200_000,
    "digits": "x := " + "9" * 200_000 + ";",
    "unfinished": "METHOD m " * 30_000,
    "open programs": "PROGRAM p " * 30_000,
    "open lists": "PROGRAM p VAR_GLOBAL " * 30_000,
    "types without end": "END_PROGRAM " + "TYPE " * 50_000,
    "stars": "*" * 200_000,
    "numbers with signs": "x := INT#" + "+" * 100_000,
}


@slow
def test_bombs_are_refused() -> None:
    """Depth, length and number: what took more than time in proportion would not come to an end here."""
    for name, text in BOMBS.items():
        _, problems = read(f"PROGRAM p\n{text}")
        assert problems, name
        assert len(problems) <= MAX_PROBLEMS + MAX_UNREADABLE, name


def test_depth_is_refused_with_a_message() -> None:
    found = complaints("PROGRAM p\nx := " + "(" * 1000 + "1" + ")" * 1000 + ";\ny := ;\nEND_PROGRAM")
    assert [each.split()[:2] for each in found] == [["S003", f"2:{6 + MAX_DEPTH + 1}"], ["S003", "3:6"]]
    assert "nested more than" in found[0]
    assert not complaints("PROGRAM p\nx := " + "(" * 150 + "1" + ")" * 150 + ";\nEND_PROGRAM")
