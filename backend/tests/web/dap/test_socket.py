"""Tools and browsers at a PLC of a server."""

import contextlib
import os
import signal
from collections.abc import Iterator
from itertools import count

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from tests.web.dap.client import BrowserClient, Message, SocketClient
from tests.web.server import Server

PROGRAM = """FUNCTION_BLOCK Counter
VAR_INPUT
  step : INT;
END_VAR
VAR_OUTPUT
  total : INT;
END_VAR
total := total + step;
END_FUNCTION_BLOCK

PROGRAM Main
VAR
  a : Counter;
  b : Counter;
  n : UDINT;
END_VAR
n := n + 1;
a(step := 1);
b(step := 0);
END_PROGRAM
"""
COUNTS, FIRST, CALL_A, CALL_B = 8, 17, 18, 19
TASKS = """FUNCTION_BLOCK Adds
VAR_IN_OUT
  sum : INT;
END_VAR
sum := sum + 1;
END_FUNCTION_BLOCK

PROGRAM Slow
VAR
  n, m : INT;
  adds : Adds;
END_VAR
adds(sum := n);
adds(sum := m);
IF n < 0 THEN
  m := 0;
END_IF;
END_PROGRAM

PROGRAM Fast
VAR
  n : INT;
END_VAR
n := n + 1;
END_PROGRAM

CONFIGURATION Plant
  TASK slow (INTERVAL := T#20ms, PRIORITY := 5);
  TASK fast (INTERVAL := T#10ms, PRIORITY := 1);
  PROGRAM s WITH slow : Slow;
  PROGRAM f WITH fast : Fast;
END_CONFIGURATION
"""
ADDS, CALL_N, CALL_M, NEVER, FAST = 5, 13, 14, 16, 24
_numbers = count(1)


@pytest.fixture
def instance(server: Server) -> Iterator[int]:
    id = server.instance(f"dap {next(_numbers)}", "GENERIC-IEC", Main=PROGRAM)
    yield id
    assert server.http.delete(f"/api/instances/{id}").status_code == 204


def breakpoints(server: Server, instance: int) -> list[dict[str, object]]:
    with server.browser(instance) as browser:
        found: list[dict[str, object]] = browser.hello["breakpoints"]
        return found


def test_a_tool_attaches_halts_steps_and_goes(server: Server, instance: int) -> None:
    with SocketClient(server, instance) as tool:
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": COUNTS, "condition": "total > 3"}])
        stopped = tool.halt("configurationDone")
        assert stopped["reason"] == "breakpoint"
        assert stopped["scanbench"]["instance"] == "Main.a"
        inner, outer = tool.stack()
        assert (inner["line"], outer["line"]) == (COUNTS, CALL_A)
        assert inner["source"]["path"] == "Main.st"
        text = tool.ask("source", source=inner["source"], sourceReference=inner["source"]["sourceReference"])
        assert text["content"] == PROGRAM
        before = int(tool.value("total", inner["id"]))
        assert before > 3
        tool.ask("setExpression", expression="total", value="10", frameId=inner["id"])
        tool.halt("next", threadId=1)
        assert tool.value("Main.a.total") == "11"
        tool.halt("stepBack", threadId=1)
        assert tool.stack()[0]["line"] == COUNTS
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[])
        live = tool.halt("continue", threadId=1)  # out of the past, up to the live position
        assert not live["scanbench"]["past"]
        assert tool.ask("continue", threadId=1) == {"allThreadsContinued": True}
        assert "not halted" in tool.refused("stackTrace", threadId=1)
        tool.ask("disconnect")


def test_local_files_are_mapped(server: Server, instance: int) -> None:
    with SocketClient(server, instance, localRoot="/home/ann/plant") as tool:
        found = tool.ask("setBreakpoints", source={"path": "/home/ann/plant/Main.st"}, breakpoints=[{"line": CALL_B}])
        assert found["breakpoints"][0]["verified"]
        tool.halt("configurationDone")
        assert tool.stack()[0]["source"] == {"name": "Main.st", "path": "/home/ann/plant/Main.st"}
        elsewhere = tool.ask("setBreakpoints", source={"path": "/home/ann/Other.st"}, breakpoints=[{"line": 1}])
        assert not elsewhere["breakpoints"][0]["verified"]
        assert "no file of the program" in elsewhere["breakpoints"][0]["message"]


def test_lines_may_count_from_0(server: Server, instance: int) -> None:
    with SocketClient(server, instance) as tool:
        tool.ask("disconnect")
    with SocketClient(server, instance) as tool:
        places = tool.ask("breakpointLocations", source={"path": "Main.st"}, line=1, endLine=100)["breakpoints"]
        assert [place["line"] for place in places] == [COUNTS, FIRST, CALL_A, CALL_B]


