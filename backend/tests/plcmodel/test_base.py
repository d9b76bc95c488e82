"""Models that are based on another one."""

from pathlib import Path

from scanbench.plcmodel.load import load_all, load_file
from scanbench.plcmodel.model import Model

from .test_load import SMALL


def heir(directory: Path, body: str, attributes: str = "") -> Model:
    (directory / "maker" / "SMALL.xml").write_text(SMALL, encoding="utf-8")
    text = f'<Model Name="HEIR" Base="SMALL" Vendor="heirs" {attributes}>{body}</Model>'
    (directory / "maker" / "HEIR.xml").write_text(text, encoding="utf-8")
    models, problems = load_all(directory)
    assert problems == []
    return next(model for model in models if model.name == "HEIR")


def test_everything_comes_from_the_base(directory: Path) -> None:
    model = heir(directory, "")
    base, _ = load_file(directory / "maker" / "SMALL.xml", directory)
    assert base is not None
    assert (model.vendor, model.areas, model.iec_maps) == ("heirs", base.areas, base.iec_maps)
    assert (model.catalogue, model.specials, model.instructions) == (base.catalogue, base.specials, base.instructions)
    assert model.code_word == base.code_word


def test_what_it_names_takes_the_place_of_the_base_s(directory: Path) -> None:
    model = heir(
        directory,
        """<Description>An heir</Description>
        <Memory><Area Name="D" Words="200"/><Area Name="E" Words="5"/></Memory>
        <System><Special Name="beat" Address="E4.00" Role="pulse" Period="2s"/></System>
        <Instructions><Instruction Name="RAISE" Error="first" Parameter="No" Detail="unit" Min="2" Max="3"/></Instructions>
        <ErrorGroup><Name>Errors</Name>
          <Error Id="second" ErrorCode="0021" ErrorFlag="S1.02" Severity="fatal" Priority="1"><Name>Other</Name></Error>
          <Error Id="third" ErrorCode="0030" ErrorFlag="S1.03" Severity="fatal" Priority="1"><Name>Third</Name></Error>
        </ErrorGroup>""",
        'InOut="value"',
    )
    assert [(area.name, area.words) for area in model.areas] == [("D", 200), ("S", 10), ("E", 5)]
    assert model.iec_maps[0].area is model.areas[0]
    assert [(special.text, special.period_ns) for special in model.specials] == [("E4.00", 2_000_000_000)]
    assert [(each.parameter, each.minimum) for each in model.instructions] == [("No", 2)]
    assert [group.name for group in model.catalogue] == ["Errors"]
    assert [(error.id, error.code_text) for error in model.errors()] == [
        ("first", "0010"),
        ("second", "0021"),
        ("third", "0030"),
    ]
    assert model.in_out == "value"
    assert model.description == "An heir"


def test_what_it_has_not(directory: Path) -> None:
    without = '<Without Errors="second" Specials="beat" Instructions="RAISE" IecMaps="M" Areas="D"/>'
    model = heir(directory, without)
    assert [area.name for area in model.areas] == ["S"]
    assert [error.id for error in model.errors()] == ["first"]
    assert (model.iec_maps, model.specials, model.instructions) == ((), (), ())


def test_a_group_with_nothing_left_is_gone(directory: Path) -> None:
    model = heir(directory, '<Without Errors="first second" Instructions="RAISE"/>')
    assert model.catalogue == ()


def test_an_area_of_the_base_that_goes_takes_its_map_along_or_says_so(directory: Path) -> None:
    (directory / "maker" / "SMALL.xml").write_text(SMALL, encoding="utf-8")
    text = '<Model Name="HEIR" Base="SMALL" Vendor="heirs"><Without Areas="D"/></Model>'
    (directory / "maker" / "HEIR.xml").write_text(text, encoding="utf-8")
    models, problems = load_all(directory)
    assert [model.name for model in models] == ["SMALL"]
    assert [problem.code for problem in problems] == ["M003"]
    assert "maker/SMALL.xml:9 does not fit any more: area 'D' does not exist" in problems[0].message


def test_a_file_from_elsewhere_can_be_based_on_an_installed_one(directory: Path, tmp_path: Path) -> None:
    (directory / "maker" / "SMALL.xml").write_text(SMALL, encoding="utf-8")
    alone = tmp_path / "mine.xml"
    alone.write_text('<Model Name="MINE" Base="SMALL" Vendor="me"/>', encoding="utf-8")
    model, problems = load_file(alone, directory)
    assert problems == []
    assert model is not None
    assert model.name == "MINE"
