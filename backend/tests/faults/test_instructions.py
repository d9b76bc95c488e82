"""FAL, FALS and their like: what the program asks for becomes an error of the catalogue, once."""

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.engine import Reason
from scanbench.faults.detect import Detection
from scanbench.faults.history import ErrorRow, History
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.host.build import all_models
from scanbench.recording.replay import replay
from scanbench.runtime.detect import Asked
from scanbench.runtime.header import Halt, Mode
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.trap import Trapped
from scanbench.runtime.write import Write
from tests.faults.test_detect import done, plc
from tests.faults.test_models import bits
from tests.runtime.bench import ENGINES, model, value

SOURCE = """
VAR_GLOBAL motor AT CIO 100.00 : BOOL; END_VAR
PROGRAM Main
VAR n : INT; first, second, fatal, i : INT; ok : BOOL; before, after : INT; work AT W0 : INT; END_VAR
  n := n + 1; motor := TRUE; work := n;
  ok := FAL(first);
  IF second <> 0 THEN FAL(N := second); END_IF;
  IF fatal < 0 THEN FOR i := 100 TO 150 DO FAL(i); END_FOR; END_IF;
  before := n;
  IF fatal <> 0 THEN FALS(ABS(fatal)); END_IF;
  after := n;
END_PROGRAM
"""


def go(resource: Resource, scans: int) -> list[Reason]:
    """Runs so many scans, or to where it stops; why the engine came back on the way."""
    reasons, end = [], resource.header.scan + scans
    while resource.runnable and resource.header.scan < end:
        reasons.append(resource.run(end - resource.header.scan).reason)
    return reasons


def set_to(resource: Resource, **values: int) -> None:
    for name, number in values.items():
        done(resource, Write("Ada", f"Main.{name}", str(number)))


def generated(resource: Resource) -> list[str]:
    return [entry.plan.message for entry in resource.journal if isinstance(entry.command, Generate)]


def row(resource: Resource, key: str) -> ErrorRow:
    history = History(model())
    for entry in resource.journal:
        history.fold(entry)
    return next(row for row in history.rows if row.key == key)