def test_a_tool_that_is_gone_takes_its_breakpoints_with_it_and_the_plc_goes_on(server: Server, instance: int) -> None:
    with SocketClient(server, instance) as tool:
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": CALL_A}])
        tool.halt("configurationDone")
        assert server.state(instance)["state"] == "halted"
    # Asked from outside: a browser that joins before the tool is seen to be gone would rightly keep the halt.
    tool.until(lambda: server.state(instance)["state"] == "running")
    assert breakpoints(server, instance) == []


def test_a_tool_that_is_gone_in_the_past_leaves_no_halt(server: Server, instance: int) -> None:
    with SocketClient(server, instance) as tool:
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": CALL_A}])
        tool.halt("configurationDone")
        tool.halt("stepBack", threadId=1)
        assert server.state(instance)["past"] is not None
    tool.until(lambda: server.state(instance)["state"] == "running")


def test_a_plc_at_which_somebody_else_is_stays_halted(server: Server, instance: int) -> None:
    with server.browser(instance) as browser:
        with SocketClient(server, instance) as tool:
            tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": CALL_A}])
            tool.halt("configurationDone")
            tool.ask("disconnect")
        browser.wait_for("breakpoints", breakpoints=[])
        assert server.state(instance)["state"] == "halted"
        with contextlib.closing(BrowserClient(browser)) as other:
            assert other.event("stopped")["allThreadsStopped"]
            other.ask("continue", threadId=1)
            browser.wait(lambda: server.state(instance)["state"] == "running")


def test_two_see_the_same_halt_and_step_together(server: Server, instance: int) -> None:
    with SocketClient(server, instance, user="Ann") as ann, SocketClient(server, instance, user="Bob") as bob:
        bob.ask("configurationDone")
        ann.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": CALL_A}])
        number = ann.halt("configurationDone")["scanbench"]["number"]
        seen = bob.event("stopped")
        assert seen["scanbench"]["number"] == number
        assert seen["hitBreakpointIds"] == []  # it is not Bob's
        first, second = ann.send("next", threadId=1), bob.send("next", threadId=1)
        answers = [ann.response(first), bob.response(second)]
        assert any(answer["success"] for answer in answers), answers
        assert all(answer["success"] or answer["message"] for answer in answers)
        ann.event("stopped")
        ann.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[])
        bob.ask("continue", threadId=1)
        assert ann.event("continued")["allThreadsContinued"]


def test_browsers_share_a_list_and_change_it_one_by_one(server: Server, instance: int) -> None:
    with server.browser(instance, "Ann") as first, server.browser(instance, "Bob") as second:
        ann, bob = BrowserClient(first), BrowserClient(second)
        source = {"path": "Main.st"}
        mine = ann.ask(
            "scanbench/setBreakpoint", breakpoint={"kind": "line", "source": source, "line": CALL_A, "enabled": False}
        )
        yours = bob.ask(
            "scanbench/setBreakpoint", breakpoint={"kind": "line", "source": source, "line": CALL_B, "enabled": False}
        )
        bob.ask("scanbench/setBreakpoint", breakpoint={"kind": "scan", "scan": 1 << 40})
        listed = breakpoints(server, instance)
        assert [(each["kind"], each["author"]) for each in listed] == [
            ("line", "Ann"),
            ("line", "Bob"),
            ("scan", "Bob"),
        ]
        id = mine["breakpoint"]["id"]
        bob.ask(
            "scanbench/setBreakpoint",
            breakpoint={"id": id, "kind": "line", "source": source, "line": CALL_A, "condition": "n > 5", "enabled": True},
        )  # fmt: skip
        assert bob.event("stopped")["hitBreakpointIds"] == [id]
        assert ann.event("stopped")["hitBreakpointIds"] == [id]
        assert ann.ask("scanbench/removeBreakpoints", ids=[id, yours["breakpoint"]["id"]]) == {"removed": 2}
        assert bob.event("breakpoint")["reason"] in ("changed", "removed")
        assert "no breakpoint" in ann.refused("scanbench/removeBreakpoints", ids=[id])
        assert ann.ask("scanbench/removeBreakpoints") == {"removed": 1}
        ann.ask("continue", threadId=1)
        assert bob.event("continued")


