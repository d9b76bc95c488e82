"""Debugging: breakpoints and steps, by the Debug Adapter Protocol on the PLC's WebSocket for tools (docs/dap.md)."""

import json
from collections import deque
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Literal, cast

from scanbench.client.asking import Hear, Refused, Say, Steps, asked
from scanbench.runtime.clock import monotonic_ns

Step = Literal["in", "over", "out", "statement", "scan", "back", "reverse", "pause"]
Access = Literal["read", "write", "change", "access"]
Body = Mapping[str, object]
SAID = 10_000
_THERE_S = 0.02
"""So long what has come by is looked for, before a halt that is known is believed."""
_ANSWER_S = 60.0


@dataclass(frozen=True, slots=True)
class Stopped:
    """The PLC is halted, as a whole, before a statement."""

    reason: str
    """`breakpoint`, `data breakpoint`, `step`, `pause`, `error`, `violation`, `trap`, `scan`, ..."""
    text: str
    """For people: `breakpoint at Main.st:12`."""
    breakpoints: tuple[int, ...]
    """Those of this debugger that were reached."""
    scan: int
    count: int
    """Statements of the scan that have begun, the next one included; 0 is between two scans."""
    pou: str
    instance: str
    """Path of the instance that is about to run."""
    task: str
    by: str
    """Who asked for it, if somebody did."""
    past: bool
    """What is shown is the past: `go` returns from it."""


@dataclass(frozen=True, slots=True)
class Breakpoint:
    """A breakpoint as it was set."""

    id: int
    verified: bool
    """Whether it can be reached; if not, `message` says why."""
    message: str
    line: int
    """The line of the statement that it is at; 0 for other kinds."""


