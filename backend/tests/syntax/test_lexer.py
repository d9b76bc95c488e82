"""Text -> tokens: comments, pragmas, places, encodings, words that are keywords only in places."""

import ast
import pickle
import re
from pathlib import Path

from scanbench.problems import Span
from scanbench.program.types import ELEMENTARY
from scanbench.syntax import parse_statement
from scanbench.syntax.lexer import CONTEXTUAL, KEYWORDS, TIME_TYPES, Lex, tokenize
from scanbench.syntax.parse_il import MNEMONICS
from scanbench.syntax.source import Source, decode
from tests.syntax.shown import complaints, show_body, well


def words(text: str) -> list[str]:
    return [word for word in tokenize(Source("a.st", text))[0].texts if word]


def test_comments_nest() -> None:
    assert words("a (* b (* c *) d *) e /* f /* g */ h */ i // j (* k\nl {m} n {o {p} q} r") == [
        "a",
        "e",
        "i",
        "l",
        "n",
        "r",
    ]
    assert words("(**)a(***)b(* ) * ( *)c/**/d//") == ["a", "b", "c", "d"]


def test_marks_of_comments_inside_of_strings_are_text() -> None:
    assert words("'(*' a \"/*\" b '{' c (* ' *) d") == ["'(*'", "a", '"/*"', "b", "'{'", "c", "d"]
    assert words("(* (* *) *) '(*' a") == ["'(*'", "a"]


def test_a_comment_without_end_is_one_problem() -> None:
    for mark, what in (("(*", "comment"), ("/*", "comment"), ("{", "pragma")):
        assert complaints(f"PROGRAM p\nEND_PROGRAM\n  {mark} x := 1;\n y") == [
            f"S002 3:3 This {what} never ends; close it."
        ]


def test_keywords_in_any_case_and_names_as_written() -> None:
    tokens = tokenize(Source("a.st", "If x THEN Ärger := true; end_if"))[0]
    assert tokens.texts[:8] == ["IF", "x", "THEN", "Ärger", ":=", "TRUE", ";", "END_IF"]
    assert tokens.kinds[3] is Lex.NAME


def test_places_of_tokens() -> None:
    source = Source("a.st", "a\n  bb (* \n *) := 'c'")
    tokens = tokenize(source)[0]
    spans = [source.span(at, at + len(text)) for at, text in zip(tokens.starts, tokens.texts, strict=True) if text]
    assert [(each.line, each.column, each.end_line, each.end_column) for each in spans] == [
        (1, 1, 1, 2),
        (2, 3, 2, 5),
        (3, 5, 3, 7),
        (3, 8, 3, 11),
    ]


def test_a_lazy_span_is_a_span() -> None:
    source = Source("a.st", "ab\ncd")
    lazy, plain = source.span(1, 4), Span("a.st", 1, 2, 2, 2)
    assert (lazy, hash(lazy), str(lazy), repr(lazy)) == (plain, hash(plain), str(plain), repr(plain))
    assert plain == lazy
    assert lazy != source.span(1, 3)
    copy = pickle.loads(pickle.dumps(lazy))
    assert (type(copy), copy) == (Span, plain)
    assert lazy.to(Span("a.st", 9, 1, 9, 5)) == Span("a.st", 1, 2, 9, 5)
    assert source.span(0, 1).to(lazy) == Span("a.st", 1, 1, 2, 2)


def test_bytes_of_a_file() -> None:
    assert decode(b"\xef\xbb\xbfa\r\nb\rc") == "a\nb\nc"
    assert decode("ä€".encode()) == "ä€"
    assert decode(b"x := '\xe4';") == "x := 'ä';"
    assert decode(b"\xef\xbb\xbfx \xe4") == "x ä"


def test_a_mark_of_byte_order_and_carriage_returns_are_blanks() -> None:
    assert well("\ufeffPROGRAM p\r\nEND_PROGRAM\r\n").pous[0].name == "p"


def test_characters_without_meaning() -> None:
    assert "S001 2:8 `§` has no meaning here; remove it." in complaints("PROGRAM p\nx := 1 § 2;\nEND_PROGRAM")


def test_characters_that_cannot_be_seen_are_named() -> None:
    found = complaints("PROGRAM p\nx := \x07 \x1b[31m \u202e\u00a0;\nEND_PROGRAM")
    assert r"S001 2:6 `\x07` has no meaning here; remove it." in found
    assert r"S001 2:8 `\x1b` has no meaning here; remove it." in found
    assert r"S001 2:14 `\u202e` has no meaning here; remove it." in found
    assert "".join(found).isprintable()


def test_operators_of_other_languages_are_named() -> None:
    def of(expression: str) -> str:
        return complaints(f"PROGRAM p\nx := {expression};\nEND_PROGRAM")[0]

    assert "S001 2:6 `???` stands for what is not connected" in str(complaints("PROGRAM p\nx := ???;\nEND_PROGRAM"))
    assert str(complaints("PROGRAM p\nx := ???;\nEND_PROGRAM")).count("S001") == 1
    assert of("!a") == "S001 2:6 `!` is of another language; write NOT."
    assert (
        complaints("PROGRAM p\nx := a || b;\nEND_PROGRAM").count("S001 2:8 `||` is of another language; write OR.") == 1
    )
    assert "S001 2:9 `|`" not in str(complaints("PROGRAM p\nx := a || b;\nEND_PROGRAM"))
    assert "write `<>`" in of("a != b")
    assert of("a == b") == "S003 2:8 `==` is of another language; write `=`."
    assert of("a && b") == "S003 2:8 `&&` is of another language; write AND."
    assert "write SHR(value, count)" in of("a >> 1")
    assert len(complaints("?" * 100_000)) <= 101


def test_words_of_edition_3_are_names_of_older_programs() -> None:
    names = """method class interface property namespace using final abstract override public private protected internal
    extends implements this super union on by continue retain constant task resource with overlap ref pointer reference
    LD ST S R LDN CAL JMP RET NOT_ AND_ GT get set action begin version region step transition goto type_ read_write R_EDGE""".split()
    declared = "\n".join(f"  {name} : INT;" for name in names)
    used = "\n".join(f"{name} := {name} + 1; {name}.{name}[{name}](a := {name}, b => {name});" for name in names)
    file = well(f"PROGRAM p\nVAR\n{declared}\nEND_VAR\n{used}\nEND_PROGRAM")
    assert [each.name for each in file.pous[0].sections[0].variables] == names
    assert len(file.pous[0].body) == 2 * len(names)  # type: ignore[arg-type]


def test_latch_and_bind() -> None:
    shown = show_body("a S= b; S S= S; c R= S = R; d REF= e; step S= a; goto R= b; f ?= g;")
    assert shown == (
        "Assignment(target=a, value=b, operator=S=) Assignment(target=S, value=S, operator=S=) "
        "Assignment(target=c, value=(S = R), operator=R=) Assignment(target=d, value=e, operator=REF=) "
        "Assignment(target=step, value=a, operator=S=) Assignment(target=goto, value=b, operator=R=) "
        "Assignment(target=f, value=g, operator=?=)"
    )


def test_every_word_that_the_parser_expects_is_known() -> None:
    known = KEYWORDS | CONTEXTUAL | ELEMENTARY.keys() | MNEMONICS.keys() | TIME_TYPES.keys()
    for path in Path(parse_statement.__file__).parent.glob("parse_*.py"):
        texts = (each.value for each in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(each, ast.Constant))
        expected = {each for each in texts if isinstance(each, str) and re.fullmatch(r"[A-Z][A-Z_]+", each)}
        assert expected - known <= {"END_", "XBWDL", "CN"}, path
