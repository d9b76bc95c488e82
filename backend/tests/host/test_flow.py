"""What the code saw, asked of the process of a PLC: while it runs, halted, in the past, on native code."""

import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

from scanbench.debug.flow import FlowHook
from scanbench.debug.flow_shown import FlowAsked, Flows
from scanbench.host import flows as flows_module
from scanbench.host.flows import FlowsOf
from scanbench.host.link import Link
from scanbench.recording.timeline import Timeline
from scanbench.runtime.resource import Resource
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import host as protocol
from tests.host.child import Child
from tests.host.test_host_debugging import at_line, set_breakpoints
from tests.recording.recorded import advance, begun

BELT = """\
FUNCTION_BLOCK Belt
VAR_INPUT go : BOOL; END_VAR
VAR on, off, done : BOOL; END_VAR
RUNG
    [go] (on)
END_RUNG
RUNG
    [on] (off)
    (R on)
END_RUNG
RUNG
    [on] (done)
END_RUNG
END_FUNCTION_BLOCK
PROGRAM Main
VAR n : DINT; a, b : Belt; END_VAR
n := n + 1;
a(go := n MOD 2 = 0);
b(go := n MOD 2 = 1);
END_PROGRAM
"""


def flow_of(child: Child, instance: str = "Main.a", pou: str = "Belt") -> Flows:
    asked = FlowAsked(pou, instance)
    return child.ask(lambda ref: debug_protocol.WantFlow(ref, asked), debug_protocol.FlowIs).flows


def powers(flows: Flows, number: int = 0) -> dict[int, bool | None]:
    """Of the first element of each line."""
    found: dict[int, bool | None] = {}
    for each in flows.flows[number].elements:
        found.setdefault(each.line, each.power)
    return found


def test_a_plc_that_runs_tells_of_the_scan_that_it_runs_next(tmp_path: Path) -> None:
    with Child(tmp_path / "a.run", BELT, tmp_path / "cache") as child:
        one, other = flow_of(child), flow_of(child)
        assert [each.whole for each in (*one.flows, *other.flows)] == [True, True]
        assert one.flows[0].scan < other.flows[0].scan
        even = one.flows[0].scan % 2 == 1  # n is the scan's number and one
        assert powers(one) == {5: even, 8: even, 9: None, 12: False}
        assert one.file == "main.st"
        child.ask(lambda ref: protocol.Drive(ref, "pause", None, "Ann"), protocol.Ack)
        child.until(lambda state: state.paused)
        last = flow_of(child)
        state = child.until(lambda state: state.paused)
        assert [each.scan for each in last.flows] == [state.scan - 1]
        assert flow_of(child) == last


def test_a_halted_plc_tells_of_this_scan_and_of_the_one_before(tmp_path: Path) -> None:
    with Child(tmp_path / "a.run", BELT, tmp_path / "cache") as child:
        flow_of(child)

        set_breakpoints(child, at_line(8, instance="Main.b"))
        halt = child.halted()
        flows = flow_of(child, "Main.b")
        assert [(each.scan, each.whole) for each in flows.flows] == [(halt.scan, False), (halt.scan - 1, True)]
        odd = halt.scan % 2 == 0
        assert powers(flows) == {5: odd}
        assert powers(flows, 1) == {5: not odd, 8: not odd, 9: None, 12: False}
        assert [len(each.elements) for each in flow_of(child, "Main.a").flows] == [7, 7]
        answer = child.ask(lambda ref: protocol.Travel(ref, halt.scan - 1, "Ann"), protocol.Ack)
        assert answer.ok, answer.message
        past = flow_of(child, "Main.b")
        assert [(each.scan, each.whole) for each in past.flows] == [(halt.scan - 2, True)]
        assert powers(past)[5] is odd


def refused(child: Child) -> str:
    """Why nothing is told of an instance that is not there."""
    asked = FlowAsked("Belt", "Main.nobody")
    answer = child.ask(lambda ref: debug_protocol.WantFlow(ref, asked), protocol.Ack)
    assert not answer.ok
    return answer.message


