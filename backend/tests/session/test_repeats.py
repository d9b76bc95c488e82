"""What the log says of machines that enter the same again and again: a line now and then, always one about the last time, in order."""

from dataclasses import replace

from scanbench.faults.inject import Generate
from scanbench.faults.reference import ErrorRef
from scanbench.host import marks
from scanbench.host.repeats import Repeats
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Command, Entry, Plan
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.session.log import Log
from scanbench.wire.events import Event, LogEntry
from scanbench.wire.host import PlcState
from tests.runtime.bench import plc

SECOND = 1_000_000_000


def test_the_last_write_is_told_when_the_client_is_quiet() -> None:
    resource = plc("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM", model_name="CJ1M-CPU13")
    writes = Repeats()

    def write(value: int) -> Entry:
        entry = resource.submit(WriteAreas("HMI", (AreaWrite("D", 200, bytes((value, 0))),)))
        assert isinstance(entry, Entry)
        return entry

    first, second, third = (write(value) for value in (1, 2, 3))
    assert writes.text(first, 0) == first.plan.message
    assert (writes.text(second, 0), writes.text(third, 0), writes.due(0)) == (None, None, [])
    assert writes.due(4 * SECOND) == []
    assert writes.due(5 * SECOND) == [(third, f"{third.plan.message} (1 more write before)")]
    assert writes.due(5 * SECOND) == []
    assert writes.text(write(4), 5 * SECOND) is None, "that was a line just now"


def _raised(scan: int, error: str = "port_7") -> Entry:
    return Entry(scan, wall_time(), Generate("PLC", (ErrorRef(error),), "plc"), Plan((), f"generated {error}"))


def _written(scan: int) -> Entry:
    return Entry(scan, wall_time(), WriteAreas("HMI", (AreaWrite("D", 0, b"\1\0"),)), Plan((), f"D{scan}"))


def _told(entries: list[Entry]) -> tuple[list[LogEntry], list[Event]]:
    events: list[Event] = []
    log = Log((), events.append, lambda line: None, lambda: PlcState("running", "MONITOR", ""))
    for entry in entries:
        log.on_entries((entry,))
    log.add("Ada", "paused", scan=entries[-1].scan)
    return log.lines, events


def test_an_error_of_each_scan_gets_few_lines_and_the_page_few_messages() -> None:
    lines, events = _told([_raised(scan, error) for scan in range(1000) for error in ("port_7", "port_6")])
    assert len(lines) == 2 * 5 + 2 + 1, "some at once, one about the last time of each, and what somebody did then"
    assert [(line.scan, line.text) for line in lines[-3:]] == [
        (999, "generated port_7 (994 more times before)"),
        (999, "generated port_6 (994 more times before)"),
        (999, "paused"),
    ]
    assert len(events) < 30


def test_what_happened_before_is_told_before() -> None:
    lines, _ = _told([_written(1), _written(2), _written(3), _raised(4)])
    assert [(line.scan, line.text) for line in lines[:3]] == [
        (1, "D1"),
        (3, "D3 (1 more write before)"),
        (4, "generated port_7"),
    ]


def test_what_a_person_raises_gets_a_line_each_time() -> None:
    by_hand: Command = Generate("Ada", (ErrorRef("port_7"),), "simulator")
    lines, _ = _told([replace(_raised(scan), command=by_hand) for scan in range(20)])
    assert len(lines) == 20 + 1


def test_a_run_that_is_opened_again_has_few_marks_of_what_repeats_itself() -> None:
    entries = [_raised(scan) for scan in range(10_000)]
    found = marks.marks_of([_written(0), *entries])
    assert len(found) < 50
    assert (found[0].scan, found[-1].scan) == (0, 9999)
