"""What happens at the PLC -> DAP events for one client."""

from collections.abc import Callable

from scanbench.debug.halt import Halt
from scanbench.web.dap.breakpoints import described
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.shapes import Body
from scanbench.web.dap.threads import PLC
from scanbench.wire import events
from scanbench.wire.events import Event
from scanbench.wire.host import PlcState

Send = Callable[[str, Body], None]
_GONE = {
    "restarting": "the PLC's process died; it goes on from its run file",
    "failed": "the PLC cannot go on",
    "off": "the PLC was switched off",
}
_EXCEPTIONS = ("error", "violation", "trap")


class Events:
    """Tells a client what it has to know, and holds back what must come after a response."""

    def __init__(self, plc: Debuggee, send: Send, on_gone: Callable[[str], None]) -> None:
        """`on_gone` is called when the PLC was switched off or cannot go on, with a sentence."""
        self._plc, self._send, self._on_gone = plc, send, on_gone
        self._shown: tuple[int | None, int] | None = None
        self._word = plc.session.state.state
        self._started = False
        self._moving = 0
        self._own = False

    def start(self) -> None:
        """The client is ready for events: of a halt, say, that is there already."""
        self._started, self._shown = True, None
        self._tell_halt()

    def begin_move(self) -> None:
        """A request of this client makes the PLC go on: what comes of it waits for the response."""
        self._moving += 1

    def end_move(self, moved: bool) -> None:
        """The response is sent."""
        self._moving -= 1
        self._own = self._own or moved
        self._tell_halt()

    def on_event(self, event: Event) -> None:
        """Something happened."""
        match event:
            case events.StateChanged():
                self._on_state(event.state)
            case events.LogpointSaid():
                self._on_logpoint(event)
            case events.BreakpointsChanged():
                self._on_breakpoints(event)
            case events.WrittenInside() | events.ValueWritten() | events.ForcesChanged():
                if self._started and self._shown is not None and self._plc.client.supports_invalidated_event:
                    self._send("invalidated", {"areas": ["variables"]})
            case _:
                pass

    def say(self, text: str, category: str = "console") -> None:
        """A line for the client's console."""
        self._send("output", {"category": category, "output": f"{text}\n"})

    # ---- halts ----------------------------------------------------------------------------------------------------

    def _on_state(self, state: PlcState) -> None:
        before, self._word = self._word, state.state
        self._tell_halt()
        if state.state == before:
            return
        if state.state in _GONE:
            text = state.message or _GONE[state.state]
            self.say(text, "important")
            if state.state != "restarting":
                self._on_gone(text)
        elif state.state in ("silent", "no_space"):
            self.say(state.message, "important")
        elif state.state in ("trapped", "fatal"):
            self.say(f"the program is stopped: {state.message}", "important")

    def _tell_halt(self) -> None:
        """As the PLC is now: what was between is not worth telling."""
        if not self._started or self._moving:
            return
        state = self._plc.session.state
        halt = state.halt
        key = None if halt is None else (state.pid, halt.number)
        if key == self._shown:
            return
        self._shown = key
        self._plc.handles.clear()
        if halt is not None:
            self._send("stopped", self._stopped(halt))
            self._own = False
        elif not self._own:  # of its own requests the client knows
            self._send("continued", {"threadId": PLC, "allThreadsContinued": True})

    def _stopped(self, halt: Halt) -> Body:
        plc = self._plc
        thread = plc.threads.id(halt.task)
        mine = {each.breakpoint.id for each in plc.session.debugging.verdicts if each.breakpoint.group == plc.group}
        hit = [id for id in halt.breakpoints if id in mine]
        functions = {each.id for file in (*plc.functions.values(), plc.leaving) for each in file}
        at = hit or halt.breakpoints
        return {
            "reason": _reason(halt, bool(at) and functions.issuperset(at)), "description": _description(halt),
            "text": halt.text, "threadId": thread, "allThreadsStopped": True, "hitBreakpointIds": hit,
            "scanbench": {
                "number": halt.number, "reason": halt.reason, "by": halt.by, "scan": halt.scan, "count": halt.count,
                "pou": halt.pou, "instance": halt.instance, "task": halt.task, "past": halt.past,
            },
        }  # fmt: skip

    # ---- breakpoints ----------------------------------------------------------------------------------------------

    def _on_logpoint(self, event: events.LogpointSaid) -> None:
        plc, said = self._plc, event.said
        owner = next(
            (each.breakpoint for each in plc.session.debugging.verdicts if each.breakpoint.id == said.breakpoint), None
        )
        if owner is None or owner.group != plc.group:
            return
        body: Body = {
            "category": "console", "output": f"{said.text}\n",
            "scanbench": {"breakpoint": said.breakpoint, "scan": said.scan},
        }  # fmt: skip
        if said.file:
            body |= {"source": plc.paths.source(said.file), **plc.span(said.line, 1)}
        self._send("output", body)

    def _on_breakpoints(self, event: events.BreakpointsChanged) -> None:
        """Those that the client knows, where it knows something else of them."""
        known = self._plc.known
        for verdict in event.verdicts:
            id = verdict.breakpoint.id
            if id not in known:
                continue
            body = described(self._plc, verdict)
            if body != known[id]:
                known[id] = body
                self._send("breakpoint", {"reason": "changed", "breakpoint": body})
        now = {verdict.breakpoint.id for verdict in event.verdicts}
        for id in [id for id in known if id not in now]:
            self._send("breakpoint", {"reason": "removed", "breakpoint": known.pop(id)})


def _reason(halt: Halt, by_function: bool) -> str:
    if halt.reason in _EXCEPTIONS:
        return "exception"
    if halt.reason == "breakpoint" and by_function:
        return "function breakpoint"
    return "breakpoint" if halt.reason == "scan" else halt.reason


def _description(halt: Halt) -> str:
    """What a client shows in one line: with the text, and that it is the past."""
    return f"{halt.text} (in the past, scan {halt.scan})" if halt.past else halt.text