def test_what_is_not_there_is_refused(tmp_path: Path) -> None:
    with Child(tmp_path / "a.run", BELT, tmp_path / "cache") as child:
        assert "nobody" in refused(child)
        child.ask(lambda ref: protocol.Drive(ref, "pause", None, "Ann"), protocol.Ack)
        scan = child.until(lambda state: state.paused).scan
        assert "nobody" in refused(child)
        assert [each.scan for each in flow_of(child).flows] == [scan - 1]
        answer = child.ask(lambda ref: protocol.Drive(ref, "continue", None, "Ann"), protocol.Ack)
        assert answer.ok, answer.message
        child.until(lambda state: state.scan > scan)


class Told(Link):
    """What is told, kept."""

    def __init__(self, sock: socket.socket) -> None:
        super().__init__(sock)
        self.told: list[tuple[int, int]] = []
        """By whom it was asked, and the scan."""
        self.refused: list[int] = []

    def post(self, message: object) -> None:
        if isinstance(message, protocol.Ack):
            self.refused.append(message.ref)
            return
        assert isinstance(message, debug_protocol.FlowIs)
        self.told.append((message.ref, message.flows.flows[0].scan))


class Desk:
    """Questions of a PLC that is not run by a loop."""

    def __init__(self, timeline: Timeline, sock: socket.socket) -> None:
        self.link, self.back = Told(sock), list[int]()
        self.flows = FlowsOf(timeline, self.link, lambda request: self.back.append(request.ref))

    def ask(self, *firsts: int) -> None:
        for ref, first in enumerate(firsts):
            self.flows.ask(debug_protocol.WantFlow(ref, FlowAsked("Main", "Main", first=first)))


@pytest.fixture
def timeline(tmp_path: Path) -> Iterator[Timeline]:
    found = begun(tmp_path / "a.run")
    found.live.debugged()
    yield found
    found.close()


@pytest.fixture
def desk(timeline: Timeline) -> Iterator[Desk]:
    ours, theirs = socket.socketpair()
    with ours, theirs:
        yield Desk(timeline, ours)


def test_who_looks_has_a_share_of_the_time_of_a_scan(
    timeline: Timeline, desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = 0

    def later() -> int:  # 2 ms go by for each question, of 10 ms; the PLC runs each 10 ms
        nonlocal now
        now += 2_000_000
        return now

    monkeypatch.setattr(flows_module, "monotonic_ns", later)
    flows, link = desk.flows, desk.link
    desk.ask(1, 2, 1)
    begin = flows.begin()
    assert begin is not None
    advance(timeline, 1)
    flows.ran(begin)
    assert link.told == [(0, 0), (2, 0)]
    assert flows.begin() is None  # it is the PLC's turn
    now += 1_000_000_000
    begin = flows.begin()
    assert begin is not None
    advance(timeline, 1)
    flows.ran(begin)
    assert link.told == [(0, 0), (2, 0), (1, 1)]
    assert not flows.waiting


def test_equal_questions_of_a_plc_that_waits_are_answered_by_one_run(
    timeline: Timeline, desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs, hook = list[int](), FlowHook

    def made(resource: Resource, asked: FlowAsked, upto: int = 0) -> FlowHook:
        runs.append(asked.first)
        return hook(resource, asked, upto)

    monkeypatch.setattr(flows_module, "FlowHook", made)
    advance(timeline, 3)
    desk.ask(1, 2, 1, 1)
    desk.flows.answer()
    assert desk.link.told == [(0, 2), (2, 2), (3, 2), (1, 2)]
    assert runs == [1, 2]


def test_more_questions_than_there_is_room_for_are_refused(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flows_module, "_MOST", 3)
    desk.ask(1, 2, 3, 4, 5)
    assert desk.link.refused == [3, 4]


def test_questions_wait_for_the_debugged_code_of_a_new_program(timeline: Timeline, desk: Desk) -> None:
    desk.ask(1, 2)
    timeline.live.debug = None
    assert desk.flows.begin() is None
    assert (desk.back, desk.flows.waiting) == ([0, 1], False)
    desk.ask(3)
    desk.flows.answer()
    assert (desk.back, desk.flows.waiting) == ([0, 1, 0], False)
    assert timeline.live.debug is None  # nothing was built between two scans
