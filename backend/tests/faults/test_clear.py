"""The device's own ways to clear errors: tools, FAL 0, SM50, ResetPLCError, the log reset; and what does not clear."""

import pytest

from scanbench.faults.clear import WILL_NOT_CLEAR, ClearErrorLog, ClearErrors
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.reference import ErrorRef, parse_reference
from scanbench.recording.replay import replay
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.header import Mode
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.wire import codec
from scanbench.wire import host as protocol
from tests.faults.test_detect import done, plc
from tests.faults.test_instructions import generated, go, row, set_to
from tests.runtime.bench import ENGINES, value

OMRON = """
VAR_GLOBAL motor AT CIO 100.00 : BOOL; END_VAR
PROGRAM Main
VAR n, number, m, m1, fatal : DINT; set : INT; clear, ok : BOOL; work AT W0 : INT; END_VAR
  n := n + 1; motor := TRUE; work := 1;
  IF set > 0 THEN FAL(set); FAL(set + 1); END_IF;
  IF clear THEN ok := FAL(N := 0, M := m); END_IF;
  IF number <> 0 THEN ok := FAL(N := number, M := m, M1 := m1); END_IF;
  IF fatal <> 0 THEN ok := FALS(N := fatal, M := m, M1 := m1); END_IF;
END_PROGRAM
"""
CALM = "PROGRAM Main\nVAR n : INT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"


def raise_(resource: Resource, *texts: str, origin: str = "simulator") -> None:
    refs = tuple(parse_reference(resource.view.model, text) for text in texts)
    assert all(isinstance(ref, ErrorRef) for ref in refs), refs
    done(resource, Generate("Ada", refs, origin))  # type: ignore[arg-type]


def present(resource: Resource) -> list[str]:
    active = resource.view.derived(ACTIVE)
    return list(active)


def words(resource: Resource, *names: str) -> list[object]:
    return [value(resource, name) for name in names]


# ---- a tool -------------------------------------------------------------------------------------------------------


def test_a_tool_clears_what_has_no_lasting_cause() -> None:
    resource = plc(CALM)
    raise_(resource, "fal:number=5", "interrupt-task-error")
    done(resource, ClearErrors("tool", "current"))
    assert (present(resource), value(resource, "A400")) == (["interrupt-task-error"], 0x008B)
    done(resource, ClearErrors("tool", 0x008B))
    assert (present(resource), value(resource, "A400"), value(resource, "A426")) == ([], 0, 0)
    assert done(resource, ClearErrors("tool", "all")).plan.message == "no error is present"


def test_an_error_whose_cause_lasts_will_not_clear() -> None:
    resource = plc(CALM)
    raise_(resource, "battery-error", "fal:number=5")
    before = bytes(resource.memory)
    for what in (0x00F7, "current"):
        if what == "current":
            done(resource, ClearErrors("tool", "all"))  # FAL goes, the battery stays
            assert (present(resource), value(resource, "A400")) == (["battery-error"], 0x00F7)
            before = bytes(resource.memory)
        refusal = resource.submit(ClearErrors("tool", what))
        assert isinstance(refusal, Refusal)
        assert refusal.message.startswith(WILL_NOT_CLEAR)
        assert "battery-error" in refusal.message
        assert refusal.near == ("battery-error",)
        assert bytes(resource.memory) == before
    done(resource, Recover("Ada", ("battery-error",)))
    assert value(resource, "A400") == 0


def test_a_code_that_is_not_there() -> None:
    resource = plc(CALM)
    raise_(resource, "fal:number=5")
    refusal = resource.submit(ClearErrors("tool", 0x4106))
    assert isinstance(refusal, Refusal)
    assert "4106" in refusal.message
    assert refusal.near == ("fal",)


def test_after_a_fatal_error_the_tool_clears_and_the_mode_is_program() -> None:
    resource = plc(CALM)
    raise_(resource, "fals:number=9")
    done(resource, ClearErrors("tool", "all"))
    assert (resource.header.mode, resource.header.halt, value(resource, "A401")) == (Mode.PROGRAM, 0, 0)
    done(resource, SetMode("tool", "RUN"))