@pytest.mark.parametrize("engine", ENGINES)
def test_an_error_that_the_program_raises_in_every_scan_is_one_error(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    set_to(resource, first=9)
    assert go(resource, 100) == [Reason.ASKED, Reason.DONE]
    assert [value(resource, word) for word in ("A400", "A401", "A402", "A360", "A300")] == [
        0x4109,
        0,
        1 << 15,
        1 << 9,
        1,
    ]
    assert generated(resource) == ["generated fal (number=9), code 4109"]
    assert resource.runnable
    found = row(resource, "fal:number=9")
    assert (found.origin, found.by, found.count, found.generated_scan) == ("program", "program", 1, 1)


@pytest.mark.parametrize("engine", ENGINES)
def test_numbers_are_present_together(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    set_to(resource, first=40, second=3)
    assert go(resource, 50) == [Reason.ASKED, Reason.DONE]
    assert [value(resource, word) for word in ("A400", "A360", "A362")] == [0x4103, 1 << 3, 1 << 8]
    assert len(generated(resource)) == 2
    done(resource, Recover("Ada", ("fal",)))
    assert [value(resource, word) for word in ("A400", "A402", "A360", "A362")] == [0, 0, 0, 0]
    go(resource, 50)  # the cause is still there, so the device shows it again at once
    assert value(resource, "A400") == 0x4103
    assert [row(resource, f"fal:number={number}").count for number in (3, 40)] == [2, 2]


@pytest.mark.parametrize("engine", ENGINES)
def test_the_program_clears_its_error(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    set_to(resource, first=7)
    go(resource, 5)
    set_to(resource, first=0)  # FAL(0)
    assert go(resource, 20) == [Reason.ASKED, Reason.DONE]
    assert [value(resource, word) for word in ("A400", "A402", "A360")] == [0, 0, 0]
    assert value(resource, "Main.ok") is True
    seven = row(resource, "fal:number=7")
    assert (seven.status, seven.recovered_scan, seven.count) == ("cleared", 6, 1)
    set_to(resource, second=3)  # FAL(0); FAL(3); in one scan: both, in this order
    go(resource, 3)
    assert value(resource, "A400") == 0x4103
    assert row(resource, "fal:number=3").count == 3


def test_a_number_that_it_does_not_take() -> None:
    resource = plc(SOURCE)
    before = value(resource, "A402")
    for number in (512, -1):
        set_to(resource, first=number)
        assert go(resource, 3) == [Reason.DONE]
        assert (value(resource, "Main.ok"), value(resource, "A402")) == (False, before)


def test_what_somebody_generated_is_no_news() -> None:
    resource = plc(SOURCE)
    done(resource, Generate("Ada", (ErrorRef("fal", (("number", "9"),)),)))
    set_to(resource, first=9)
    assert go(resource, 10) == [Reason.DONE]
    assert row(resource, "fal:number=9").origin == "simulator"


@pytest.mark.parametrize("engine", ENGINES)
def test_a_fatal_instruction_stops_right_there(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    go(resource, 4)
    set_to(resource, fatal=5)
    go(resource, 10)
    assert [value(resource, word) for word in ("A400", "A401", "A100", "A300")] == [0xC105, 1 << 6, 0xC105, 1]
    assert (value(resource, "Main.before"), value(resource, "Main.after"), resource.header.scan) == (5, 4, 4)
    assert (value(resource, "motor"), value(resource, "Main.work")) == (
        True,
        5,
    )  # FALS keeps the memory, that of the outputs too
    trap = resource.trap
    assert trap is not None
    assert (trap.kind, SOURCE.splitlines()[trap.line - 1].strip()[:16]) == ("fatal", "IF fatal <> 0 TH")
    assert [type(entry.command) for entry in resource.journal][1:] == [Trapped, Generate]
    fals = row(resource, "fals:number=5")
    assert (fals.origin, fals.code) == ("program", "C105")
    done(resource, Recover("Ada", None))
    assert (resource.header.halt, resource.header.mode, resource.trap) == (Halt.NONE, Mode.PROGRAM, None)
    set_to(resource, fatal=0)
    done(resource, SetMode("Ada", "RUN"))
    go(resource, 3)
    assert (value(resource, "Main.after"), resource.header.scan) == (8, 7)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_fatal_instruction_gets_through_when_much_was_asked(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    set_to(resource, fatal=-6)
    go(resource, 1)
    assert value(resource, "A400") == 0xC106
    assert len(generated(resource)) == 16
    done(resource, Recover("Ada", None))
    assert [value(resource, word) for word in ("A400", "A401", "A402", "A366", "A368")] == [0, 0, 0, 0, 0]


def test_a_replay_crosses_all_of_it() -> None:
    resource = plc(SOURCE)
    for values in ({"first": 3}, {"second": 9}, {"first": 0}, {"fatal": 2}):
        set_to(resource, **values)
        go(resource, 7)
    done(resource, Restart("Ada", "power"))
    go(resource, 5)
    for engine in ENGINES:
        again = plc(SOURCE, engine)
        replay(again, resource.journal, resource.header.scan)
        assert again.state == resource.state
        assert len(again.journal) == len(resource.journal)


def test_asking_for_what_is_there_or_unknown_changes_nothing() -> None:
    resource = plc(SOURCE)
    detect, view = Detection(), resource.view
    assert detect.on_asked((Asked(99, 1), Asked(0, 0)), view) == ()
    one = Generate("program", (ErrorRef("fal", (("number", "4"),)),), "program")
    assert detect.on_asked((Asked(0, 4), Asked(0, 4)), view) == (one,)
    assert detect.on_asked((Asked(0, 4), Asked(0, 0), Asked(0, 4)), view) == (
        one,
        Recover("program", ("fal",), way="program"),
        one,
    )
    done(resource, one)
    assert detect.on_asked((Asked(0, 4),), resource.view) == ()


def test_the_log_reset_bit() -> None:
    resource = plc(SOURCE)
    for _ in range(3):
        done(resource, Generate("Ada", (ErrorRef("battery-error"),)))
        done(resource, Recover("Ada", None))
    done(resource, Write("Ada", "A500.14", "TRUE"))
    go(resource, 1)
    assert (value(resource, "A300"), value(resource, "A500.14")) == (0, False)
    done(resource, Generate("Ada", (ErrorRef("battery-error"),)))
    assert (value(resource, "A300"), value(resource, "A100")) == (1, 0xF7)


MODELS = {each.name: each for each in all_models()[0]}
INSTRUCTIONS = [(name, made.name) for name, each in MODELS.items() for made in each.instructions]


@pytest.mark.parametrize(("name", "instruction"), INSTRUCTIONS)
def test_every_instruction_of_every_model(name: str, instruction: str) -> None:
    made = next(each for each in MODELS[name].instructions if each.name == instruction)
    error = MODELS[name].error(made.error)
    assert error is not None
    source = f"PROGRAM Main\nVAR n : INT; END_VAR\n  {instruction}(n);\nEND_PROGRAM\n"
    resource = plc(source, model_name=name)
    for count, number in enumerate((made.minimum, min(made.maximum, 32767)), 1):
        if resource.header.mode is Mode.PROGRAM:
            done(resource, SetMode("Ada", "MONITOR"))
        set_to(resource, n=number)
        go(resource, 4)
        assert bits(resource, error.flag) == 1
        assert len(generated(resource)) == count
        assert resource.runnable is (error.severity == "nonfatal")
        set_to(resource, n=0 if made.clears is None else made.clears)
        if made.clears is None or error.severity == "fatal":
            done(resource, Recover("Ada", None))
        else:
            go(resource, 2)
        assert bits(resource, error.flag) == 0


def test_a_number_cannot_be_left_out() -> None:
    for call in ("FAL()", "FAL(M := 1)", "FALS()"):
        checked = check_sources({"main.st": f"PROGRAM Main\n  {call};\nEND_PROGRAM\n"}, model())
        assert [problem.code for problem in checked.problems] == ["T004"], call
