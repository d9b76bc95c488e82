"""Every kind of detail, each control, to the bit; and what is refused."""

from collections.abc import Mapping
from pathlib import Path
from shutil import copy

import pytest

from scanbench.faults.details import Chosen, choose, code_text_raised, code_text_with
from scanbench.plcmodel.load import load_file, model_directory
from scanbench.plcmodel.model import ErrorEntry, Model
from scanbench.program.layout import Layout
from scanbench.runtime.command import Refusal
from tests.runtime.bench import model, program

BODY = """
<Error Id="byte" ErrorCode="0100" ErrorFlag="S1.00" Severity="fatal" Priority="1"><Name>n</Name><ErrorDetailPattern>
  <ErrorControl Name="low" Type="Spin"><ErrorAddress Address="S2" Type="Byte" Min="1" Max="200" Default="7"/></ErrorControl>
  <ErrorControl Name="high" Type="Edit"><ErrorAddress Address="S2" Type="Byte" Shift="8" Base="16" Min="0" Max="16#FF"/></ErrorControl>
</ErrorDetailPattern></Error>
<Error Id="fields" ErrorCode="0200" ErrorFlag="S1.01" Severity="fatal" Priority="2"><Name>n</Name><ErrorDetailPattern>
  <ErrorControl Name="bcd" Type="Edit"><ErrorAddress Address="S3" Type="BCD" Width="12" Min="0" Max="999" Default="85"/></ErrorControl>
  <ErrorControl Name="nibble" Type="Spin"><ErrorAddress Address="S3" Type="Nibble" Shift="12" Min="0" Max="15"/></ErrorControl>
  <ErrorControl Name="three" Type="List" Default="b">
    <ErrorAddress Id="a" Address="S4" Type="Word" Shift="13" Width="3" Value="1"/>
    <ErrorAddress Id="b" Address="S4" Type="Word" Shift="13" Width="3" Value="6"/>
  </ErrorControl>
  <ErrorControl Name="rest" Type="Edit"><ErrorAddress Address="S4" Type="Word" Width="13" Min="0" Max="8191"/></ErrorControl>
</ErrorDetailPattern></Error>
<Error Id="units" ErrorCode="0300" ErrorFlag="S1.02" Severity="fatal" Priority="3" AddToErrorCode="true"><Name>n</Name>
  <Also Address="S12" Type="Word" Detail="unit"/><Also Address="S13" Type="BCD" Detail="unit"/><Also Address="S14.03" Type="Bit"/>
  <Also Address="S15" Type="Byte" Shift="4" Value="16#5A"/><ErrorDetailPattern>
  <ErrorControl Name="unit" Type="Spin"><ErrorAddress Address="S5" Type="BitArray" Min="0" Max="95"/></ErrorControl>
  <ErrorControl Name="rank" Type="Spin"><ErrorAddress Address="S11" Type="Word" Min="0" Max="9" AddToErrorCode="false"/></ErrorControl>
  <ErrorControl Name="kind" Type="List">
    <ErrorAddress Id="none" Type="Word" Value="0"/><ErrorAddress Id="big" Type="Word" Value="16#100"/>
  </ErrorControl>
</ErrorDetailPattern></Error>
<Error Id="text" ErrorCode="0600" ErrorFlag="S1.03" Severity="fatal" Priority="4"><Name>n</Name><ErrorDetailPattern>
  <ErrorControl Name="name" Type="Edit"><ErrorAddress Address="S16" Type="Word" Base="text" Max="5"/></ErrorControl>
</ErrorDetailPattern></Error>
<Error Id="parts" ErrorCode="0700" ErrorFlag="S19.09" Severity="fatal" Priority="5" AddToErrorCode="true"><Name>n</Name><ErrorDetailPattern>
  <ErrorControl Name="part" Type="List">
    <ErrorAddress Id="a" Address="S19.00" Type="Bit" Value="1"/><ErrorAddress Id="b" Address="S19.08" Type="Bit" Value="2"/>
  </ErrorControl>
  <ErrorControl Name="far" Type="List">
    <ErrorAddress Id="a" Address="S6.00" Type="Bit" Value="0"/><ErrorAddress Id="b" Address="S7.00" Type="Bit" Value="0"/>
  </ErrorControl>
</ErrorDetailPattern></Error>
"""
FILE = f"""<?xml version="1.0" encoding="UTF-8"?>
<Model Name="KINDS" Vendor="maker"><Memory><Area Name="S" Words="20" Aliases="SR"/></Memory>
<System ErrorCode="S0"/><ErrorGroup><Name>g</Name>{BODY}</ErrorGroup></Model>
"""


