"""`hardware.json`: what is fitted, checked against the model, and the error instances that there are by it."""

from pathlib import Path

import pytest

from scanbench.plcmodel.hardware import Fitted, fitted_instances, fitted_kind
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.read_hardware import ranges, read_hardware, write_hardware
from scanbench.plcmodel.user_errors import device_of, extended
from tests.runtime.bench import model

PORTS = (
    "rs-232c-port-error", "peripheral-port-error", *(f"communications-port-{port}-error" for port in range(8)),
)  # fmt: skip
GOLDEN = (Path(__file__).with_name("golden_hardware") / "hardware-1.json").read_text("utf-8")


def fitted() -> tuple[Fitted, ...]:
    found, problems = read_hardware(model("CJ1M-CPU13"), GOLDEN)
    assert (problems, found is None) == ([], False)
    return found or ()


def instances(known: Model, id: str) -> list[str] | None:
    error = known.error(id)
    assert error is not None
    found = fitted_instances(known.fitted, error)
    return None if found is None else [",".join(f"{name}={value}" for name, value in each) for each in found]


def test_the_golden_file_is_read_and_written_as_it_is() -> None:
    """Docs say how it looks: never edit it, a new version gets a file of its own."""
    assert write_hardware(fitted()) == GOLDEN
    assert fitted()[5] == Fitted("special-io-unit", 3, 0, 2, "Analog inputs")


def test_words_of_a_unit_are_kept_as_the_model_writes_them() -> None:
    text = '{"version": 1, "fitted": [{"kind": "basic-io-unit", "rack": 0, "slot": 1, "words": "CIO 0,  cio1", "name": "In"}]}'
    found, problems = read_hardware(model("CJ1M-CPU13"), text)
    assert problems == []
    assert found is not None
    assert found[0].words == ("CIO0", "CIO1")
    assert '"words": "CIO0, CIO1", "name": "In"' in write_hardware(found)


def test_the_errors_of_what_is_fitted() -> None:
    known, problems = extended(model("CJ1M-CPU13"), {"hardware.json": GOLDEN})
    assert problems == []
    told = {each.id: instances(known, each.id) for each in known.errors()}
    assert {id: each for id, each in told.items() if each is not None} == {
        "io-bus-error": ["rack=0,slot=0", "rack=0,slot=4", "rack=0,slot=2", "rack=1,slot=0"],
        "duplicated-unit-number": ["unit=2", "unit=19", "unit=36"],
        "duplicated-rack-number": ["rack=0", "rack=1"],
        "fals": ["number=7"],
        "fal": ["number=42"],
        "basic-io-error": ["rack=0,slot=0"],
        "cpu-bus-unit-error": ["unit=2"],
        "special-io-unit-error": ["unit=3", "unit=20"],
        "cpu-bus-unit-setting-error": ["unit=2"],
        "special-io-unit-setting-error": ["unit=3", "unit=20"],
        **{port: [] for port in PORTS},
    }
    fal = known.error("fal")
    assert fal is not None
    assert fitted_kind(known.fitted, fal).name((("number", "42"),)) == "pump overpressure"
    assert device_of(known) == model("CJ1M-CPU13")


def test_a_port_is_there_by_its_number() -> None:
    ports = (
        '{"kind": "serial-port", "number": 1, "name": "Scanner"}, {"kind": "communications-port", "number": 3}, '
        '{"kind": "communications-port", "number": 8}'
    )
    text = '{"version": 1, "fitted": [%s]}'
    _, problems = extended(model("CJ1M-CPU13"), {"hardware.json": text % ports})
    assert [each.message for each in problems] == [
        "communications-port 8 is outside of the CJ1M-CPU13: its numbers are 0 to 7"
    ]
    known, problems = extended(model("CJ1M-CPU13"), {"hardware.json": text % ports.rpartition(", {")[0]})
    assert problems == []
    assert [id for id in PORTS if instances(known, id)] == ["rs-232c-port-error", "communications-port-3-error"]
    names = {id: fitted_kind(known.fitted, error).name(()) for id in PORTS if (error := known.error(id)) is not None}
    assert {id: name for id, name in names.items() if name} == {"rs-232c-port-error": "Scanner"}


