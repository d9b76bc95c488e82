"""The device's own view of its errors: decoded from its memory, whoever wrote that."""

from datetime import UTC, datetime

import pytest

from scanbench.check.build import check_sources
from scanbench.faults.clear import ClearErrorLog, ClearErrors
from scanbench.faults.details import choose
from scanbench.faults.device import Watched, read_device
from scanbench.faults.device_shapes import DeviceError
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.user_errors import extended
from scanbench.runtime.command import Refusal
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.set_clock import SetClock
from tests.faults.test_detect import done, plc
from tests.faults.test_instructions import go, set_to
from tests.faults.test_models import MODELS, SOURCE, every_choice
from tests.runtime.bench import ENGINES, model, value

SAYS = """
PROGRAM Main
VAR n, alarm : INT; level : UINT; code : DWORD; there : BOOL; END_VAR
  IF n > 0 THEN FAL(N := n, S := 'PUMP HOT'); END_IF;
  IF n > 100 THEN FALS(N := 9, S := 'NO WATER'); END_IF;
  IF n = 5 THEN MSG(2, 'TANK FULL'); END_IF;
END_PROGRAM
"""
ALARMS = """
PROGRAM Main
VAR alarm, clear : DINT; level : USINT; code : UINT; motion : DWORD; there : BOOL; END_VAR
  IF alarm > 0 THEN SetAlarm(alarm); END_IF;
  there := GetAlarm(Level => level, Code => code);
  GetMCError(Code => motion);
  IF clear > 0 THEN ResetAlarm(clear); END_IF;
END_PROGRAM
"""


def write_word(resource: Resource, address: str, word: int) -> None:
    """Without any command, as if the device itself had."""
    place = resource.view.model.locate(address)
    assert place is not None
    start = resource.program.layout.areas[place.area.name] + place.byte
    resource.memory[start : start + 2] = word.to_bytes(2, "little")


def shown(resource: Resource) -> list[tuple[str, str, dict[str, str]]]:
    errors = read_device(resource.view).errors
    return [(each.id, each.code, {detail.name: detail.value for detail in each.details}) for each in errors]


def only(resource: Resource) -> DeviceError:
    (error,) = read_device(resource.view).errors
    return error


@pytest.mark.parametrize("name", [name for name in MODELS if not name.startswith("CJ1M") or name == "CJ1M-CPU63"])
def test_every_error_of_a_model_is_read_back_with_its_details(name: str) -> None:
    resource = plc(SOURCE, model_name=name)
    for error in model(name).errors():
        for given in every_choice(error):
            done(resource, Generate("Ada", (ErrorRef(error.id, tuple(given.items())),)))
            chosen = choose(error, given, resource.program.layout)
            assert not isinstance(chosen, Refusal)
            details = {detail: value for detail, value in chosen.details if value}
            assert shown(resource) == [(error.id, chosen.code_text, details)]
            device = read_device(resource.view)
            assert [each.top for each in device.errors] == [device.code == chosen.code_text]
            if device.has_log and error.coded:
                assert (device.log[0].id, device.log[0].code) == (error.id, chosen.code_text)
            done(resource, Recover("Ada", None))
            assert read_device(resource.view).errors == ()


def test_units_that_the_memory_shows_together_are_an_error_each() -> None:
    resource = plc(SOURCE)
    write_word(resource, "A402", 1 << 6)
    write_word(resource, "A418", 1 << 3)
    write_word(resource, "A419", 1 << 4)
    assert shown(resource) == [
        ("special-io-unit-error", "0303", {"unit": "3"}),
        ("special-io-unit-error", "0314", {"unit": "20"}),
    ]


def test_a_word_that_several_errors_write_is_a_detail_of_the_one_with_the_code() -> None:
    """SD5 and SD6 say which module the error in SD0 is about; what else is present only has its bit."""
    resource = plc(SOURCE, model_name="Q03UD")
    fuse = (("module", "2"), ("io-number", "20"), ("module-bit", "4"))
    module = (("module", "1"), ("io-number", "10"), ("module-bit", "7"))
    done(resource, Generate("Ada", (ErrorRef("unit-verify-error", module), ErrorRef("fuse-break", fuse))))
    assert {name: value(resource, name) for name in ("SD0", "SD5", "SD6")} == {"SD0": 1300, "SD5": 2, "SD6": 0x20}
    assert shown(resource) == [
        ("fuse-break", "1300", dict(fuse)), ("unit-verify-error", "2000", {"module-bit": "7"}),
    ]  # fmt: skip


def test_a_flag_that_nothing_explains_is_shown_all_the_same() -> None:
    resource = plc(SOURCE, model_name="NJ501-1300")
    write_word(resource, "_MC_ErrSta", 1 << 5)
    error = only(resource)
    assert (error.id, error.code, error.severity, error.flag) == ("", "", "nonfatal", "_MC_ErrSta.05")
    assert "_MC_ErrSta.05" in error.name


