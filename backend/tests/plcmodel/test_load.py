from pathlib import Path
from shutil import copy

import pytest

from scanbench.plcmodel.document import SIZE_LIMIT
from scanbench.plcmodel.load import NoModels, load_all, load_file, model_directory
from scanbench.problems import TABLE, Problem

from .conftest import Load

SMALL = """<?xml version="1.0" encoding="UTF-8"?>
<Model Name="SMALL" Vendor="maker">
  <Memory>
    <Area Name="D" Words="100"/>
    <Area Name="S" Words="10">
      <Access First="0" Last="4" Program="read" Tool="read" Engine="write"/>
      <Access First="5" Last="9" Program="read" Tool="read" Engine="read"/>
    </Area>
    <IecMap Letter="M" Area="D" Words="50"/>
  </Memory>
  <System ErrorCode="S0"/>
  <ErrorGroup>
    <Name>Errors</Name>
    <Error Id="first" ErrorCode="0010" ErrorFlag="S1.00" Severity="nonfatal" Priority="2">
      <Name>First</Name>
      <ErrorDetailPattern>
        <ErrorControl Name="unit" Type="Spin">
          <ErrorAddress Address="S2" Type="Byte" Min="0" Max="9" Default="0"/>
        </ErrorControl>
      </ErrorDetailPattern>
    </Error>
    <Error Id="second" ErrorCode="0020" ErrorFlag="S1.01" Severity="nonfatal" Priority="1">
      <Name>Second</Name>
    </Error>
  </ErrorGroup>
</Model>
"""
SPIN = '<ErrorAddress Address="S2" Type="Byte" Min="0" Max="9" Default="0"/>'


def test_the_small_model_itself_is_right(load: Load) -> None:
    model, problems = load(SMALL)
    assert problems == []
    assert model is not None
    assert [error.id for error in model.errors()] == ["first", "second"]


@pytest.mark.parametrize(
    ("old", "new", "code", "says", "points_at"),
    [
        ('ErrorFlag="S1.01"', 'ErrorFlag="S10.01"', "M003", "the last word is S9", 'S10.01" Sev'),
        ('ErrorFlag="S1.01"', 'ErrorFlag="S1.16"', "M003", "bit 16 does not exist", 'S1.16" Sev'),
        ('ErrorFlag="S1.01"', 'ErrorFlag="S1"', "M003", "must be a bit", 'S1" Sev'),
        ('ErrorFlag="S1.01"', 'ErrorFlag="S5.01"', "M003", "closed to the simulator", 'S5.01" Sev'),
        ('ErrorCode="S0"', 'ErrorCode="S0.01"', "M003", "must be a word", 'S0.01"/>'),
        ('Area="D" Words="50"', 'Area="E" Words="50"', "M003", "area 'E' does not exist", 'E" Words'),
        ('Area="D" Words="50"', 'Area="D" Words="101"', "M003", "outside of D", '101"/>'),
        ('Id="second"', 'Id="first"', "M004", "used in line 14 already", 'first" ErrorCode="0020"'),
        ('"S" Words="10"', '"S" Aliases="D" Words="10"', "M004", "two areas have the prefix 'D'", '<Area Name="S"'),
        ('0020" ErrorFlag="S1.01"', '0010" ErrorFlag="s100"', "M005", "belongs to 'first'", '0010" ErrorFlag="s100"'),
        ('First="5"', 'First="4"', "M006", "without gap or overlap", '<Access First="0"'),
        ('First="5"', 'First="6"', "M006", "must cover words 0 to 9", '<Access First="0"'),
        ('Max="9"', 'Max="256"', "M007", "Max 256 does not fit into 8 bits", '256" Default'),
        ('Min="0"', 'Min="10"', "M007", "Min 10 is greater than Max 9", '10" Max'),
        ('Default="0"', 'Default="10"', "M007", "is not in 0 to 9", '10"/>'),
        ('Type="Byte"', 'Type="Byte" Shift="9"', "M007", "are not in one word", "<ErrorAddress"),
        ('Type="Byte"', 'Type="Bit"', "M008", "a Bit has none", 'Bit" Min'),
        ('Min="0" Max="9"', 'Min="0"', "M008", "needs Min and Max", "<ErrorAddress"),
        (SPIN, SPIN * 2, "M008", "exactly one ErrorAddress, here are 2", "<ErrorControl"),
        ('Name="unit" Type="Spin"', 'Name="unit" Type="List"', "M008", "needs an Id", "<ErrorAddress"),
        ('Address="S2" Type="Byte"', 'Type="Byte"', "M008", "needs an Address", "<ErrorAddress"),
        ('"Byte" Min="0" Max="9"', '"BitArray" Min="0" Max="48"', "M003", "S5 is outside", 'S2" Type'),
    ],
)
def test_what_the_schema_cannot_say(load: Load, old: str, new: str, code: str, says: str, points_at: str) -> None:
    assert SMALL.count(old) == 1
    text = SMALL.replace(old, new)
    model, problems = load(text)
    assert model is None
    found = [problem for problem in problems if problem.code == code and says in problem.message]
    assert found, [str(problem) for problem in problems]
    assert rest_of_line(text, found[0]).startswith(points_at)