def test_the_journal_says_what_went_and_a_replay_knows_it() -> None:
    resource = plc(OMRON)
    set_to(resource, set=7)
    go(resource, 2)
    set_to(resource, set=0)
    entry = done(resource, ClearErrors("tool", 0x4107))
    assert isinstance(entry.command, Recover)
    assert entry.command.author == "tool"
    assert entry.plan.message == "cleared by the tool: fal (number=7)"
    assert (value(resource, "A400"), value(resource, "A402"), value(resource, "A360")) == (0x4108, 1 << 15, 1 << 8)
    assert [row(resource, f"fal:number={each}").status for each in (7, 8)] == ["cleared", "generated"]
    done(resource, ClearErrors("tool", 0x4108))
    assert row(resource, "fal:number=8").status == "cleared"
    go(resource, 3)
    for engine in ENGINES:
        again = plc(OMRON, engine)
        replay(again, [_packed(each) for each in resource.journal], resource.header.scan)
        assert again.state == resource.state
        assert present(again) == []


def _packed(entry: Entry) -> Entry:
    return codec.ENTRIES.unpack(codec.ENTRIES.pack(entry))


@pytest.mark.parametrize("command", [ClearErrors("a", "all"), ClearErrors("a", 3), ClearErrorLog("a")])
def test_they_go_to_a_different_process(command: Command) -> None:
    assert codec.unpack(codec.pack_body(command)) == command


def test_the_log_is_cleared_by_a_tool() -> None:
    resource = plc(CALM)
    raise_(resource, "battery-error", "fal")
    assert value(resource, "A300") == 2
    done(resource, ClearErrorLog("tool"))
    assert (value(resource, "A300"), value(resource, "A100"), present(resource)) == (
        0,
        0x00F7,
        ["battery-error", "fal"],
    )
    refusal = plc(CALM, model_name="Q03UD").submit(ClearErrorLog("tool"))
    assert isinstance(refusal, Refusal)
    assert "Q03UD" in refusal.message


# ---- FAL 0 --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("m", "left", "code"),
    [
        (8, ["battery-error", "interrupt-task-error", "fal"], 0x4109),
        (9, ["battery-error", "interrupt-task-error", "fal"], 0x4108),
        (77, ["battery-error", "interrupt-task-error", "fal"], 0x4108),
        (0xFFFF, ["battery-error"], 0x00F7),
        (0x0200, ["battery-error", "interrupt-task-error", "fal"], 0x4109),
        (-1, ["battery-error", "interrupt-task-error"], 0x008B),
    ],
)
def test_fal_0(engine: EngineFactory, m: int, left: list[str], code: int) -> None:
    """One number; all that are not fatal; the most serious of them; without M all FAL."""
    resource = plc(OMRON, engine)
    raise_(resource, "battery-error", "interrupt-task-error")
    set_to(resource, set=8)  # FAL 8 and FAL 9
    go(resource, 1)
    set_to(resource, set=0, clear=1, m=m)
    go(resource, 1)
    set_to(resource, clear=0)
    go(resource, 5)
    assert (present(resource), value(resource, "A400")) == (left, code)
    assert value(resource, "Main.ok") is True


def test_fal_0_leaves_what_it_does_not_take() -> None:
    resource = plc(OMRON)
    raise_(resource, "interrupt-task-error")
    set_to(resource, clear=1, m=0x10000)
    go(resource, 2)
    assert (value(resource, "Main.ok"), value(resource, "A400")) == (False, 0x008B)