@pytest.fixture(scope="module")
def kinds(tmp_path_factory: pytest.TempPathFactory) -> Model:
    directory = tmp_path_factory.mktemp("models")
    copy(model_directory() / "model.xsd", directory)
    path = Path(directory) / "KINDS.xml"
    path.write_text(FILE, encoding="utf-8")
    model, problems = load_file(path, directory)
    assert model is not None, problems
    return model


def error(kinds: Model, id: str) -> ErrorEntry:
    found = kinds.error(id)
    assert found is not None
    return found


def chosen(kinds: Model, id: str, details: Mapping[str, str]) -> Chosen | Refusal:
    return choose(error(kinds, id), details, Layout(kinds, {"S": 0}))


def memory(found: Chosen | Refusal, before: int = 0xFF) -> dict[int, int]:
    """The words that change when everything was `before` in each byte."""
    assert isinstance(found, Chosen), found
    image = bytearray([before] * 40)
    for part in found.bits:
        image[part.offset] = image[part.offset] & ~part.mask | part.value
    words = [int.from_bytes(image[at : at + 2], "little") for at in range(0, 40, 2)]
    return {number: word for number, word in enumerate(words) if word != before * 0x101}


@pytest.mark.parametrize(
    ("id", "details", "code", "words"),
    [
        ("byte", {}, 0x100, {1: 1, 2: 0x0007}),
        ("byte", {"low": "200", "high": "AB"}, 0x100, {1: 1, 2: 0xABC8}),
        ("byte", {"low": "16#10", "high": "0xff"}, 0x100, {1: 1, 2: 0xFF10}),
        ("byte", {"low": "1", "high": "#1"}, 0x100, {1: 1, 2: 0x0101}),
        ("fields", {}, 0x200, {1: 2, 3: 0x0085, 4: 6 << 13}),
        ("fields", {"bcd": "999", "nibble": "15", "three": "a", "rest": "8191"}, 0x200, {1: 2, 3: 0xF999, 4: 0x3FFF}),
        ("units", {}, 0x300, {1: 4, 5: 1, 14: 8, 15: 0x05A0}),
        (
            "units",
            {"unit": "35", "rank": "9", "kind": "big"},
            0x300 + 35 + 0x100,
            {1: 4, 7: 1 << 3, 11: 9, 12: 35, 13: 0x35, 14: 8, 15: 0x05A0},
        ),
        ("units", {"unit": "95"}, 0x35F, {1: 4, 10: 1 << 15, 12: 95, 13: 0x95, 14: 8, 15: 0x05A0}),
        ("text", {}, 0x600, {1: 8}),
        ("text", {"name": "A.B"}, 0x600, {1: 8, 16: 0x2E41, 17: 0x0042}),
        ("text", {"name": "Pump!"}, 0x600, {1: 8, 16: 0x7550, 17: 0x706D, 18: 0x0021}),
        ("text", {"name": " x"}, 0x600, {1: 8, 16: 0x7820}),
        ("parts", {"part": "b"}, 0x702, {6: 1, 19: 0x0300}),
        ("parts", {"part": "16#0101"}, 0x700, {6: 1, 19: 0x0301}),  # several bits of its word at once
        ("parts", {"part": "16#3"}, 0x700, {6: 1, 19: 0x0203}),
        ("parts", {"part": "16#0100"}, 0x702, {6: 1, 19: 0x0300}),  # which is choice b
    ],
)
def test_to_the_bit(kinds: Model, id: str, details: dict[str, str], code: int, words: dict[int, int]) -> None:
    found = chosen(kinds, id, details)
    assert isinstance(found, Chosen), found
    assert found.code == code
    assert memory(found, 0) == words


@pytest.mark.parametrize(
    ("id", "details", "untouched"),
    [
        ("byte", {}, {1: 0xFFFF, 2: 0x0007}),
        ("fields", {"rest": "1"}, {1: 0xFFFF, 3: 0x0085, 4: 0xC001}),
        ("text", {"name": "A"}, {1: 0xFFFF, 16: 0x0041, 17: 0, 18: 0xFF00}),
        ("units", {"unit": "3"}, {11: 0, 12: 3, 13: 3, 15: 0xF5AF}),
        ("parts", {"part": "16#0000"}, {19: 0xFEFE}),
    ],
)
def test_only_its_own_bits_are_written(
    kinds: Model, id: str, details: dict[str, str], untouched: dict[int, int]
) -> None:
    """A field is written whole, zeros too; bits beside it stay."""
    words = memory(chosen(kinds, id, details))
    assert words == {number: word for number, word in untouched.items() if word != 0xFFFF}