@dataclass(frozen=True, slots=True)
class StackFrame:
    """A POU that is being executed."""

    id: int
    """Until the PLC goes on."""
    name: str
    pou: str
    instance: str
    task: str
    file: str
    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable of a scope, or a member of one."""

    name: str
    value: str
    """As it would be typed; of a structure how many members it has."""
    type: str
    path: str
    """Instance path; empty where it lives in one call only."""
    address: str
    """Vendor notation where it is located; else empty."""
    expression: str
    """By which `evaluate` finds it in the frame."""


class DebugRequests:
    """A debug session at a PLC. Its breakpoints go with it, and a PLC that is halted, and at which nobody else is, goes on then."""

    def __init__(self) -> None:
        self._seq = 0
        self._stopped: Stopped | None = None
        self._over = ""
        self._said: deque[str] = deque(maxlen=SAID)

    # ---- breakpoints ------------------------------------------------------------------------------------------------

    @asked
    def break_at(
        self, file: str, line: int, *, condition: str = "", hits: str = "", log: str = "", assign: str = "",
        instance: str = "", task: str = "",
    ) -> Steps[Breakpoint]:  # fmt: skip
        """Halts before the statement at a line: where a `condition` of ST holds, after so many `hits` (`3`, `>= 3`, `% 3`), in one
        `instance` of the block or in one `task`. With a `log` (`level is {level}`) it does not halt, `said` has the texts; with `assign`
        it executes that ST there, and does not halt."""
        return self._set(
            kind="line", source={"path": file}, line=line, condition=condition, hits=hits, log=log, assign=assign,
            instance=instance, task=task,
        )  # fmt: skip

    @asked
    def break_on(
        self, path: str, access: Access = "change", *, condition: str = "", hits: str = "", log: str = ""
    ) -> Steps[Breakpoint]:
        """Halts where a variable is read, written, changed, or any of these (`access`)."""
        return self._set(kind="data", path=path, access=access, condition=condition, hits=hits, log=log)

    @asked
    def break_when(self, what: Literal["error", "violation", "trap"], error: str = "") -> Steps[Breakpoint]:
        """Halts where an error is raised (this one, or any), a value leaves its subrange, or a run-time error would stop the program."""
        return self._set(kind=what, error=error)

    @asked
    def break_before(self, scan: int) -> Steps[Breakpoint]:
        """Halts before a scan."""
        return self._set(kind="scan", scan=scan)

    @asked
    def remove(self, *ids: int) -> Steps[int]:
        """Removes these breakpoints of this session, or all; how many."""
        return cast(int, (yield from self._ask("scanbench/removeBreakpoints", ids=list(ids) or None))["removed"])

    # ---- going on ---------------------------------------------------------------------------------------------------

    @asked
    def go(self) -> Steps[None]:
        """Goes on, whoever halted or paused it; out of the past it returns to where the PLC halted."""
        yield from self._ask("continue", threadId=1)
        self._stopped = None  # a halt that comes of it is told after the answer

    @asked
    def step(self, step: Step = "over", timeout_s: float = 60.0) -> Steps[Stopped]:
        """To the next statement `in`, `over` or `out` of calls, to the next `scan`, `back` by one statement, in `reverse` to where a
        breakpoint would have halted last; `pause` halts a PLC that runs. Waits for the halt, as `wait` does."""
        return self._move("scanbench/step", timeout_s, action=step)

    @asked
    def run_to(self, file: str, line: int, timeout_s: float = 60.0) -> Steps[Stopped]:
        """Goes on to a line, and waits for the halt."""
        return self._move("scanbench/runTo", timeout_s, source={"path": file}, line=line)

    @asked
    def back_to_write(self, path: str, timeout_s: float = 60.0) -> Steps[Stopped]:
        """Back to the last write of a variable."""
        return self._move("scanbench/reverseTo", timeout_s, path=path)

    @asked
    def wait(self, timeout_s: float = 60.0) -> Steps[Stopped]:
        """Where the PLC is halted, when it is; `TimeoutError` when it is not by then, `Refused` when it cannot be any more."""
        return self._wait(timeout_s)

    # ---- looking ----------------------------------------------------------------------------------------------------

    @asked
    def stack(self) -> Steps[list[StackFrame]]:
        """The POUs that call each other, the innermost first; none between two scans."""
        body = yield from self._ask("stackTrace", threadId=0)
        return [_frame(each) for each in _bodies(body["stackFrames"])]

    @asked
    def scopes(self, frame: StackFrame) -> Steps[Mapping[str, list[Variable]]]:
        """The variables of a POU by their section: `VAR_INPUT`, `VAR`, ..., and `GLOBAL`."""
        found: dict[str, list[Variable]] = {}
        for scope in _bodies((yield from self._ask("scopes", frameId=frame.id))["scopes"]):
            body = yield from self._ask("variables", variablesReference=scope["variablesReference"])
            found[str(scope["name"])] = [_variable(each) for each in _bodies(body["variables"])]
        return found

    @asked
    def evaluate(self, expression: str, frame: StackFrame | None = None) -> Steps[str]:
        """The value of an expression of ST in a frame, or of the whole program. It changes nothing."""
        where = {} if frame is None else {"frameId": frame.id}
        return str((yield from self._ask("evaluate", expression=expression, context="watch", **where))["result"])

    @asked
    def assign(self, target: str, value: str, frame: StackFrame | None = None) -> Steps[str]:
        """Writes a variable of a frame, or of the whole program, where the PLC is halted; its value then."""
        where = {} if frame is None else {"frameId": frame.id}
        return str((yield from self._ask("setExpression", expression=target, value=value, **where))["value"])

    @property
    def said(self) -> list[str]:
        """What log points, and the PLC for people, have said until the last answer; the last 10,000 lines."""
        return list(self._said)

    # ---- the conversation -------------------------------------------------------------------------------------------

    def _begin(self) -> Steps[None]:
        yield from self._ask("initialize", adapterID="scanbench", clientID="scanbench.client")
        yield from self._ask("attach")
        yield from self._ask("configurationDone")

    def _set(self, **wanted: object) -> Steps[Breakpoint]:
        body = cast(Body, (yield from self._ask("scanbench/setBreakpoint", breakpoint=wanted))["breakpoint"])
        line = cast(int, body.get("line", 0))
        return Breakpoint(cast(int, body["id"]), bool(body["verified"]), str(body.get("message", "")), line)

    def _move(self, command: str, timeout_s: float, **arguments: object) -> Steps[Stopped]:
        yield from self._ask(command, **arguments)
        self._stopped = None  # the halt that comes of it is told after the answer
        return (yield from self._wait(timeout_s))

    def _wait(self, timeout_s: float) -> Steps[Stopped]:
        end = monotonic_ns() + int(timeout_s * 1e9)
        there = monotonic_ns() + int(_THERE_S * 1e9)
        with suppress(TimeoutError):  # what came meanwhile: somebody may have let it run on
            while (now := monotonic_ns()) < there:
                self._note(json.loads((yield Hear((there - now) / 1e9))))
        while self._stopped is None:
            if self._over:
                raise Refused(self._over)
            self._note(json.loads((yield Hear(max(0.0, (end - monotonic_ns()) / 1e9)))))
        return self._stopped

    def _ask(self, command: str, **arguments: object) -> Steps[Body]:
        self._seq += 1
        seq = self._seq
        yield Say(json.dumps({"seq": seq, "type": "request", "command": command, "arguments": arguments}))
        while True:
            message: Body = json.loads((yield Hear(_ANSWER_S)))
            if message["type"] != "response" or message["request_seq"] != seq:
                self._note(message)
                continue
            body = cast(Body, message.get("body", {}))
            if not message["success"]:
                near = body.get("near")
                raise Refused(str(message["message"]), tuple(map(str, near)) if isinstance(near, list) else ())
            return body

    def _note(self, message: Body) -> None:
        body = cast(Body, message.get("body", {}))
        match message.get("event"):
            case "stopped":
                self._stopped = _stopped(body)
            case "continued":
                self._stopped = None
            case "output":
                self._said.append(str(body["output"]).rstrip("\n"))
            case "terminated":
                self._over = self._said[-1] if self._said else "the debug session is over"


def _stopped(body: Body) -> Stopped:
    more = cast(Body, body["scanbench"])
    ids = tuple(cast(list[int], body["hitBreakpointIds"]))
    return Stopped(
        str(more["reason"]), str(body["text"]), ids, cast(int, more["scan"]), cast(int, more["count"]),
        str(more["pou"]), str(more["instance"]), str(more["task"]), str(more["by"]), bool(more["past"]),
    )  # fmt: skip


def _frame(body: Body) -> StackFrame:
    more, source = cast(Body, body["scanbench"]), cast(Body, body["source"])
    return StackFrame(
        cast(int, body["id"]), str(body["name"]), str(more["pou"]), str(more["instance"]), str(more["task"]),
        str(source["path"]), cast(int, body["line"]), cast(int, body["column"]),
    )  # fmt: skip


def _variable(body: Body) -> Variable:
    more = cast(Body, body["scanbench"])
    path, address, expression = (str(more[each] or "") for each in ("path", "address", "expression"))
    return Variable(str(body["name"]), str(body["value"]), str(more["type"]), path, address, expression)


def _bodies(listed: object) -> list[Body]:
    return cast(list[Body], listed)
