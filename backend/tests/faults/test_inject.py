"""Generate and Recover, to the bit."""

from datetime import UTC, datetime

import msgpack  # type: ignore[import-untyped]
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scanbench.faults.acknowledge import Acknowledge
from scanbench.faults.detect import Detection
from scanbench.faults.history import History
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.reference import ErrorRef, named_reference, parse_reference
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.forces import Force
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.write import Write
from scanbench.wire import codec
from tests.runtime.bench import ENGINES, model, plc, value

SOURCE = """
PROGRAM Main
VAR n : INT; out AT CIO 100.00 : BOOL; work AT W0 : INT; kept AT D0 : INT; basic AT A402.12 : BOOL; seen : INT := -1; END_VAR
  IF basic AND seen < 0 THEN seen := n; END_IF;
  n := n + 1; out := TRUE; work := n; kept := n;
END_PROGRAM
"""


def ref(text: str) -> ErrorRef:
    found = parse_reference(model(), text)
    assert isinstance(found, ErrorRef), found
    return found


def generate(resource: Resource, *texts: str, by: str = "Ada") -> Entry | Refusal:
    return resource.submit(Generate(by, tuple(map(ref, texts))))


def error_words(resource: Resource) -> bytes:
    """A400 to A447: code, flags, details."""
    start = resource.program.layout.areas["A"] + 800
    return bytes(resource.memory[start : start + 96])


