"""Files of other tools: one message says what they are, instead of one for each character."""

import pytest

from scanbench.check.build import check_sources
from tests.caseformat import MODELS

FILES = [
    (
        "a.xml",
        '<?xml version="1.0"?>\n<project xmlns="http://www.plcopen.org/xml/tc6_0200">\n<types/></project>',
        "PLCopen XML",
    ),
    (
        "a.L5X",
        '<?xml version="1.0"?>\n<!-- x -->\n<RSLogix5000Content Revision="1"><Controller/></RSLogix5000Content>',
        "Studio 5000",
    ),
    (
        "a.plcproj",
        '\ufeff<Project xmlns="http://schemas.microsoft.com/developer/msbuild/2003"></Project>',
        "Give the folder",
    ),
    ("a.tsproj", "<TcSmProject></TcSmProject>", "Give the folder"),
    ("a.export", "<ExportFile><A/></ExportFile>", "export of CODESYS"),
    ("a.project", "PK\x03\x04" + "\x00\x01?#" * 200, "project of a tool"),
    ("a.st", "<html><body>?</body></html>", "This is XML (`html`)"),
]


@pytest.mark.parametrize(("name", "text", "said"), FILES, ids=[name for name, _, _ in FILES])
def test_it_is_named_once(name: str, text: str, said: str) -> None:
    sources = {name: text, "b.st": "PROGRAM Main\nVAR x : INT; END_VAR\nx := 1;\nEND_PROGRAM\n"}
    problems = check_sources(sources, MODELS["GENERIC-IEC"]).problems
    assert [(each.code, each.span.file, each.span.line) for each in problems] == [("X001", name, 1)]
    assert said in problems[0].message


def test_a_text_is_no_such_file() -> None:
    text = "(* <project> *)\nPROGRAM Main\nVAR x : INT; b : BOOL; END_VAR\nb := x < 1;\nEND_PROGRAM\n"
    assert not check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems
