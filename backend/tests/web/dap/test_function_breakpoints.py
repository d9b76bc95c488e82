"""A halt that comes while function breakpoints are being set or taken away is one of theirs."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TypeVar, cast

from scanbench.debug.breakpoint import Breakpoint, Verdict
from scanbench.debug.halt import Halt
from scanbench.session.debugging import Debugging
from scanbench.session.session import Session
from scanbench.web.dap.breakpoints import on_set_function_breakpoints
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.events import Events
from scanbench.web.dap.paths import ProjectPaths
from scanbench.web.dap.shapes import Body, FunctionBreakpoint, SetFunctionBreakpoints
from scanbench.wire.debugging import BreakpointsAre, DebugRequest, PlaceInfo, Places, SetBreakpoints, WantPlaces
from scanbench.wire.host import PlcState, Sources

A = TypeVar("A")
POUS = {"Main.st": "Main", "Belt.st": "Belt"}


@dataclass
class Plc:
    """As much of a session as is needed; it answers when it is told to."""

    sources: Sources = field(default_factory=lambda: Sources("", dict.fromkeys(POUS, ""), 0, 1))
    state: PlcState = field(default_factory=lambda: PlcState("halted", "RUN", "", pid=1))
    at_set: Callable[[SetBreakpoints], None] = lambda _: None

    def __post_init__(self) -> None:
        self.debugging = Debugging(self.debug, lambda _: None, lambda _: None, ())
        self.instance = self  # and of its instance

    async def debug(self, make: Callable[[int], DebugRequest], answer: type[A]) -> A:
        found = self._found(make(1))
        assert isinstance(found, answer)
        return found

    def _found(self, asked: DebugRequest) -> BreakpointsAre | Places:
        if isinstance(asked, WantPlaces):
            return Places(1, (PlaceInfo(3, 1, 3, 9, POUS[asked.file]),))
        assert isinstance(asked, SetBreakpoints)
        self.at_set(asked)
        return BreakpointsAre(1, tuple(Verdict(each, True, "") for each in asked.breakpoints))


def test_a_halt_while_they_are_set_or_taken_away() -> None:
    plc, told = Plc(), list[Body]()
    debuggee = Debuggee(cast(Session, plc), "Ada", "tool", ProjectPaths(lambda: POUS))
    events = Events(debuggee, lambda _, body: told.append(body), lambda _: None)

    def halt_at(breakpoints: tuple[Breakpoint, ...]) -> None:
        ids = tuple(each.id for each in breakpoints)
        halt = Halt(len(told) + 1, "breakpoint", "", "Ada", ids, 5, 1, None, "Main", "Main", "Cyclic", False)
        plc.state = replace(plc.state, halt=halt)
        events.start()

    def on_set(asked: SetBreakpoints) -> None:
        before = [each.breakpoint for each in plc.debugging.verdicts if each.breakpoint.file == asked.file]
        halt_at(asked.breakpoints or tuple(gone for gone in known if gone.file == asked.file) or tuple(before))

    known: list[Breakpoint] = []
    plc.at_set = on_set
    names = SetFunctionBreakpoints(breakpoints=[FunctionBreakpoint(name=name) for name in ("Main", "belt")])
    asyncio.run(on_set_function_breakpoints(debuggee, names))
    known += [each.breakpoint for each in plc.debugging.verdicts]
    assert len(known) == 2
    assert [(each["reason"], each["hitBreakpointIds"]) for each in told] == [
        ("function breakpoint", [each.id]) for each in known
    ]
    asyncio.run(on_set_function_breakpoints(debuggee, names))  # the same: their ids stay
    assert [each.breakpoint for each in plc.debugging.verdicts] == known
    asyncio.run(on_set_function_breakpoints(debuggee, SetFunctionBreakpoints(breakpoints=[])))
    assert [each["reason"] for each in told] == ["function breakpoint"] * 6
    halt_at(tuple(known))  # somebody's, and no more theirs
    assert told[-1]["reason"] == "breakpoint"