@pytest.mark.parametrize("engine", ENGINES)
def test_the_example_of_the_format(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    resource.run(3)
    assert isinstance(generate(resource, "memory-error:io-table-checksum"), Entry)
    assert value(resource, "A400") == 0x80F4
    assert value(resource, "A401") == 1 << 15
    assert value(resource, "A403") == 1 << 5
    assert not resource.runnable
    assert value(resource, "Main.out") is False
    assert value(resource, "Main.work") == 0  # volatile memory is cleared
    assert value(resource, "Main.kept") == 3
    assert (value(resource, "A100"), value(resource, "A101"), value(resource, "A300")) == (0x80F4, 1 << 5, 1)


def test_a_nonfatal_error_is_seen_by_the_next_scan() -> None:
    resource = plc(SOURCE)
    resource.run(3)
    generate(resource, "basic-io-error:rack=1,slot=3")
    resource.run(1)
    assert value(resource, "Main.seen") == 3
    assert value(resource, "A400") == 0x009A
    assert value(resource, "A408") == 0x0103


@pytest.mark.parametrize(("hold", "error", "held"), [
    ("TRUE", "memory-error:program-checksum", True), ("FALSE", "memory-error:program-checksum", False),
    ("FALSE", "fals:number=5", True), ("FALSE", "fals:number=5 memory-error:program-checksum", False),
])  # fmt: skip
def test_where_memory_is_held_that_of_the_outputs_is_too(hold: str, error: str, held: bool) -> None:
    resource = plc(SOURCE)
    resource.run(3)
    resource.submit(Write("Ada", "A500.12", hold))
    entry = generate(resource, *error.split())
    assert isinstance(entry, Entry)
    assert value(resource, "Main.work") == (3 if held else 0)
    assert value(resource, "Main.out") is held
    assert entry.plan.message.endswith(", outputs off; memory is held, that of the outputs too") is held


@pytest.mark.parametrize("hold", [True, False])
def test_a_run_time_error_holds_memory_with_the_hold_bit(hold: bool) -> None:
    source = SOURCE.replace("END_VAR", "d : INT := 1; END_VAR").replace("END_PROGRAM", "work := work / d;\nEND_PROGRAM")
    resource = plc(source)
    resource.detect = Detection()
    resource.run(3)
    resource.submit(Write("Ada", "A500.12", "TRUE" if hold else "FALSE"))
    resource.submit(Write("Ada", "Main.d", "0"))
    resource.run(1)
    assert resource.trap is not None
    assert value(resource, "Main.out") is hold
    assert value(resource, "Main.work") == (4 if hold else 0)
    assert "program-error" in resource.journal.derived(ACTIVE)


def test_the_code_word_shows_the_most_serious_and_falls_back() -> None:
    resource = plc(SOURCE)
    generate(resource, "battery-error")
    assert value(resource, "A400") == 0x00F7
    generate(resource, "io-bus-error:rack=1,slot=3", "basic-io-error:rack=0,slot=2")
    assert value(resource, "A400") == 0x80C1
    assert value(resource, "A404") == 0x0103
    resource.submit(Recover("Ada", ("io-bus-error",)))
    assert (value(resource, "A400"), value(resource, "A404")) == (0x009A, 0)
    resource.submit(Recover("Ada", ("basic-io-error",)))
    assert value(resource, "A400") == 0x00F7
    resource.submit(Recover("Ada", None))
    assert error_words(resource) == bytes(96)


def test_after_a_fatal_error_the_way_back_is_a_mode_change() -> None:
    resource = plc(SOURCE)
    generate(resource, "memory-error:io-table-checksum", "fals:number=5")
    refusal = resource.submit(SetMode("Ada", "RUN"))
    assert isinstance(refusal, Refusal)
    assert "fatal" in refusal.message
    resource.submit(Recover("Ada", ("memory-error",)))
    assert resource.header.halt  # the other one still stops it
    assert value(resource, "A400") == 0xC105
    resource.submit(Recover("Ada", None))
    assert resource.header.mode.name == "PROGRAM"
    resource.submit(SetMode("Ada", "MONITOR"))
    resource.run(1)
    assert value(resource, "Main.out") is True


def test_only_again_changes_the_details_of_an_error_that_is_present() -> None:
    resource = plc(SOURCE)
    generate(resource, "basic-io-error:rack=1,slot=3")
    for wanted in ("basic-io-error:rack=1,slot=3", "basic-io-error:rack=0,slot=9"):
        refused = generate(resource, "battery-error", wanted, by="Bob")
        assert isinstance(refused, Refusal)
        assert "basic-io-error: already generated by Ada (rack=1, slot=3)" in refused.message
        assert ("the device has one place for it" in refused.message) is wanted.endswith("9")
        assert refused.near == ("basic-io-error:rack=1,slot=3",)
        assert value(resource, "A402") == 1 << 12  # the battery of the same batch neither
    again = Generate("Bob", (ref("battery-error"), ref("basic-io-error:rack=0,slot=9")), again=True)
    assert isinstance(resource.submit(again), Entry)
    assert (value(resource, "A400"), value(resource, "A408")) == (0x009A, 9)
    assert value(resource, "A402") == 1 << 12 | 1 << 4
    assert resource.view.derived(ACTIVE)["basic-io-error"].by == "Bob"


def test_what_the_plc_found_is_present_for_the_simulator_too() -> None:
    resource = plc(SOURCE)
    resource.submit(Generate("PLC", (ref("program-error:cause=no-end"),), "plc"))
    refused = generate(resource, "program-error:cause=task")
    assert isinstance(refused, Refusal)
    assert "already generated by PLC (cause=no-end" in refused.message
    assert isinstance(resource.submit(Generate("PLC", (ref("program-error:cause=task"),), "plc")), Entry)
    assert value(resource, "A295") == 1 << 12
    assert isinstance(resource.submit(Generate("PLC", (ref("program-error:cause=task"),), "plc")), Refusal)


def test_run_files_of_before_again_still_open() -> None:
    """They have three values where a Generate has four now."""
    refs = (ref("battery-error"),)
    old = codec.pack_body(msgpack.ExtType(1, codec.pack_body(["Generate", "Ada", refs, "program"])))
    assert codec.unpack(old) == Generate("Ada", refs, "program", again=False)
    new = Generate("Ada", refs, again=True)
    assert codec.unpack(codec.pack_body(new)) == new


def test_errors_that_share_a_word_do_not_take_each_other_back() -> None:
    resource = plc(SOURCE)
    generate(resource, "io-bus-error:rack=1,slot=3")
    generate(resource, "no-end-cover")
    resource.submit(Recover("Ada", ("no-end-cover",)))
    assert value(resource, "A401") == 1 << 14
    assert value(resource, "A404") == 0x0103


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("io-bus-error:rack=99", "outside"),
        ("io-bus-error:rack=x", "number"),
        ("io-bus-error:shelf=1", "rack"),
        ("memory-error:coffee", "io-table-checksum"),
        ("memory-eror", "memory-error"),
        ("battery-error:low", "NAME"),
    ],
)
def test_bad_details_are_refused_and_nothing_is_written(text: str, word: str) -> None:
    resource = plc(SOURCE)
    before = bytes(resource.memory)
    found = parse_reference(model(), text)
    if isinstance(found, ErrorRef):
        outcome = resource.submit(Generate("Ada", (ref("battery-error"), found)))
        assert isinstance(outcome, Refusal)
        found = outcome
    assert word in found.message + " ".join(found.near)
    assert bytes(resource.memory) == before


def test_unknown_and_absent_errors_cannot_be_recovered() -> None:
    resource = plc(SOURCE)
    for id in ("battery-eror", "battery-error"):
        assert isinstance(resource.submit(Recover("Ada", (id,))), Refusal)
    twice = resource.submit(Generate("Ada", (ErrorRef("battery-error"), ErrorRef("battery-error"))))
    assert isinstance(twice, Refusal)