@pytest.mark.parametrize("engine", ENGINES)
def test_what_the_program_says_comes_with_its_errors(engine: EngineFactory) -> None:
    resource = plc(SAYS, engine)
    done(resource, SetClock("Ada", datetime(2026, 11, 24, 10, 15, 2, tzinfo=UTC)))
    set_to(resource, n=5)
    go(resource, 1)
    device = read_device(resource.view)
    assert [(each.code, each.text) for each in device.errors] == [("4105", "PUMP HOT")]
    assert [(each.instruction, each.number, each.text) for each in device.messages] == [("MSG", 2, "TANK FULL")]
    assert (device.log[0].time, device.log[0].text) == ("2026-11-24 10:15:02", "PUMP HOT")
    set_to(resource, n=101)
    go(resource, 1)
    assert [(each.code, each.severity, each.text) for each in read_device(resource.view).errors] == [
        ("C109", "fatal", "NO WATER"),
        ("4105", "nonfatal", "PUMP HOT"),
        ("4165", "nonfatal", "PUMP HOT"),
    ]
    done(resource, ClearErrors("tool", "all"))
    done(resource, SetMode("tool", "RUN"))
    assert read_device(resource.view).errors == ()


def test_the_log_is_read_newest_first_and_a_tool_empties_it() -> None:
    resource = plc(SAYS)
    for number in range(1, 26):
        set_to(resource, n=number)
        go(resource, 1)
    log = read_device(resource.view).log
    assert [each.code for each in log] == [f"{0x4100 + number:04X}" for number in range(25, 5, -1)]
    assert [each.number for each in log] == list(range(20, 0, -1))
    assert {detail.text for detail in log[0].details} == {"FAL number: 25"}
    done(resource, ClearErrorLog("tool"))
    assert read_device(resource.view).log == ()


def test_a_record_with_nonsense_has_no_time_and_no_name() -> None:
    resource = plc(SOURCE)
    write_word(resource, "A300", 1)
    for number, word in enumerate((0x7777, 0x0012, 0xFFFF, 0x3131, 0x9912)):
        write_word(resource, f"A{100 + number}", word)
    (record,) = read_device(resource.view).log
    assert (record.code, record.contents, record.time, record.id, record.severity) == ("7777", "0012", "", "", None)


def test_a_model_that_keeps_only_the_latest_error() -> None:
    resource = plc(SOURCE, model_name="Q03UD")
    done(resource, SetClock("Ada", datetime(2026, 11, 24, 10, 15, 2, tzinfo=UTC)))
    device = read_device(resource.view)
    assert (device.has_log, device.keeps_latest, device.log) == (False, True, ())
    done(resource, Generate("Ada", (ErrorRef("battery-error"),)))
    (record,) = read_device(resource.view).log
    assert (record.code, record.time) == ("1600", "2026-11-24 10:15:02")


def test_an_error_of_the_project_that_the_program_itself_shows() -> None:
    xml = """<UserErrors><ErrorGroup><Name>Pumps</Name>
      <Error Id="pump-hot" ErrorCode="4101" ErrorFlag="W10.00" Severity="nonfatal" Priority="300"><Name>Pump hot</Name></Error>
    </ErrorGroup></UserErrors>"""
    source = "PROGRAM Main\nVAR hot AT W10.00 : BOOL; END_VAR\n  hot := TRUE;\nEND_PROGRAM\n"
    own, problems = extended(model(), {"errors.xml": xml})
    assert problems == []
    checked = check_sources({"main.st": source, "errors.xml": xml}, own)
    assert checked.program is not None
    resource = Resource(Loaded.make(checked.program, ENGINES[0]))
    resource.run(1)
    assert (only(resource).id, only(resource).name) == ("pump-hot", "Pump hot")


@pytest.mark.parametrize("engine", ENGINES)
def test_event_codes_of_eight_digits_are_kept_for_each_part(engine: EngineFactory) -> None:
    resource = plc(ALARMS, engine, "NJ501-1300")
    done(resource, Generate("Ada", (ErrorRef("following-error-limit"), ErrorRef("task-period-exceeded"))))
    set_to(resource, alarm=12345)
    go(resource, 2)
    assert shown(resource) == [
        ("task-period-exceeded", "60010000", {}),
        ("following-error-limit", "64480000", {}),
        ("user-fault-level-3", "00003039", {"number": "12345"}),
    ]
    assert [value(resource, f"Main.{each}") for each in ("there", "level", "code", "motion")] == [
        True, 3, 12345, 0x6448_0000,
    ]  # fmt: skip
    set_to(resource, alarm=0, clear=12345)
    go(resource, 2)
    assert [id for id, _, _ in shown(resource)] == ["task-period-exceeded", "following-error-limit"]
    assert value(resource, "Main.there") is False


def test_only_what_is_read_counts_as_a_change() -> None:
    resource = plc(SAYS)
    watched = Watched(resource.program.layout)
    assert watched.changed(resource.memory)
    write_word(resource, "D100", 7)
    assert not watched.changed(resource.memory)
    for address in ("A400", "A402", "A418", "A100", "A300", "MSGTEXT0"):
        write_word(resource, address, 1)
        assert watched.changed(resource.memory), address