def test_a_board_is_fitted_or_not() -> None:
    plc = model("CS1H-CPU65H")
    text = '{"version": 1, "fitted": [%s]}'
    without, problems = extended(plc, {"hardware.json": text % ""})
    assert (problems, instances(without, "inner-board-error"), instances(without, "battery-error")) == ([], [], None)
    known, problems = extended(plc, {"hardware.json": text % '{"kind": "inner-board", "name": "Loop controller"}'})
    assert (problems, instances(known, "inner-board-error")) == ([], [""])


@pytest.mark.parametrize(
    ("items", "line", "words"),
    [
        ('{"kind": "special-io-unit", "number": 96}', 3, "special-io-unit 96 is outside of the CJ1M-CPU13: its numbers are 0 to 95"),
        ('{"kind": "special-unit", "number": 3}', 3, "there is no kind 'special-unit'. Did you mean `special-io-unit`?"),
        ('{"kind": "station", "number": 3}', 3, "CJ1M-CPU13 has no station; it has "),
        ('{"kind": "fal", "number": 5},\n{"kind": "fal", "number": 5}', 4, "fal 5 is fitted in line 3 already"),
        ('{"kind": "basic-io-unit", "rack": 2, "slot": 0}', 3, "rack 2 is outside of the CJ1M-CPU13: it has racks 0 to 1"),
        ('{"kind": "basic-io-unit", "rack": 0, "slot": 10}', 3, "slot 10 is outside of the CJ1M-CPU13: it has slots 0 to 9"),
        ('{"kind": "basic-io-unit", "rack": 0}', 3, "needs both rack and slot"),
        ('{"kind": "basic-io-unit", "rack": 0, "slot": 1},\n{"kind": "cpu-bus-unit", "number": 1, "rack": 0, "slot": 1}', 4, "is taken by line 3"),
        ('{"kind": "cpu-bus-unit"}', 3, "a cpu-bus-unit needs a number: 0 to 15"),
        ('{"kind": "cpu-bus-unit", "number": "1"}', 3, "number is '1', and has to be a whole number"),
        ('{"kind": "fal", "number": 1, "text": ""}', 3, "text is unknown; there are kind, number, rack, slot, words, name"),
        ('{"kind": "fal", "number": 1, "words": "0"}', 3, "a fal has no words of inputs and outputs"),
        ('{"kind": "cpu-bus-unit", "number": 1, "words": 0}', 3, "words is a text with the addresses"),
        ('{"kind": "cpu-bus-unit", "number": 1, "words": "CIO 0, D100"}', 3, "D100 is no word of inputs or outputs of the CJ1M-CPU13"),
        ('{"kind": "cpu-bus-unit", "number": 1, "words": "Z9"}', 3, "'Z9' is not an address of this model"),
        ('{"kind": "cpu-bus-unit", "number": 1, "words": "CIO 0"},\n{"kind": "cpu-bus-unit", "number": 2, "words": "CIO 1, CIO0"}', 4, "belongs to line 3 already"),
        ('{"kind": "fal", "number": 1, "rack": 1}', 3, "a fal is in no slot"),
        ("{", 4, "this is no JSON text"),
        (f'{{"kind": "fal", "number": {"9" * 5000}}}', 3, "a number is too long"),
        ("[" * 100_000, 1, "it is nested too deep"),
    ],
    ids=lambda value: str(value)[:60],
)  # fmt: skip
def test_what_is_wrong_is_told_at_its_line(items: str, line: int, words: str) -> None:
    found, problems = read_hardware(model("CJ1M-CPU13"), f'{{"version": 1, "fitted": [\n\n{items}\n]}}')
    assert found is None
    assert [(each.code, each.span.line) for each in problems] == [("M011", line)]
    assert words in problems[0].message


def test_a_format_of_later_is_refused() -> None:
    _, (problem,) = read_hardware(model(), '{"version": 2, "fitted": []}')
    assert "this Scanbench reads 1" in problem.message


@pytest.mark.parametrize("name", ["CJ1M-CPU63", "CP1H-XA40D", "CS1D-CPU65H", "NJ501-1300", "Q03UD", "GENERIC-IEC"])
def test_every_model_says_what_it_can_have(name: str) -> None:
    assert set(ranges(model(name))) >= {"fal"}