def test_the_models_error_log_drops_the_oldest() -> None:
    resource = plc(SOURCE)
    for number in range(1, 24):
        generate(resource, f"fal:number={number}")
        resource.submit(Recover("Ada", None))
    assert value(resource, "A300") == 20
    assert value(resource, "A100") == 0x4100 + 4
    assert value(resource, "A195") == 0x4100 + 23


def test_a_record_of_the_log_shows_the_clock_of_the_plc() -> None:
    resource = plc(SOURCE)
    resource.submit(SetClock("Ada", datetime(2024, 2, 28, 23, 59, 58, tzinfo=UTC)))
    resource.run(301)  # 10 ms each
    generate(resource, "battery-error", "cpu-bus-unit-error:unit=3")
    first, second = ([value(resource, f"A{start + word}") for word in range(5)] for start in (100, 105))
    assert first == [0x00F7, 0, 0x0001, 0x2900, 0x2402]
    assert second == [0x0203, 1 << 3, 0x0001, 0x2900, 0x2402]
    assert first[2:] == [value(resource, f"A{word}") for word in (351, 352, 353)]


IDS = [error.id for error in model().errors()]


@given(st.lists(st.sampled_from(IDS), min_size=1, max_size=6, unique=True), st.randoms(use_true_random=False))
def test_whatever_is_generated_can_be_taken_back_in_any_order(ids: list[str], chance: "st.random.Random") -> None:  # type: ignore[name-defined]
    resource = plc(SOURCE)
    for id in ids:
        assert isinstance(resource.submit(Generate("Ada", (ErrorRef(id),))), Entry)
    chance.shuffle(ids)
    coded = {error.id for error in model().errors() if error.coded}
    for done, id in enumerate(ids):
        assert bool(value(resource, "A400")) is any(left in coded for left in ids[done:])
        assert isinstance(resource.submit(Recover("Ada", (id,))), Entry)
    assert error_words(resource) == bytes(96)
    assert not resource.header.halt


def test_history_rows() -> None:
    resource = plc(SOURCE)
    history = History(model())
    assert {row.status for row in history.rows} == {"never"}
    assert [row.id for row in history.rows] == IDS
    for command in (
        Generate("Ada", (ref("memory-error:io-table-checksum"), ref("battery-error"))),
        Recover("Bob", ("battery-error",)),
        Generate("Bob", (ref("battery-error"),)),
        Recover("Bob", None),
        Force("Bob", "Main.n", "1"),
    ):
        entry = resource.submit(command)
        assert isinstance(entry, Entry)
        history.fold(entry)
    rows = {row.id: row for row in history.rows}
    battery, memory = rows["battery-error"], rows["memory-error"]
    assert (battery.status, battery.count, battery.by, battery.code) == ("cleared", 2, "Bob", "00F7")
    assert (memory.status, memory.count, memory.by, memory.code) == ("cleared", 1, "Ada", "80F4")
    assert memory.details == "location=io-table-checksum"
    assert memory.recovered_at is not None
    assert rows["fal"].status == "never"


def test_an_acknowledgement_is_of_the_time_that_was_seen() -> None:
    """Between what a client of OPC UA saw and its acknowledgement the error may have come again."""
    resource = plc("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM", model_name="CJ1M-CPU13")
    nothing = resource.submit(Acknowledge("Ada", "battery-error", ""))
    assert isinstance(nothing, Refusal)
    assert "was not raised" in nothing.message
    for scan in (0, 1):
        assert isinstance(resource.submit(Generate("Ada", (ErrorRef("battery-error"),))), Entry)
        resource.run(1)
        assert isinstance(resource.submit(Recover("Ada", ("battery-error",))), Entry), scan
    late = resource.submit(Acknowledge("Ada", "battery-error", "", raised=0))
    assert isinstance(late, Refusal)
    assert "raised again before scan 1: what was acknowledged was raised before scan 0" in late.message
    assert isinstance(resource.submit(Acknowledge("Ada", "battery-error", "", raised=1)), Entry)
    assert isinstance(resource.submit(Acknowledge("Ada", "battery-error", "")), Entry)


def test_an_acknowledgement_of_one_unit_is_of_that_unit() -> None:
    resource = plc("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM", model_name="CJ1M-CPU13")
    assert isinstance(resource.submit(Generate("Ada", (named_reference("fal:number=5"),))), Entry)
    assert isinstance(resource.submit(Acknowledge("Ada", "fal:number=5", "", raised=0)), Entry)
    other = resource.submit(Acknowledge("Ada", "fal:number=6", ""))
    assert isinstance(other, Refusal)
