"""A script debugs a PLC, and watches values."""

from itertools import count, islice

import pytest
from websockets.exceptions import ConnectionClosedError

from scanbench.client import Plc, Refused, connect
from scanbench.client.closed import said
from tests.web.server import Server

SOURCE = """\
FUNCTION_BLOCK Counter
VAR_INPUT step : INT; END_VAR
VAR_OUTPUT total : INT; END_VAR
VAR small : INT(0..1000); END_VAR
total := total + step;
small := total;
END_FUNCTION_BLOCK
PROGRAM Main
VAR a, b : Counter; n : UDINT; never : ARRAY[1..2] OF INT; i : INT := 1; END_VAR
n := n + 1;
a(step := 1);
b(step := 0);
never[i] := 1;
END_PROGRAM
"""
COUNTS, LIMITED, FIRST, CALL_A, CALL_B = 5, 6, 10, 11, 12
VALUES = """\
PROGRAM Main
VAR n : INT; yes : BOOL; part : REAL; t : TIME; text : STRING[20]; wide : WSTRING[20]; big : LREAL; bits : WORD; END_VAR
VAR pair : ARRAY[1..2] OF INT; END_VAR
n := n - 1;
END_PROGRAM
"""
_NUMBERS = count()


def made(server: Server, source: str) -> Plc:
    name = f"debugged by a script {next(_NUMBERS)}"
    server.instance(name, "GENERIC-IEC", Main=source)
    found = connect(server.address, user="Ann").plc(name)
    found.pause()
    found.new_run()
    return found


@pytest.fixture
def plc(server: Server) -> Plc:
    """A PLC of its own, paused before scan 0."""
    return made(server, SOURCE)


def test_a_breakpoint_halts_and_the_stack_is_told(plc: Plc) -> None:
    with plc.debug() as debugger:
        point = debugger.break_at("Main.st", COUNTS, condition="total > 3")
        assert (point.verified, point.line) == (True, COUNTS)
        assert [(each["kind"], each["line"], each["author"]) for each in plc.breakpoints] == [("line", COUNTS, "Ann")]
        debugger.go()
        stopped = debugger.wait()
        assert (stopped.reason, stopped.breakpoints, stopped.instance) == ("breakpoint", (point.id,), "Main.a")
        assert (stopped.scan, stopped.past) == (4, False)
        inner, outer = debugger.stack()
        assert [(each.file, each.line, each.pou) for each in (inner, outer)] == [
            ("Main.st", COUNTS, "Counter"), ("Main.st", CALL_A, "Main")
        ]  # fmt: skip
        scopes = debugger.scopes(inner)
        assert [(each.name, each.value, each.type) for each in scopes["VAR_OUTPUT"]] == [("total", "4", "INT")]
        assert scopes["VAR_OUTPUT"][0].path == "Main.a.total"
        assert debugger.evaluate("total * 2", inner) == "8"
        assert debugger.assign("total", "10", inner) == "10"
        assert debugger.evaluate("Main.a.total") == "10"
        assert debugger.remove(point.id) == 1
        with pytest.raises(Refused, match="nowhere"):
            debugger.evaluate("nowhere", inner)
    assert plc.breakpoints == []


def test_steps_go_in_over_out_and_back(plc: Plc) -> None:
    with plc.debug() as debugger:
        debugger.break_before(2)
        debugger.go()
        assert debugger.wait().scan == 2
        assert debugger.run_to("Main.st", CALL_A).pou == "Main"
        assert (debugger.step("in").pou, debugger.stack()[0].line) == ("Counter", COUNTS)
        assert (debugger.step().pou, debugger.stack()[0].line) == ("Counter", LIMITED)
        assert (debugger.step("out").pou, debugger.stack()[0].line) == ("Main", CALL_B)
        back = debugger.step("back")
        assert (back.past, back.pou, debugger.stack()[0].line) == (True, "Counter", LIMITED)
        wrote = debugger.back_to_write("Main.n")
        assert (wrote.past, debugger.stack()[0].line) == (True, FIRST)
        debugger.go()  # out of the past
        assert (debugger.wait().past, debugger.stack()[0].line) == (False, CALL_B)
        assert debugger.step("scan").scan == 3


