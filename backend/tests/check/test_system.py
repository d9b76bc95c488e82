"""What every model adds to programs: it can be checked, runs the same on both engines, and agrees with another reckoning."""

from datetime import UTC, datetime, timedelta

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.engine import Reason
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.pair import PairEngine
from scanbench.plcmodel.model import Model, Special
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.symbols import resolve
from tests.caseformat import MODELS

EPOCH = datetime(2023, 12, 31, 23, 59, 59, 500_000, UTC)
START = datetime(1970, 1, 1, tzinfo=UTC)


def built(model: Model, body: str, declared: str = "") -> Program:
    source = f"PROGRAM Main\nVAR x : INT; {declared} END_VAR\n{body}\nx := x + 1;\nEND_PROGRAM"
    checked = check_sources({"main.st": source}, model, 7_000_000)
    assert checked.program is not None, checked.problems
    return checked.program


def word(program: Program, memory: bytearray, special: Special) -> int:
    at = program.layout.areas[special.location.area.name] + special.location.byte
    if special.location.bit is not None:
        return memory[at] >> special.location.bit & 1
    size = len(special.fields) if special.role == "clock" else special.location.bits // 8
    return int.from_bytes(memory[at : at + size], "little")


def expected(special: Special, scan: int, interval_ns: int, now: datetime) -> int | None:
    clock = scan * interval_ns
    match special.role:
        case "on" | "off":
            return int(special.role == "on")
        case "first-cycle":
            return int(scan == 0)
        case "pulse":
            return int(clock % special.period_ns * 2 >= special.period_ns)
        case "cycle-time" | "longest-cycle-time" | "shortest-cycle-time":
            return min(interval_ns // special.unit_ns, (1 << special.location.bits) - 1)
        case "scan-count":
            return scan % (1 << special.location.bits)
        case "clock":
            fields = {
                "second": now.second, "minute": now.minute, "hour": now.hour, "day": now.day, "month": now.month,
                "year": now.year % 100, "century": now.year // 100, "weekday": now.isoweekday() % 7, "zero": 0,
            }  # fmt: skip
            made = [fields[each] for each in special.fields]
            if special.bcd:
                made = [int(str(each), 16) for each in made]
            return int.from_bytes(bytes(made), "little")
    return None


@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS.keys())
def test_system_words_of_every_model(model: Model) -> None:
    program = built(model, "")
    assert bool(program.common) == any(each.role for each in model.specials)
    memory = bytearray(program.initial_image)
    epoch = int((EPOCH - START).total_seconds()) * 1_000_000_000 + 500_000_000
    memory[Layout.EPOCH : Layout.EPOCH + 8] = epoch.to_bytes(8, "little")
    native = NativeEngine(program, memory)
    for scan in (0, 1, 2, 70, 71, 143, 1234, 100_000, 1_234_567):
        native.run(scan - int.from_bytes(memory[Layout.SCAN : Layout.SCAN + 8], "little"))
        assert PairEngine(program, memory).run(1).reason is Reason.DONE
        now = EPOCH + timedelta(milliseconds=7 * scan)
        for special in model.specials:
            wanted = expected(special, scan, 7_000_000, now)
            if wanted is not None:
                assert word(program, memory, special) == wanted, (scan, special.name)


@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS.keys())
def test_symbols_of_every_model(model: Model) -> None:
    """Each is a variable of its width, for programs and for a watch, at the same place."""
    for special in model.specials:
        if not special.symbol:
            continue
        types = {1: "BOOL", 8: "BYTE", 16: "WORD", 32: "DWORD", 64: "LWORD"}
        program = built(model, f"v := {special.symbol};", f"v : {types[special.location.bits]};")
        symbol = resolve(program, special.symbol)
        offset = program.layout.areas[special.location.area.name] + special.location.byte
        assert (symbol.offset, symbol.bit) == (offset, special.location.bit)


INSTRUCTIONS = [(model, number) for model in MODELS.values() for number in range(len(model.instructions))]


@pytest.mark.parametrize(
    ("model", "number"), INSTRUCTIONS, ids=[f"{m.name}-{m.instructions[n].name}" for m, n in INSTRUCTIONS]
)
def test_instructions_of_every_model(model: Model, number: int) -> None:
    made = model.instructions[number]
    entry = model.error(made.error)
    assert entry is not None
    program = built(model, f"done := {made.name}({made.parameter} := {made.maximum});", "done : BOOL;")
    memory = bytearray(program.initial_image)
    stop = PairEngine(program, memory).run(1)
    assert int.from_bytes(memory[Layout.ASKED_COUNT : Layout.ASKED_COUNT + 4], "little") == 1
    asked = int.from_bytes(memory[Layout.ASKED : Layout.ASKED + 8], "little")
    assert (asked & 0xFFFF_FFFF, asked >> 32) == (number, made.maximum)
    at = program.layout.areas[entry.flag.area.name] + entry.flag.byte
    assert entry.flag.bit is not None
    assert memory[at] >> entry.flag.bit & 1
    if entry.severity == "fatal":
        site = program.traps[stop.trap - 1]
        assert (stop.reason, site.kind.value, site.span.line) == (Reason.TRAP, "fatal", 3)
        assert site.message == f"{made.name} stops the PLC"
    else:
        assert stop.reason is Reason.ASKED
        assert resolve(program, "Main.done").locate(memory) is not None
    most = max(each.maximum for each in model.instructions if each.name == made.name)
    wrong = built(model, f"done := {made.name}({most + 1});", "done : BOOL := TRUE;")
    memory = bytearray(wrong.initial_image)
    assert PairEngine(wrong, memory).run(1).reason is Reason.DONE
    assert memory[resolve(wrong, "Main.done").offset] == 0


def test_the_same_model_makes_the_same_text_once() -> None:
    first, second = (built(MODELS["CJ1M-CPU63"], "") for _ in range(2))
    assert first.common[0].pou.span is second.common[0].pou.span
    assert first.common[0].offset == second.common[0].offset


def test_an_instruction_with_what_it_does_not_take() -> None:
    source = "PROGRAM Main\nFAL(M := 5);\nFAL();\nFAL(1.5);\nFALS(1, 2, 3);\nFALS(1, 2, 3, 4);\nEND_PROGRAM"
    problems = check_sources({"main.st": source}, MODELS["CJ1M-CPU63"]).problems
    assert [(each.code, each.span.line) for each in problems] == [("T004", 2), ("T004", 3), ("T002", 4), ("T004", 6)]