# ---- errors of the system by FAL and FALS -------------------------------------------------------------------------


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("code", "information", "memory"),
    [
        (0x00F7, 0, {"A402": 1 << 4}),
        (0x009A, 0x0203, {"A402": 1 << 12, "A408": 0x0203}),
        (0x009B, 0x1234, {"A402": 1 << 10, "A406": 0x1234}),
        (0x0203, 0, {"A402": 1 << 7, "A417": 1 << 3}),
        (0x0310, 0, {"A402": 1 << 6, "A419": 1}),
        (0x008B, 0x8005, {"A402": 1 << 13, "A426": 0x8005}),
    ],
)
def test_fal_raises_an_error_of_the_system(
    engine: EngineFactory, code: int, information: int, memory: dict[str, int]
) -> None:
    resource = plc(OMRON, engine)
    done(resource, Write("Ada", "A529", "100"))
    set_to(resource, number=100, m=code, m1=information)
    go(resource, 20)
    assert value(resource, "A400") == code
    for word, expected in memory.items():
        assert value(resource, word) == expected, word
    assert (value(resource, "A360"), value(resource, "A366"), value(resource, "A300")) == (0, 0, 1)
    assert (len(generated(resource)), resource.runnable) == (1, True)
    set_to(resource, number=0, clear=1, m=0xFFFF)  # its cause is the program's
    go(resource, 2)
    assert [value(resource, word) for word in ("A400", *memory)] == [0] * (1 + len(memory))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("code", "information", "memory"),
    [
        (0x80F1, 1 << 5, {"A401": 1 << 15, "A403": 1 << 5, "A101": 1 << 5}),
        (0x80F1, 0x0030, {"A401": 1 << 15, "A403": 0x0030, "A101": 0x0030}),
        (0x80F1, 0x8002, {"A401": 1 << 15, "A403": 0x8002, "A101": 0x8002}),  # bits that no choice has
        (0x80C1, 0x0103, {"A401": 1 << 14, "A404": 0x0103}),
        (0x80CE, 0x0E0E, {"A401": 1 << 14, "A404": 0x0E0E}),
        (0x80E9, 0x000F, {"A401": 1 << 13, "A410": 1 << 15, "A411": 0}),
        (0x80E9, 0x8012, {"A401": 1 << 13, "A410": 0, "A412": 1 << 2}),
        (0x80EA, 1, {"A401": 1 << 13, "A409": 2}),
        (0x80E1, 0xA007, {"A401": 1 << 11, "A407": 0xA007}),
        (0x80E0, 0, {"A401": 1 << 10}),
        (0x80F0, 1 << 11, {"A401": 1 << 9, "A295": 1 << 11}),
        (0x80F0, 0x3000, {"A401": 1 << 9, "A295": 0x3000, "A294": 0}),
        (0x809F, 0, {"A401": 1 << 8}),
    ],
)
def test_fals_raises_a_fatal_error_of_the_system(
    engine: EngineFactory, code: int, information: int, memory: dict[str, int]
) -> None:
    resource = plc(OMRON, engine, "CJ1M-CPU13")
    done(resource, Write("Ada", "A529", "511"))
    set_to(resource, fatal=511, m=code, m1=information)
    go(resource, 3)
    assert value(resource, "A400") == code
    for word, expected in memory.items():
        assert value(resource, word) == expected, word
    assert not resource.runnable
    assert (value(resource, "motor"), value(resource, "Main.work")) == (False, 0)  # not as with FALS
    done(resource, ClearErrors("tool", "all"))
    assert (resource.header.mode, value(resource, "A400")) == (Mode.PROGRAM, 0)
    assert [value(resource, word) for word in memory if word != "A101"] == [0] * sum(word != "A101" for word in memory)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("hidden", [False, True])
def test_the_same_code_with_other_details_is_a_different_error_of_the_system(
    engine: EngineFactory, hidden: bool
) -> None:
    resource = plc(OMRON, engine)
    if hidden:
        raise_(resource, "fal:number=9")  # more serious: A400 does not show what the program asks for
    done(resource, Write("Ada", "A529", "100"))
    for count, information in enumerate((0x0102, 0x0203), 1):
        set_to(resource, number=100, m=0x009A, m1=information)
        go(resource, 20)
        assert value(resource, "A408") == information
        assert len(generated(resource)) == count + hidden
    set_to(resource, m=0x0305, m1=0)
    go(resource, 2)
    set_to(resource, m=0x0306)
    go(resource, 2)
    assert value(resource, "A418") == 0b110_0000
    again = plc(OMRON, engine)
    replay(again, resource.journal, resource.header.scan)
    assert again.state == resource.state
    raised = len(generated(resource))
    done(resource, Recover("tool", None))
    go(resource, 2)  # the program asks on, so it shows again
    assert (value(resource, "A418"), len(generated(resource))) == (1 << 6, raised + 1)