@pytest.mark.parametrize(
    ("id", "details", "reason"),
    [
        ("byte", {"low": "201"}, "low=201 is outside of 1 to 200"),
        ("byte", {"low": "0"}, "is outside of 1 to 200"),
        ("byte", {"low": "-1"}, "is outside of 1 to 200"),
        ("byte", {"low": "1.5"}, "is not a number to the base 10"),
        ("byte", {"low": "AB"}, "is not a number to the base 10"),
        ("byte", {"high": "100"}, "is outside of 0 to 255"),
        ("byte", {"high": "XY"}, "is not a number to the base 16"),
        ("byte", {"middle": "1"}, "has no detail middle: its details are low, high"),
        ("fields", {"bcd": "1000"}, "is outside of 0 to 999"),
        ("fields", {"three": "c"}, "it is one of a, b"),
        ("parts", {"part": "16#1_0000"}, "part cannot be '16#1_0000'; it is one of a, b"),
        ("parts", {"part": "16#10000"}, "it is one of a, b"),
        ("parts", {"part": "257"}, "it is one of a, b"),
        ("parts", {"far": "16#0001"}, "it is one of a, b"),
        ("fields", {"three": "16#0001"}, "it is one of a, b"),
        ("units", {"unit": "96"}, "is outside of 0 to 95"),
        ("text", {"name": "sixsix"}, "name has 6 characters, at most 5 fit"),
        ("text", {"name": "\u00e9"}, "takes ASCII characters"),
        ("text", {"name": "\n"}, "takes ASCII characters"),
    ],
)
def test_what_is_refused(kinds: Model, id: str, details: dict[str, str], reason: str) -> None:
    found = chosen(kinds, id, details)
    assert isinstance(found, Refusal)
    assert reason in found.message


@pytest.mark.parametrize("flag", ["S1.05", "S105", "SR1.05", "SR105", "s1.5", "S1.5"])
def test_a_flag_in_every_notation(tmp_path: Path, flag: str) -> None:
    copy(model_directory() / "model.xsd", tmp_path)
    path = tmp_path / "KINDS.xml"
    path.write_text(FILE.replace('ErrorFlag="S1.00"', f'ErrorFlag="{flag}"'), encoding="utf-8")
    model, problems = load_file(path, tmp_path)
    assert model is not None, problems
    assert error(model, "byte").flag == model.locate("S1.05")


@pytest.mark.parametrize(("default", "own", "code"), [
    ("true", "", 0x105), ("true", ' AddToErrorCode="true"', 0x105), ("true", ' AddToErrorCode="false"', 0x100),
    ("false", "", 0x100), ("false", ' AddToErrorCode="true"', 0x105), ("1", "", 0x105), ("0", ' AddToErrorCode="1"', 0x105),
])  # fmt: skip
def test_add_to_error_code_on_the_error_is_the_default(tmp_path: Path, default: str, own: str, code: int) -> None:
    copy(model_directory() / "model.xsd", tmp_path)
    path = tmp_path / "KINDS.xml"
    text = (
        FILE.replace('Priority="1"', f'Priority="1" AddToErrorCode="{default}"')
        .replace('Max="200" Default="7"', f'Max="200" Default="7"{own}')
        .replace('Max="16#FF"', 'Max="16#FF" AddToErrorCode="false"')
    )
    path.write_text(text, encoding="utf-8")
    model, problems = load_file(path, tmp_path)
    assert model is not None, problems
    found = chosen(model, "byte", {"low": "5"})
    assert isinstance(found, Chosen)
    assert found.code == code


def test_every_text_of_the_example_is_written_as_the_vendor_does(kinds: Model) -> None:
    found = chosen(kinds, "units", {"unit": "16#A"})
    assert isinstance(found, Chosen)
    assert (found.code_text, str(found)) == ("030A", "unit=10, rank=0, kind=none")


@pytest.mark.parametrize(("text", "written"), [("16#101", "16#0101"), ("16#8", "16#0008"), ("16#1", "a"), ("b", "b")])
def test_bits_of_a_list_have_one_notation(kinds: Model, text: str, written: str) -> None:
    found = chosen(kinds, "parts", {"part": text})
    assert isinstance(found, Chosen)
    assert str(found) == f"part={written}, far=a"
    assert chosen(kinds, "parts", dict(found.details)) == found


def test_the_code_of_what_is_raised_has_the_defaults() -> None:
    fal = model().error("fal")
    assert fal is not None
    assert (code_text_with(fal, {}), code_text_raised(fal, {}), code_text_raised(fal, {"number": "5"})) == (
        "4100", "4101", "4105",
    )  # fmt: skip
    layout = program("PROGRAM Main END_PROGRAM").layout
    for error in model().errors():
        found = choose(error, {}, layout)
        assert isinstance(found, Chosen)
        assert code_text_raised(error, {}) == found.code_text, error.id