def test_a_value_that_leaves_its_subrange_is_told_with_its_bounds_and_calls(server: Server) -> None:
    program = PROGRAM.replace("  total : INT;", "  total : INT (0..3);")
    instance = server.instance("leaves its subrange", "GENERIC-IEC", Main=program)
    with SocketClient(server, instance) as tool:
        tool.ask("setExceptionBreakpoints", filters=["violation"])
        tool.ask("configurationDone")
        assert tool.event("stopped")["reason"] == "exception"
        found = tool.ask("exceptionInfo", threadId=1)
        assert found["description"] == "total was 4, outside of 0..3, at Main.st:8 in Main.a"
        details = found["details"]
        assert {name: details[name] for name in ("variable", "instance", "value", "low", "high", "place")} == {
            "variable": "total", "instance": "Main.a", "value": 4, "low": 0, "high": 3, "place": "Main.st:8",
        }  # fmt: skip
        assert details["stackTrace"].splitlines() == [f"Counter Main.a Main.st:{COUNTS}", f"Main Main Main.st:{CALL_A}"]


def test_function_and_exception_breakpoints_and_our_own_requests(server: Server, instance: int) -> None:
    with SocketClient(server, instance) as tool:
        tool.ask("configurationDone")
        found = tool.ask("setFunctionBreakpoints", breakpoints=[{"name": "counter", "condition": "step = 1"}])
        assert found["breakpoints"][0]["line"] == COUNTS
        stopped = tool.event("stopped")
        assert stopped["reason"] == "function breakpoint"
        tool.ask("setFunctionBreakpoints", breakpoints=[])
        wrong = tool.ask(
            "setExceptionBreakpoints",
            filters=["trap"],
            filterOptions=[{"filterId": "error", "condition": "no-such-error"}],
        )
        assert [each["verified"] for each in wrong["breakpoints"]] == [True, False]
        assert "there is no filter all" in tool.refused("setExceptionBreakpoints", filters=["all"])
        tool.ask("scanbench/force", path="Main.n", value="7")
        assert "no member `m`" in tool.refused("scanbench/force", path="Main.m", value="7")
        tool.halt("scanbench/singleScan")
        assert tool.value("Main.n") == "7"
        tool.halt("scanbench/runTo", source={"path": "Main.st"}, line=CALL_B)
        assert tool.value("Main.n") == "8"
        tool.ask("scanbench/release")
        back = tool.halt("scanbench/reverseTo", path="Main.a.total")
        assert back["scanbench"]["past"] or tool.stack()[0]["line"] == COUNTS


def test_an_execution_point_assigns_and_goes_on(server: Server, instance: int) -> None:
    with SocketClient(server, instance) as tool:
        tool.ask("configurationDone")
        extra = {"assign": "total := total + 1000"}
        found = tool.ask(
            "setBreakpoints", source={"path": "Main.st"},
            breakpoints=[{"line": COUNTS, "condition": "total < 1000", "scanbench": extra | {"instance": "Main.b"}}],
        )  # fmt: skip
        assert found["breakpoints"][0]["verified"], found
        with server.browser(instance) as browser:
            browser.watch("Main.b.total")
            browser.wait(lambda: browser.number("Main.b.total") == 1000)
        assert int(tool.value("Main.a.total")) < 1000
        assert (
            "extra"
            in tool.refused(
                "setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": 8, "scanbench": {"asign": ""}}]
            ).lower()
        )


def test_nonsense_is_answered(server: Server, instance: int) -> None:
    with SocketClient(server, instance) as tool:
        tool.socket.send("this is no JSON")
        assert "no request of DAP" in tool.wait(lambda each: each["type"] == "response")["message"]
        tool.put({"type": "request", "seq": 90})
        assert "command" in tool.response(90)["message"]
        tool.put({"type": "event", "seq": 91, "event": "what"})
        assert "there is no request 'fly'" in tool.refused("fly")
        assert "line" in tool.refused("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": "8"}])
        assert "earlier halt" in tool.refused("variables", variablesReference=1)
        assert "already" in tool.refused("attach")
        assert "already" in tool.refused("launch", program="x.st")
        tool.put({"type": "request", "seq": 92, "command": "threads", "arguments": None})
        assert tool.response(92)["body"]["threads"]


def test_a_plc_that_is_switched_off_ends_the_session(server: Server, instance: int) -> None:
    with SocketClient(server, instance) as tool:
        tool.ask("configurationDone")
        server.http.patch(f"/api/instances/{instance}", json={"power": False})
        assert "switched off" in tool.event("output")["output"]
        tool.event("terminated")
        assert "switch" in tool.refused("pause", threadId=1).lower()


def test_a_process_that_is_killed_comes_back_with_its_breakpoints(server: Server, instance: int) -> None:
    with SocketClient(server, instance) as tool:
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": CALL_A}])
        tool.halt("configurationDone")
        pid = server.state(instance)["pid"]
        os.kill(pid, signal.SIGKILL)
        assert "died" in tool.event("output")["output"]
        again = tool.event("stopped")
        assert again["allThreadsStopped"]
        if not again["hitBreakpointIds"]:  # it comes back before the scan
            tool.halt("continue", threadId=1)
        assert tool.stack()[0]["line"] == CALL_A