def test_a_halt_that_somebody_else_ended_is_not_waited_for_in_vain(plc: Plc) -> None:
    with plc.debug() as debugger, plc.debug() as other:
        point = debugger.break_at("Main.st", FIRST)
        debugger.go()
        assert debugger.wait().breakpoints == (point.id,)
        other.wait()
        debugger.remove(point.id)
        other.go()
        plc.run(until="Main.n > 20")  # the debugger has been told by then that it goes on
        with pytest.raises(TimeoutError):
            debugger.wait(0.3)


def test_data_violations_and_traps_halt(plc: Plc) -> None:
    with plc.debug() as debugger:
        point = debugger.break_on("Main.n", condition="Main.n = 3")
        debugger.go()
        stopped = debugger.wait()
        assert (stopped.reason, stopped.breakpoints) == ("data breakpoint", (point.id,))
        debugger.remove()
        debugger.break_when("violation")
        plc.write("Main.a.total", 2000)
        debugger.go()
        stopped = debugger.wait()
        assert stopped.reason == "violation"
        assert [each["variable"] for each in plc.diagnostics["violations"]] == ["small"]
        debugger.remove()
        debugger.break_when("trap")
        debugger.assign("Main.i", "7")
        debugger.go()
        stopped = debugger.wait()
        assert (stopped.reason, stopped.pou) == ("trap", "Main")


def test_a_log_point_says_it_and_does_not_halt(plc: Plc) -> None:
    with plc.debug() as debugger:
        debugger.break_at("Main.st", FIRST, log="n is {n}", condition="n < 2")
        debugger.break_before(5)
        debugger.go()
        debugger.wait()
        assert [each for each in debugger.said if each.startswith("n is")] == ["n is 0", "n is 1"]
        missed = debugger.break_at("Main.st", 1000)
        assert not missed.verified
        assert missed.message
        debugger.remove()
        debugger.go()
        with pytest.raises(TimeoutError):
            debugger.wait(timeout_s=0)


def test_values_come_as_they_change(server: Server) -> None:
    plc = made(server, VALUES)
    plc.write("Main.part", 1.5)
    plc.write("Main.big", -2.5)
    plc.write("Main.t", "T#5ms")
    plc.write("Main.text", "'äb'")
    plc.write("Main.wide", '"ツ"')
    plc.write("Main.bits", "16#F00F")
    paths = [f"Main.{each}" for each in ("n", "yes", "part", "t", "text", "wide", "big", "bits")]
    with plc.watch(*paths) as frames:
        first = frames.next(timeout_s=60)
        assert first.scan == 0
        assert first.values == {
            "Main.n": 0, "Main.yes": False, "Main.part": 1.5, "Main.t": 5_000_000, "Main.text": "äb", "Main.wide": "ツ",
            "Main.big": -2.5, "Main.bits": 0xF00F,
        }  # fmt: skip
        assert first.changed == set(paths)
        plc.run(scans=3)
        frame = next(each for each in frames if each.scan == 3)
        assert (frame.values["Main.n"], frame.values["Main.text"]) == (-3, "äb")
        assert frame.changed == {"Main.n"}
        assert frame.time_ns == 30_000_000
        plc.write("Main.text", "'new'")
        assert frames.next(timeout_s=60).values["Main.text"] == "new"
        plc.run()
        scans = [each.scan for each in islice(frames, 3)]
        assert scans == sorted(scans)


def test_a_socket_that_is_not_opened_says_why(server: Server) -> None:
    with pytest.raises(Refused, match="HTTP 403"), connect(server.address).plc(9999).watch("n"):
        pass
    with pytest.raises(Refused, match=r"HTTP 40[13]"), connect(server.base, token="wrong").plc(1).debug():
        pass


def test_a_connection_that_ends_is_an_oserror() -> None:
    with pytest.raises(OSError, match="has closed the connection"), said():
        raise ConnectionClosedError(None, None)


def test_what_cannot_be_watched_is_refused_at_once(server: Server) -> None:
    plc = made(server, VALUES)
    with pytest.raises(Refused, match="no member `nn`") as refused, plc.watch("Main.nn"):
        pass
    assert "Main.n" in refused.value.near
    with pytest.raises(Refused, match="members"), plc.watch("Main.n", "Main.pair"):
        pass
    with plc.watch("Main.n") as frames:
        frames.next(timeout_s=60)
        with pytest.raises(TimeoutError):
            frames.next(timeout_s=0)