@pytest.mark.parametrize(
    ("old", "new", "says", "points_at"),
    [
        ('<System ErrorCode="S0"/>', "<Sytem/>", "not expected. Expected is one of ( System", "<Sytem"),
        ("<IecMap ", "<Bogus ", "Expected is ( IecMap )", "<Bogus"),
        ('"nonfatal" Priority="1"', '"mild" Priority="1"', "'fatal', 'nonfatal'", 'mild" Priority'),
        ('Id="second"', 'Id="Second One"', "is not accepted by the pattern", "Second One"),
        ('Words="100"', "", "The attribute 'Words' is required but missing", '<Area Name="D"'),
        ('Words="100"', 'Words="99999999"', "65536", "99999999"),
    ],
)
def test_what_the_schema_says(load: Load, old: str, new: str, says: str, points_at: str) -> None:
    assert SMALL.count(old) == 1
    text = SMALL.replace(old, new)
    model, problems = load(text)
    assert model is None
    assert {problem.code for problem in problems} == {"M002"}
    assert says in problems[0].message
    assert rest_of_line(text, problems[0]).startswith(points_at)


def test_elements_on_one_line_are_told_apart(load: Load) -> None:
    bad = '<Status Address="S0"/><Status Address="S11"/>'
    text = SMALL.replace('<System ErrorCode="S0"/>', f'<System ErrorCode="S0">{bad}</System>')
    _, problems = load(text)
    assert [(problem.span.line, problem.span.column) for problem in problems] == [(11, 65)]
    assert rest_of_line(text, problems[0]).startswith('S11"')


def test_a_tag_over_several_lines(load: Load) -> None:
    text = SMALL.replace('Id="second" ', 'Id="second"\n  ErrorCode="0021"\n  ').replace(' ErrorCode="0020"', "")
    _, problems = load(text.replace('ErrorFlag="S1.01"', 'ErrorFlag="S1.16"').replace('ErrorCode="0020" ', ""))
    assert [(problem.span.line, problem.span.column) for problem in problems] == [(24, 14)]


def rest_of_line(text: str, problem: Problem) -> str:
    assert problem.span.file == "maker/TEST.xml"
    return text.splitlines()[problem.span.line - 1][problem.span.column - 1 :]


def test_several_problems_come_at_once(load: Load) -> None:
    text = SMALL.replace('ErrorFlag="S1.01"', 'ErrorFlag="S1.16"').replace('First="5"', 'First="4"')
    _, problems = load(text)
    assert {problem.code for problem in problems} == {"M003", "M006"}
    assert all(problem.code in TABLE for problem in problems)


def test_the_other_models_still_load(directory: Path) -> None:
    (directory / "maker" / "A.xml").write_text("<Model", encoding="utf-8")
    (directory / "maker" / "B.xml").write_text(SMALL, encoding="utf-8")
    (directory / "maker" / "C.xml").write_text(SMALL, encoding="utf-8")
    models, problems = load_all(directory)
    assert [model.name for model in models] == ["SMALL"]
    assert [(problem.code, problem.span.file) for problem in problems] == [
        ("M001", "maker/A.xml"),
        ("M004", "maker/C.xml"),
    ]