def test_a_choice_among_bits_of_two_words_is_one_of_the_first() -> None:
    resource = plc(OMRON, model_name="CS1D-CPU65H")
    done(resource, Write("Ada", "A529", "100"))
    set_to(resource, number=100, m=0x0003, m1=1 << 2)
    go(resource, 2)
    assert words(resource, "A400", "A316", "A319", "A320") == [3, 1 << 2, 1 << 2, 0]


def test_the_number_in_a529_is_only_for_codes_of_its_severity() -> None:
    resource = plc(OMRON)
    done(resource, Write("Ada", "A529", "100"))
    for values in ({"number": 100, "m": 0x80F1}, {"number": 100, "m": 0x1234}, {"fatal": 100, "m": 0x00F7}):
        set_to(resource, **{"number": 0, "fatal": 0} | values)
        go(resource, 2)
        assert (value(resource, "A400"), value(resource, "Main.ok"), resource.runnable) == (0, False, True)
    set_to(resource, fatal=0, number=101)
    go(resource, 2)
    assert value(resource, "A400") == 0x4165  # any other number is its own error


def test_the_trap_of_fals_ends_with_its_error_although_somebody_raised_that_again() -> None:
    for raised in ("fals:number=7", "memory-error"):
        resource = plc(OMRON, model_name="CJ1M-CPU13")
        done(resource, Write("Ada", "A529", "511"))
        code = 3 if raised.startswith("fals") else 511
        set_to(resource, fatal=code, m=0x80F1)
        go(resource, 2)
        ref = parse_reference(resource.view.model, raised)
        assert isinstance(ref, ErrorRef)
        done(resource, Generate("Ada", (ref,), again=True))
        assert resource.header.halted_by_trap
        done(resource, Recover("Ada", None))
        assert (resource.header.mode, resource.header.halt, resource.trap) == (Mode.PROGRAM, 0, None)


@pytest.mark.parametrize("engine", ENGINES)
def test_an_error_of_the_system_by_fal_takes_nothing_over(engine: EngineFactory) -> None:
    """What somebody raised at the simulator stays his, and its cause with it; what the program raised beside it can go."""
    resource = plc(OMRON, engine)
    raise_(resource, "basic-io-error:rack=1,slot=1")
    done(resource, Write("Ada", "A529", "100"))
    set_to(resource, number=100, m=0x009A, m1=0x0203)
    go(resource, 3)
    active = resource.view.derived(ACTIVE)["basic-io-error"]
    assert [(each.by, each.origin) for each in active.raised] == [("Ada", "simulator"), ("program", "program")]
    assert value(resource, "A408") == 0x0203
    set_to(resource, number=0)
    go(resource, 1)
    for what in ("all", 0x009A, "current"):
        outcome = resource.submit(ClearErrors("tool", what))
        if what == "all":
            assert isinstance(outcome, Entry)
            assert outcome.plan.message == "cleared by the tool: basic-io-error (rack=2, slot=3)"
        else:
            assert isinstance(outcome, Refusal)
            assert outcome.message.startswith(WILL_NOT_CLEAR)
        assert (value(resource, "A400"), value(resource, "A402"), value(resource, "A408")) == (0x009A, 1 << 12, 0x0101)
    active = resource.view.derived(ACTIVE)["basic-io-error"]
    assert (active.by, active.origin, len(active.raised)) == ("Ada", "simulator", 1)
    again = plc(OMRON, engine)
    replay(again, [_packed(each) for each in resource.journal], resource.header.scan)
    assert (again.state, again.view.derived(ACTIVE)) == (resource.state, resource.view.derived(ACTIVE))
    standing = protocol.InEffect({"basic-io-error": active})
    assert codec.unpack(codec.pack_body(standing)) == standing
    done(resource, Recover("Ada", ("basic-io-error",)))
    assert present(resource) == []


