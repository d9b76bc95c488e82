"""Debugging in the process of a PLC: answers what the parent asks, in the loop's thread."""

from collections import deque
from collections.abc import Callable

from scanbench.check.typed.condition import BadCondition
from scanbench.check.typed.local import Locals
from scanbench.debug.assign import Assign
from scanbench.debug.binding import Bindings
from scanbench.debug.debugger import Debugger
from scanbench.debug.evaluate import evaluate
from scanbench.debug.frames import stack
from scanbench.debug.scene import NoFrame, Scene, at
from scanbench.debug.scopes import scopes, variables
from scanbench.debug.set_value import set_value
from scanbench.engines.interpreter.evaluate import NoValue
from scanbench.host.covering import Covering
from scanbench.host.debugcode import Debuggable, StandAgain
from scanbench.host.link import Link
from scanbench.host.log_throttle import LogThrottle
from scanbench.program.program import Program
from scanbench.recording.timeline import PAST, Timeline
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.resource import Resource
from scanbench.symbols.sites import Sites, sites_of
from scanbench.symbols.symbols import UnknownPath
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import host as protocol

_COUNTED_NS = 200_000_000
"""How often it is told that hits were counted, or that more was reached."""
_PLACES = 10_000
Submitted = Callable[[Command], Entry | Refusal]


