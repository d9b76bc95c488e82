"""SEND, RECV and CMND: what they ask for, what becomes of answers, and what the program sees."""

from pathlib import Path

import pytest

from scanbench.engines.interpreter.observed import observed_engine
from scanbench.faults.agenda import agenda_of_faults
from scanbench.faults.detect import Detection
from scanbench.faults.inject import ACTIVE
from scanbench.faults.network import WAITING, NetworkAnswer, NetworkRequest
from scanbench.recording.replay_file import replay_file
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import SourcePrograms, of_file
from tests.runtime.bench import ENGINES, plc, value

RECV = """
PROGRAM Main
VAR n : INT; started : INT; ready AT A202.07 : BOOL; failed AT A219.07 : BOOL; code AT A210 : WORD;
  seen : BOOL; last : WORD; control AT D300 : ARRAY[0..4] OF WORD := [3, 0, 16#0200, 16#0700, 5]; END_VAR
  n := n + 1;
  IF n = 1 THEN control[0] := 3; control[2] := 16#0200; control[3] := 16#0700; control[4] := 5; END_IF;
  IF ready AND n MOD 20 = 2 THEN
    IF RECV(S := %D100, D := %D0, C := %D300) THEN started := started + 1; END_IF;
  END_IF;
  IF failed THEN seen := TRUE; last := code; END_IF;
END_PROGRAM
"""


def bench(source: str, engine: EngineFactory = ENGINES[0]) -> Resource:
    resource = plc(source, engine)
    resource.detect = Detection()
    resource.waiting.agenda = agenda_of_faults(observed_engine)
    return resource


def run(resource: Resource, scan: int) -> None:
    while resource.header.scan < scan:
        resource.run(scan - resource.header.scan)


def pending(resource: Resource, port: int = 7) -> NetworkRequest:
    return resource.journal.derived(WAITING)[port].request


@pytest.mark.parametrize("engine", ENGINES)
def test_words_of_another_plc_are_there_with_the_answer(engine: EngineFactory) -> None:
    resource = bench(RECV, engine)
    run(resource, 3)
    asked = pending(resource)
    assert (asked.instruction, asked.node, asked.area, asked.word, asked.count) == ("RECV", 2, "D", 100, 3)
    assert (asked.to_area, asked.to_byte, asked.scans, asked.answered) == ("D", 0, 50, True)
    assert value(resource, "Main.ready") is False
    since = resource.journal.derived(WAITING)[7].since
    answer = resource.submit(NetworkAnswer("FINS, node 2", 7, since, 0, b"\x07\x00\x08\x00\x09\x00"))
    assert isinstance(answer, Entry)
    assert [value(resource, f"%D{word}") for word in range(3)] == [7, 8, 9]
    assert value(resource, "Main.ready") is True
    assert isinstance(resource.submit(NetworkAnswer("FINS, node 2", 7, since, 0)), Refusal), "only one answer counts"
    run(resource, 30)
    assert value(resource, "Main.started") == 2
    assert value(resource, "Main.seen") is False


@pytest.mark.parametrize("engine", ENGINES)
def test_no_answer_is_an_error_of_the_port(engine: EngineFactory) -> None:
    resource = bench(RECV, engine)
    run(resource, 51)
    assert not resource.journal.derived(ACTIVE)
    run(resource, 54)
    (error,) = resource.journal.derived(ACTIVE).values()
    assert str(error.refs[0]) == "communications-port-7-error:completion-code=205"
    assert (value(resource, "Main.seen"), value(resource, "Main.last"), value(resource, "Main.ready")) == (
        True,
        0x0205,
        True,
    )
    run(resource, 63)
    assert not resource.journal.derived(ACTIVE), "the next instruction on the port begins without the error"
    assert (value(resource, "Main.failed"), value(resource, "Main.code")) == (False, 0)


def test_a_run_is_replayed_without_the_other_plc(tmp_path: Path) -> None:
    timeline = Timeline.begin(
        tmp_path / "run", SourcePrograms({1: RECV}), 1, RECV.encode(), ENTRIES, "Ada", Detection(),
        agenda=agenda_of_faults(observed_engine),
    )  # fmt: skip
    run(timeline.resource, 10)
    since = timeline.resource.journal.derived(WAITING)[7].since
    timeline.submit(NetworkAnswer("FINS, node 2", 7, since, 0, b"\x07\x00\x08\x00\x09\x00"))
    while timeline.live_scan < 100:
        timeline.run(100 - timeline.live_scan)
    state = timeline.resource.state
    timeline.close()
    assert replay_file(tmp_path / "run", of_file, ENTRIES).scan == 100
    again = Timeline.resume(
        tmp_path / "run", of_file, ENTRIES, 0, Detection(), agenda=agenda_of_faults(observed_engine)
    )
    assert again.resource.state == state
    again.close()


SEND = """
PROGRAM Main VAR n : INT; END_VAR
  n := n + 1;
  IF n = 2 THEN
    %D10 := 16#1234; %D11 := 5;
    %D300 := 2; %D301 := 0; %D302 := 16#0300; %D303 := 16#8F01; %D304 := 0;
    SEND(S := %D10, D := %W20, C := %D300);
    %D40 := 16#0701;
    %D400 := 2; %D401 := 11; %D402 := 1; %D403 := 16#0900; %D404 := 16#0000; %D405 := 10;
    CMND(S := %D40, D := %D50, C := %D400);
  END_IF;
END_PROGRAM
"""


def test_words_are_sent_and_commands_are() -> None:
    resource = bench(SEND)
    run(resource, 3)
    send, command = pending(resource, 7), pending(resource, 0)
    assert (send.instruction, send.node, send.area, send.word, send.data) == ("SEND", 3, "W", 20, b"\x34\x12\x05\x00")
    assert (send.answered, send.scans) == (False, 400)
    assert (command.instruction, command.network, command.node, command.data, command.count) == (
        "CMND",
        1,
        9,
        b"\x07\x01",
        11,
    )
    assert (command.to_area, command.to_byte) == ("D", 100)


def test_what_an_instruction_cannot_move_ends_at_once() -> None:
    resource = bench(SEND.replace("%D300 := 2", "%D300 := 991"))
    run(resource, 4)
    (error,) = resource.journal.derived(ACTIVE).values()
    assert str(error.refs[0]) == "communications-port-7-error:completion-code=1001"


def test_programs_without_them_have_nothing_of_it() -> None:
    resource = bench("PROGRAM Main VAR n : INT; ready AT A202.07 : BOOL; END_VAR n := n + 1; END_PROGRAM")
    run(resource, 5)
    assert len(resource.journal) == 0
    assert value(resource, "Main.ready") is False