# ---- MELSEC -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("engine", ENGINES)
def test_sm50_clears_the_error_of_sd50(engine: EngineFactory) -> None:
    source = "PROGRAM Main\nVAR set, reset : BOOL; END_VAR\n  IF set THEN SETF(12); END_IF;\n  IF reset THEN SD50 := 9000; SM50 := TRUE; END_IF;\nEND_PROGRAM\n"
    resource = plc(source, engine, "Q03UD")
    raise_(resource, "ac-dc-down", "battery-error")
    done(resource, Write("Ada", "Main.set", "TRUE"))
    go(resource, 2)
    done(resource, Write("Ada", "Main.set", "FALSE"))
    assert words(resource, "SD0", "SM0", "SM1", "SM62", "SD62", "SD16") == [1500, True, True, True, 12, 12]
    done(resource, Write("Ada", "Main.reset", "TRUE"))
    go(resource, 3)
    assert (present(resource), value(resource, "SM62")) == (["ac-dc-down", "battery-error"], False)
    for code, left in ((1500, ["battery-error"]), (1600, ["battery-error"])):  # the battery is still low
        done(resource, Write("Ada", "Main.reset", "FALSE"))
        done(resource, Write("Ada", "SM50", "FALSE"))
        go(resource, 2)
        done(resource, Write("Ada", "SD50", str(code)))
        done(resource, Write("Ada", "SM50", "TRUE"))
        go(resource, 2)
        assert present(resource) == left
    assert words(resource, "SD0", "SM0", "SM1", "SM53") == [1600, True, True, False]
    done(resource, Recover("Ada", None))
    assert words(resource, "SD0", "SM0", "SM1", "SM5", "SM51") == [0, False, False, False, False]


def test_sd1_to_sd3_say_when_the_latest_error_came() -> None:
    resource = plc(CALM, model_name="Q03UD")
    resource.run(100)
    raise_(resource, "battery-error")
    clock = words(resource, "SD210", "SD211", "SD212")
    assert words(resource, "SD1", "SD2", "SD3") == clock
    resource.run(500)
    assert words(resource, "SD1", "SD2", "SD3") == clock
    raise_(resource, "ac-dc-down")
    assert value(resource, "SD3") == value(resource, "SD212") != clock[2]
    done(resource, Recover("Ada", ("ac-dc-down",)))
    assert value(resource, "SD1") != 0
    done(resource, Recover("Ada", None))
    assert words(resource, "SD1", "SD2", "SD3") == [0, 0, 0]


# ---- NJ -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("engine", ENGINES)
def test_reset_plc_error(engine: EngineFactory) -> None:
    source = "PROGRAM Main\nVAR plc, alarm : BOOL; number : INT; END_VAR\n  IF number > 0 THEN SetAlarm(number); END_IF;\n  IF plc THEN ResetPLCError(); END_IF;\n  IF alarm THEN ResetAlarm(); END_IF;\nEND_PROGRAM\n"
    resource = plc(source, engine, "NJ501-1300")
    raise_(resource, "task-period-exceeded", "low-battery", "following-error-limit")
    set_to(resource, number=77)
    go(resource, 10)
    assert len([text for text in generated(resource) if "user-fault" in text]) == 1
    assert resource.view.model.show_code(_code(resource)) == "60010000"
    set_to(resource, number=0, plc=1)
    go(resource, 2)
    assert present(resource) == ["low-battery", "following-error-limit", "user-fault-level-1"]
    assert resource.view.model.show_code(_code(resource)) == "64480000"
    set_to(resource, plc=0, alarm=1)
    go(resource, 2)
    assert present(resource) == ["low-battery", "following-error-limit"]
    done(resource, Recover("Ada", None))
    assert _code(resource) == 0


def _code(resource: Resource) -> int:
    word = resource.view.model.code_word
    assert word is not None
    start = resource.program.layout.areas[word.area.name] + word.byte
    return int.from_bytes(resource.memory[start : start + word.bits // 8], "little")