def test_a_token_is_needed(server: Server, instance: int) -> None:
    address = f"ws://127.0.0.1:{server.port}/api/instances/{instance}/dap?token=wrong"
    with pytest.raises(InvalidStatus), connect(address):
        pass


@pytest.fixture
def tasks(server: Server) -> Iterator[int]:
    id = server.instance(f"dap {next(_numbers)}", "GENERIC-IEC", Main=TASKS)
    yield id
    assert server.http.delete(f"/api/instances/{id}").status_code == 204


def test_threads_are_the_tasks_and_known_before_they_ran(server: Server, tasks: int) -> None:
    with SocketClient(server, tasks) as tool:
        fast, slow = tool.ask("threads")["threads"]
        assert (fast["name"], slow["name"]) == ("fast", "slow")
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": CALL_N}])
        assert tool.halt("configurationDone")["threadId"] == slow["id"]
        frames = tool.ask("stackTrace", threadId=slow["id"])
        assert [each["line"] for each in frames["stackFrames"]] == [CALL_N]
        assert tool.ask("stackTrace", threadId=fast["id"]) == {"stackFrames": [], "totalFrames": 0}
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": FAST}])
        assert tool.halt("continue", threadId=slow["id"])["threadId"] == fast["id"]
        assert tool.ask("threads")["threads"] == [fast, slow]


def test_threads_of_a_different_program(server: Server, tasks: int) -> None:
    with SocketClient(server, tasks) as tool:
        before = {each["name"]: each["id"] for each in tool.ask("threads")["threads"]}
        project = server.http.get(f"/api/instances/{tasks}").json()["project"]["id"]
        text = TASKS.replace("TASK slow", "TASK late").replace("WITH slow", "WITH late")
        saved = server.http.put(f"/api/projects/{project}/files/Main.st", json={"text": text, "version": 1})
        assert saved.status_code == 200, saved.text
        built = server.http.post(f"/api/projects/{project}/build", json={"agreed": True}).json()
        assert built["ok"], built
        tool.until(lambda: "late" in {each["name"] for each in tool.ask("threads")["threads"]})
        now = {each["name"]: each["id"] for each in tool.ask("threads")["threads"]}
        assert set(now) == {"fast", "late"}
        assert now["fast"] == before["fast"]
        assert now["late"] not in before.values()


def test_what_an_in_out_is_bound_to(server: Server, tasks: int) -> None:
    with SocketClient(server, tasks) as tool:
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": ADDS}])
        tool.halt("configurationDone")
        bound = tool.ask("scanbench/inOutBinding", path="s.adds.sum")
        assert bound["ok"], bound
        assert [site["line"] for site in bound["sites"]] == [CALL_N, CALL_M]
        assert [site["actual"] for site in bound["sites"]] == ["s.n", "s.m"]
        assert "no" in tool.refused("scanbench/inOutBinding", path="s.adds.total")
        assert "path" in tool.refused("scanbench/inOutBinding")


def reached(coverage: Message) -> set[int]:
    return {site["line"] for file in coverage["files"] for site in file["sites"] if site["reached"]}


def test_coverage_says_what_was_reached(server: Server, tasks: int) -> None:
    with SocketClient(server, tasks) as tool:
        assert not tool.ask("scanbench/coverage")["on"]
        assert tool.ask("scanbench/coverage", on=True)["on"]
        tool.until(lambda: {ADDS, CALL_N, CALL_M, FAST} <= reached(tool.ask("scanbench/coverage")))
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": FAST}])
        tool.halt("configurationDone")
        covered = tool.ask("scanbench/coverage")
        assert [file["file"] for file in covered["files"]] == ["Main.st"]
        assert NEVER not in reached(covered)
        fresh = tool.ask("scanbench/coverage", reset=True)
        assert fresh["on"]
        assert not {ADDS, CALL_N, CALL_M} & reached(fresh)  # none of them ran since
        assert not tool.ask("scanbench/coverage", on=False)["on"]


def test_back_to_the_last_write(server: Server, tasks: int) -> None:
    with SocketClient(server, tasks) as tool:
        tool.ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": CALL_M, "condition": "n > 2"}])
        tool.halt("configurationDone")
        n = int(tool.value("s.n"))
        assert tool.halt("scanbench/reverseTo", path="s.n")["scanbench"]["scan"] > 0
        inner, outer = tool.stack()
        assert (inner["line"], outer["line"]) == (ADDS, CALL_N)
        assert int(tool.value("s.n")) == n - 1  # before the statement that wrote it
        assert "no" in tool.refused("scanbench/reverseTo", path="s.nothing")