def test_one_file_alone(directory: Path) -> None:
    path = directory / "maker" / "B.xml"
    path.write_text(SMALL, encoding="utf-8")
    model, problems = load_file(path, directory / "model.xsd")
    assert problems == []
    assert model is not None


def test_the_directory_can_be_named(directory: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SCANBENCH_MODELS", str(directory))
    assert model_directory() == directory
    monkeypatch.setenv("SCANBENCH_MODELS", str(directory / "nowhere"))
    with pytest.raises(NoModels, match="named by SCANBENCH_MODELS"):
        model_directory()


def test_an_unfinished_tag_has_line_and_column(load: Load) -> None:
    model, problems = load(SMALL.replace("</ErrorGroup>", ""))
    assert model is None
    assert [problem.code for problem in problems] == ["M001"]
    assert "mismatch" in problems[0].message
    assert problems[0].span.line == 26
    assert problems[0].span.column > 1


def test_billion_laughs(load: Load) -> None:
    entities = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 10))
    doctype = f'<!DOCTYPE Model [<!ENTITY a0 "ha">{entities}]>'
    model, problems = load(
        SMALL.replace("<Model", f"<!-- first -->\n{doctype}\n<Model", 1).replace(">First<", ">&a9;<")
    )
    assert model is None
    assert [(problem.code, problem.span.line, problem.span.column) for problem in problems] == [("M001", 3, 1)]
    assert "DOCTYPE" in problems[0].message


@pytest.mark.parametrize("doctype", ['<!DOCTYPE Model [<!ENTITY x SYSTEM "{}">]>', '<!DOCTYPE Model SYSTEM "{}">'])
def test_an_external_part_is_never_opened(load: Load, tmp_path: Path, doctype: str) -> None:
    secret = tmp_path / "secret"
    secret.write_text("<!ENTITY x 'leaked'>", encoding="utf-8")
    text = SMALL.replace("<Model", doctype.format(secret.as_uri()) + "<Model", 1).replace(">First<", ">&x;<")
    model, problems = load(text)
    assert model is None
    assert [problem.code for problem in problems] == ["M001"]
    assert "leaked" not in problems[0].message


def test_an_entity_without_a_doctype(load: Load) -> None:
    model, problems = load(SMALL.replace(">First<", ">&x;<"))
    assert model is None
    assert [problem.code for problem in problems] == ["M001"]
    assert "x" in problems[0].message


def test_a_file_that_is_too_large(load: Load) -> None:
    model, problems = load(SMALL + " " * SIZE_LIMIT)
    assert model is None
    assert problems[0].code == "M001"
    assert "4 MiB" in problems[0].message


def test_another_encoding_hides_nothing(directory: Path) -> None:
    text = SMALL.replace("<Model", "<!DOCTYPE Model><Model", 1)
    (directory / "maker" / "A.xml").write_bytes(text.replace("UTF-8", "UTF-16").encode("utf-16"))
    (directory / "maker" / "B.xml").write_bytes(text.replace("UTF-8", "UTF-7").encode("utf-8"))
    models, problems = load_all(directory)
    assert models == []
    assert [problem.code for problem in problems] == ["M001", "M001"]
    assert "UTF-8" in problems[0].message
    assert "DOCTYPE" in problems[1].message


def test_a_deep_tree_is_refused(load: Load) -> None:
    deep = "<ErrorSubGroup><Name>n</Name>" * 5000 + "</ErrorSubGroup>" * 5000
    model, problems = load(SMALL.replace("</ErrorGroup>", deep + "</ErrorGroup>"))
    assert model is None
    assert [problem.code for problem in problems] == ["M001"]


def test_the_schema_file_is_copied_whole(directory: Path, tmp_path: Path) -> None:
    """A shipped file loads from anywhere: nothing in it refers to its place."""
    copy(model_directory() / "omron" / "CJ1M-CPU63.xml", directory / "maker")
    models, problems = load_all(directory)
    assert problems == []
    assert [model.name for model in models] == ["CJ1M-CPU63"]
