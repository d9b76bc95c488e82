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
  <System ErrorCode="S0">
    <Special Name="beat" Address="S4.00" Role="pulse" Period="1s"/>
  </System>
  <Instructions>
    <Instruction Name="RAISE" Error="first" Parameter="N" Detail="unit" Min="1" Max="9" Clears="0"/>
  </Instructions>
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


def test_the_small_model_itself_is_right(load: Load) -> None:
    model, problems = load(SMALL)
    assert problems == []
    assert model is not None
    assert [error.id for error in model.errors()] == ["first", "second"]


def test_elements_on_one_line_are_told_apart(load: Load) -> None:
    bad = '<Status Address="S0"/><Status Address="S11"/>'
    text = SMALL.replace('<System ErrorCode="S0">', f'<System ErrorCode="S0">{bad}')
    _, problems = load(text)
    assert [(problem.span.line, problem.span.column) for problem in problems] == [(11, 65)]
    assert rest_of_line(text, problems[0]).startswith('S11"')


def test_a_tag_over_several_lines(load: Load) -> None:
    text = SMALL.replace('Id="second" ', 'Id="second"\n  ErrorCode="0021"\n  ').replace(' ErrorCode="0020"', "")
    _, problems = load(text.replace('ErrorFlag="S1.01"', 'ErrorFlag="S1.16"').replace('ErrorCode="0020" ', ""))
    assert [(problem.span.line, problem.span.column) for problem in problems] == [(29, 14)]


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
    model, problems = load_file(path, directory)
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
    assert problems[0].span.line == 31
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


def test_a_different_encoding_hides_nothing(directory: Path) -> None:
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


def test_the_example_of_the_readme_is_right(load: Load) -> None:
    readme = (model_directory() / "README.md").read_text("utf-8")
    model, problems = load(readme.split("```xml\n")[1].split("```")[0])
    assert problems == []
    assert model is not None
    assert [special.role for special in model.specials] == ["first-cycle", "pulse", "cycle-time", "clock"]