class Debugging:
    """Answers `DebugRequest`s but `Step`, which is the loop's."""

    def __init__(self, timeline: Timeline, link: Link, covering: Covering) -> None:
        self._timeline, self._link, self._covering = timeline, link, covering
        self.log_throttle = LogThrottle(link)
        self.debugger = Debugger(timeline, self.log_throttle)
        self.submit: Submitted = self.debugger.submit
        self.build: Callable[[], None] = lambda: None
        """Begins to build debugged code, whose `Debuggable` comes to `on_ready`."""
        self._building = False
        self._waiting: deque[object] = deque()
        self._bindings: tuple[Program, Bindings] | None = None
        self._sites_known: tuple[Program, Sites] | None = None
        self._told_at = 0

    @property
    def _resource(self) -> Resource:
        return self._timeline.resource

    # ---- the debug flavour ----------------------------------------------------------------------------------------

    def ready(self, message: object) -> bool:
        """Whether it can be served now; else it is kept until there is debugged code."""
        if not self._needs_code(message):
            return True
        if not self._waiting and (self._timeline.live.debug is not None):
            return True
        self._waiting.append(message)
        if not self._building:
            self._building = True
            self.build()
        return False

    def on_ready(self, code: Debuggable) -> list[object]:
        """Takes it; what waited for it is to be served now."""
        self._building = False
        code.put_in_place()
        waiting = list(self._waiting)
        self._waiting.clear()
        if code.message:
            for message in waiting:
                self._ack(getattr(message, "ref", 0), False, code.message)
            return []
        if waiting and self._timeline.live.debug is None:  # a new program runs by now
            self._waiting.extend(waiting)
            self._building = True
            self.build()
            return []
        return waiting

    def _needs_code(self, message: object) -> bool:
        match message:
            case debug_protocol.SetBreakpoints():
                return bool(message.breakpoints or self.debugger.breakpoints.placed or self._waiting)
            case debug_protocol.SetCoverage():
                return message.on or bool(self._waiting)
            case debug_protocol.Step() | debug_protocol.WantPlaces() | debug_protocol.WantFlow() | StandAgain():
                return True
        return False

    # ---- requests -------------------------------------------------------------------------------------------------

    def serve(self, request: object) -> None:
        """Answers, whatever it is."""
        try:
            self._serve(request)
        except (NoFrame, NoValue) as error:
            self._ack(getattr(request, "ref", 0), False, str(error))

    def _serve(self, request: object) -> None:
        match request:
            case debug_protocol.SetBreakpoints():
                verdicts = self.debugger.set(request.group, request.kind, request.file, request.breakpoints)
                self._link.post(debug_protocol.BreakpointsAre(request.ref, verdicts))
            case debug_protocol.WantStack():
                if self.debugger.halt is None:
                    self._ack(request.ref, False, "the PLC is not halted: there are no calls to show")
                else:
                    self._link.post(debug_protocol.Stack(request.ref, stack(self.scene())))
            case debug_protocol.WantTasks():
                tasks = self._resource.view.statements.tasks
                self._link.post(debug_protocol.Tasks(request.ref, tuple(task.name for task in tasks)))
            case debug_protocol.WantScopes():
                self._link.post(debug_protocol.Scopes(request.ref, scopes(self.scene(), request.frame)))
            case debug_protocol.WantVariables():
                found, total = variables(
                    self.scene(), request.frame, request.scope, request.expression, request.start, request.count
                )
                self._link.post(debug_protocol.Variables(request.ref, found, total))
            case debug_protocol.Evaluate():
                self._evaluate(request)
            case debug_protocol.SetExpression():
                self._set(request)
            case debug_protocol.WantPlaces():
                self._places(request)
            case debug_protocol.WantBinding():
                self._binding(request)
            case debug_protocol.SetCoverage():
                self._covering.set(self.debugger, request.on, request.reset)
                self._ack(request.ref, True, "coverage is on" if request.on else "coverage is off")
                self._link.post(self._covering.answer(None))
            case debug_protocol.WantCoverage():
                self._resource.listening.look()
                self._link.post(self._covering.answer(request.ref))

    def scene(self) -> Scene:
        """What is shown now."""
        resource = self._resource
        frames = resource.listening.inside.frames if resource.listening.inside is not None else ()
        program = resource.view.statements
        return Scene(program, resource.memory, self._sites(), frames, self._timeline.past)

    def _sites(self) -> Sites:
        loaded = self._resource.loaded
        if loaded.debug is not None:
            return loaded.debug.sites
        if self._sites_known is None or self._sites_known[0] is not loaded.statements:
            self._sites_known = loaded.statements, sites_of(loaded.statements)
        return self._sites_known[1]

    def _evaluate(self, request: debug_protocol.Evaluate) -> None:
        scene = self.scene()
        if request.effects and _assigns(scene, request.frame, request.text):
            pou, instance = at(scene.frame(request.frame))
            name = "" if pou is None else pou.name
            outcome = self.submit(Assign(request.author, name, instance, request.text))
            if isinstance(outcome, Refusal):
                self._evaluated(request.ref, BadCondition(outcome.message, outcome.near))
            else:
                self._link.post(debug_protocol.Evaluated(request.ref, True, outcome.plan.message, None))
            return
        self._evaluated(request.ref, evaluate(scene, request.frame, request.text))

    def _set(self, request: debug_protocol.SetExpression) -> None:
        if self._timeline.past:
            self._evaluated(request.ref, BadCondition(PAST))
            return
        command = set_value(self.scene(), request.frame, request.target, request.value, request.author)
        if isinstance(command, BadCondition):
            self._evaluated(request.ref, command)
            return
        outcome = self.submit(command)
        if isinstance(outcome, Refusal):
            self._evaluated(request.ref, BadCondition(outcome.message, outcome.near))
            return
        self._evaluated(request.ref, evaluate(self.scene(), request.frame, request.target))

    def _evaluated(self, ref: int, found: object) -> None:
        if isinstance(found, BadCondition):
            self._link.post(debug_protocol.Evaluated(ref, False, found.message, None, found.near))
        else:
            assert isinstance(found, debug_protocol.VariableInfo)
            self._link.post(debug_protocol.Evaluated(ref, True, "", found))

    def _places(self, request: debug_protocol.WantPlaces) -> None:
        statements = self.debugger.placing.sites.statements
        found = [
            debug_protocol.PlaceInfo(
                each.span.line, each.span.column, each.span.end_line, each.span.end_column, each.pou
            )
            for each in statements
            if each.span.file == request.file and request.first <= each.span.line <= request.last
        ]
        self._link.post(debug_protocol.Places(request.ref, tuple(found[:_PLACES])))

    def _binding(self, request: debug_protocol.WantBinding) -> None:
        view = self._resource.view
        if self._bindings is None or self._bindings[0] is not view.statements:
            self._bindings = view.statements, Bindings(view.statements)
        try:
            bound = self._bindings[1].of(view, request.path, self._resource.listening.inside is not None)
        except UnknownPath as error:
            scan = self._resource.header.scan
            self._link.post(protocol.Ack(request.ref, False, error.message, scan, tuple(error.near)))
            return
        self._link.post(debug_protocol.BindingIs(request.ref, bound))

    # ---- at each tick ---------------------------------------------------------------------------------------------

    def tick(self) -> None:
        """Tells what was counted, said and reached; when the parent does not keep up, once it does."""
        now = monotonic_ns()
        if now < self._told_at or self._link.backlogged:
            return
        self._told_at = now + _COUNTED_NS
        self.log_throttle.catch_up()
        if self.debugger.changed:
            self.debugger.changed = False
            self._link.post(debug_protocol.BreakpointsAre(None, self.debugger.verdicts))
        if self.debugger.covering and not self._timeline.past:
            self._resource.listening.look()
            if self._covering.more:
                self._link.post(self._covering.answer(None))

    def moved(self) -> None:
        """Adapts to a new program after a program change."""
        self.debugger.moved()
        self._covering.moved(self.debugger)

    def _ack(self, ref: int, ok: bool, message: str) -> None:
        self._link.post(protocol.Ack(ref, ok, message, self._resource.header.scan))


def _assigns(scene: Scene, index: int | None, text: str) -> bool:
    """Whether the text is meant as assignments: what is wrong with them, they say themselves."""
    locals: Locals = scene.locals
    pou, _ = at(scene.frame(index))
    return ":=" in text and isinstance(locals.value(pou, text), BadCondition)
