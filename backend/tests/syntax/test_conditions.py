"""Conditional pragmas: what is wrong with them is told, in the middle of an edit as well."""

import pytest

from scanbench.syntax.chunks import read
from scanbench.syntax.parse_file import parse_file
from scanbench.syntax.source import Source

HEAD = "PROGRAM Main\nVAR x : INT; END_VAR\n"
POU = HEAD + "{}\nEND_PROGRAM\n"


@pytest.mark.parametrize(
    ("body", "code", "line"),
    [
        ("{IF defined (a)} x := 1;", "S003", 3),
        ("x := 1; {END_IF}", "S003", 3),
        ("x := 1;\n{ELSE} x := 2;", "S003", 4),
        ("{IF hasattribute (pou: Main, 'a')} x := 1; {END_IF}", "X001", 3),
        ("{IF defined (variable: x)} x := 1; {END_IF}", "X001", 3),
        ("{IF defined (a) defined (b)} x := 1; {END_IF}", "X001", 3),
        ("{IF (defined (a)} x := 1; {END_IF}", "X001", 3),
        ("{IF} x := 1; {END_IF}", "X001", 3),
    ],
)
def test_what_is_wrong_is_told_once(body: str, code: str, line: int) -> None:
    _, found = parse_file(Source("a.st", POU.replace("{}", body)))
    assert [(each.code, each.span.line) for each in found] == [(code, line)]


def test_nothing_is_asked_of_what_is_excluded_itself() -> None:
    body = "{IF defined (a)} {IF hastype (variable: x, INT)} x := 1; {ELSE} ??? {END_IF} {END_IF}"
    _, found = parse_file(Source("a.st", POU.replace("{}", body)))
    assert [each.code for each in found if each.code != "S001"] == []


def test_a_file_with_conditions_is_read_as_a_whole() -> None:
    text = "{define a}\n" + POU.replace("{}", "{IF defined (a)} x := 1; {ELSE} nonsense {END_IF}")
    assert read("a.st", text).problems == []
    plain = read("a.st", POU.replace("{}", "x := 1;"))
    assert plain.edited(POU.replace("{}", "x := 1; {IF defined (a)} x := 2; {END_IF}")) is None


def test_twincat_files_define_for_their_methods() -> None:
    text = """<?xml version="1.0" encoding="utf-8"?>
<TcPlcObject><POU Name="Main"><Declaration><![CDATA[{define a}
PROGRAM Main
VAR x : INT; END_VAR]]></Declaration><Implementation><ST><![CDATA[{IF defined (a)} x := 1; {ELSE} if if {END_IF}]]></ST>
</Implementation></POU></TcPlcObject>"""
    file, found = parse_file(Source("Main.TcPOU", text))
    assert found == []
    assert len(file.pous) == 1
