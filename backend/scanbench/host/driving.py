"""How a PLC is driven: its pace, single scans, steps, and what is shown of its past. In the thread of the scan loop."""

from dataclasses import replace

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.debug.debugger import Debugger
from scanbench.debug.standing import halt_again
from scanbench.engines.engine import Reason
from scanbench.host.answers import Answers
from scanbench.host.pacer import MAX_SPEED, Pacer
from scanbench.host.services import Services
from scanbench.host.traces import Traces
from scanbench.program.program import Program
from scanbench.recording.timeline import PAST, Timeline
from scanbench.runtime.command import Refusal
from scanbench.runtime.resource import Resource, not_kept
from scanbench.verify.contract import BadRange
from scanbench.verify.ranges import resolve_range
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import host as protocol
from scanbench.wire.codec import BadMessage, pack_body, unpack_kept

HALTED_BEFORE = "it was halted in this scan when its process ended"


class Driving:
    """Serves who drives the PLC, and keeps in its run file how it is driven."""

    def __init__(
        self, timeline: Timeline, pacer: Pacer, debugger: Debugger, services: Services, answers: Answers, traces: Traces,
        driven: protocol.Driven,
    ) -> None:  # fmt: skip
        """`driven`: how the last life of this PLC was driven; it goes on so."""
        self._timeline, self._pacer, self._debugger = timeline, pacer, debugger
        self._services, self._answers, self._traces = services, answers, traces
        self._kept = driven
        self.stood = driven.count > 0 or driven.shown_count > 0
        """Whether it is not yet where it was before, as that takes debugged code."""
        self._go_on(driven)
        if driven.shown is not None:
            self._show(driven.shown, 0, driven.shown_by)

    @property
    def _resource(self) -> Resource:
        return self._timeline.resource

    def _go_on(self, driven: protocol.Driven) -> None:
        """To where the last life of this PLC was asked to run."""
        if driven.paused or (driven.end is None and driven.condition is None):
            return
        scan, condition = self._resource.header.scan, None
        if driven.condition is not None:
            compiled = compile_condition(self._resource.program, driven.condition)
            if not isinstance(compiled, Condition):
                self._pacer.lose(f"paused: the program has no meaning for {driven.condition}")
                return
            condition = compiled
        left = None if driven.end is None else driven.end - scan
        if left is not None and left <= 0:
            self._pacer.lose(f"stopped at scan {scan}, as asked for")
            return
        self._resource.waiting.until = () if condition is None else (condition,)
        self._pacer.run_on(scan, left, condition)

    # ---- how it is driven -----------------------------------------------------------------------------------------

    @property
    def waits(self) -> bool:
        """Whether there is nothing to run, or nothing may: what it does by itself could not be kept."""
        halted = self._debugger.halt is not None or bool(self._timeline.recording.trouble)
        return self._timeline.past or halted or not self._resource.runnable or self._pacer.paused

    def stand_again(self) -> None:
        """Halts before the statement, and shows the one of the past, as before; unless somebody has driven it meanwhile."""
        if not self.stood:
            return
        self.stood, kept = False, self._kept
        if kept.count and self._debugger.live_halt is not None:
            self._timeline.return_live()
            halt_again(self._debugger, self._timeline, kept.count, HALTED_BEFORE)
        if kept.shown is not None:
            self._show(kept.shown, kept.shown_count, kept.shown_by)

    def _show(self, scan: int, count: int, by: str) -> Refusal | None:
        """A scan of the past, or a statement of it."""
        program = self._resource.program
        refusal = self._timeline.goto(scan, count)
        self._services.past_by = by if self._timeline.past else ""
        self._travelled(program)
        return refusal

    def _travelled(self, program: Program) -> None:
        """From a scan in which this program ran."""
        self._debugger.travelled()
        if self._resource.program is not program:
            self._services.moved()
            self._traces.moved()

    def _driven(self) -> protocol.Driven:
        """How the PLC is driven now. A step that is under way ends in a halt."""
        if self.stood:
            return self._kept
        pacer, condition = self._pacer, self._pacer.condition
        halt = self._debugger.live_halt
        halted = halt is not None or self._debugger.stepping
        text = condition.text if condition is not None else None
        driven = protocol.Driven(pacer.speed, pacer.paused, pacer.end, text, halted, 0 if halt is None else halt.count)
        if not self._timeline.past:
            return driven
        inside = self._resource.listening.inside
        return replace(
            driven, shown=self._resource.header.scan, shown_count=0 if inside is None else inside.count,
            shown_by=self._services.past_by,
        )  # fmt: skip

    def _keep(self, driven: protocol.Driven) -> Refusal | None:
        """Keeps how the PLC is to be driven, before it is."""
        if driven != self._kept:
            try:
                self._timeline.drive(pack_body(driven))
            except OSError as error:
                return not_kept(error)
            self._kept = driven
        return None

    def note(self) -> None:
        """Keeps what it came to by itself: a halt, the end that was asked for. Where it cannot be kept, at the next tick."""
        if not self._timeline.recording.trouble:
            self._keep(self._driven())

    def _no_room(self) -> Refusal | None:
        """Why no scan may run now, if so."""
        if self._timeline.recording.trouble:
            self._timeline.note()
        trouble = self._timeline.recording.trouble
        return Refusal(f"no space: {trouble}. Make room on the disk, then try again") if trouble else None

    def drive(self, drive: protocol.Drive) -> None:
        """Speed, pause, one scan, or on: it is kept before it is done."""
        if drive.action in ("scan", "continue"):
            self.stood = False
        said = self._drive_action(drive, self._pacer.speed if drive.speed is None else drive.speed)
        if isinstance(said, Refusal):
            self._answers.answer(drive.ref, said, "")
            return
        if drive.speed is not None and drive.speed != self._pacer.speed:
            self._pacer.speed = drive.speed
            self._pacer.set_pace(self._resource.program.interval_ns)
        self._timeline.note()  # a scan that was run by hand is there again after whatever comes
        speed = "as fast as possible" if self._pacer.speed == MAX_SPEED else f"speed x{self._pacer.speed:g}"
        self._answers.ack(drive.ref, True, f"{said}, {speed}" if said else speed)

    def _drive_action(self, drive: protocol.Drive, speed: float) -> str | Refusal:
        if drive.action == "speed":
            return self._keep(replace(self._driven(), speed=speed)) or ""
        if drive.action == "pause":
            refusal = self._keep(
                replace(
                    self._driven(),
                    speed=speed,
                    paused=True,
                    end=None,
                    condition=None,
                    halted=self._debugger.live_halt is not None,
                )
            )
            if refusal is not None:
                return refusal
            self._pacer.pause()
            self._debugger.forget_step()
            return "pause"
        if self._timeline.past:
            if drive.action != "scan":
                return Refusal(PAST)
            return self._scan_on() or "one scan on"
        if not self._resource.runnable:
            return Refusal(f"the program is stopped: {self._services.state.message}")
        if drive.action == "scan":
            halted = self._debugger.live_halt is not None
            wanted = replace(self._driven(), speed=speed) if halted else protocol.Driven(speed, paused=True)
            return self._no_room() or self._keep(wanted) or self._single(drive.author)
        condition: Condition | None = None
        if drive.until is not None:
            compiled = compile_condition(self._resource.program, drive.until)
            if not isinstance(compiled, Condition):
                return Refusal(compiled.message, compiled.near)
            condition = compiled
        end = None if drive.scans is None else self._resource.header.scan + drive.scans
        refusal = self._no_room() or self._keep(protocol.Driven(speed, False, end, drive.until))
        if refusal is not None:
            return refusal
        self._resource.waiting.until = () if condition is None else (condition,)
        self._pacer.run_on(self._resource.header.scan, drive.scans, condition)
        if self._debugger.halt is not None:
            self._debugger.step("continue", drive.author)
        else:
            self._debugger.forget_step()
        return f"continue: {self._pacer.target}" if self._pacer.target else "continue"

    def _scan_on(self) -> Refusal | None:
        """One scan on in the past."""
        program = self._resource.program
        refusal = self._timeline.step()
        if refusal is None:
            self._debugger.travelled()
            self._shown_moved(program)
        return refusal

    def _single(self, author: str) -> str | Refusal:
        """One scan, whatever interrupts meanwhile; from a halt to the first statement of the next one."""
        if self._debugger.halt is not None:
            return self._debugger.step("scan", author) or "one scan"
        self._pacer.pause()
        self._resource.waiting.until = ()
        scan = self._resource.header.scan
        while self._resource.runnable and self._resource.header.scan == scan:
            if self._debugger.run(1).reason in (Reason.TRAP, Reason.HALTED):
                break
        self._pacer.set_pace(self._resource.program.interval_ns)
        return "one scan"

    # ---- steps ----------------------------------------------------------------------------------------------------

    def move(self) -> None:
        """Goes on with a step in the past."""
        program = self._resource.program
        self._debugger.move()
        if self._timeline.past:
            self.note()
        self._shown_moved(program)

    def _shown_moved(self, program: Program) -> None:
        """Adapts to the program that is shown, if it changed."""
        if not self._timeline.past:
            self._services.past_by = ""
        if self._resource.program is not program:
            self._services.moved()
            self._traces.moved()

    def step(self, step: debug_protocol.Step) -> None:
        """A step of a PLC that runs halts it first, at its next statement."""
        self.stood = False
        debugger, pacer = self._debugger, self._pacer
        runs = not self.waits
        action = step.action
        if action not in ("back", "reverse") and not self._timeline.past:
            wanted = replace(self._driven(), paused=False, halted=action != "continue", count=0)
            refusal = self._no_room() or self._keep(wanted)
            if refusal is not None:
                self._answers.answer(step.ref, refusal, "")
                return
        if action in ("back", "reverse"):
            if runs:
                pacer.pause()
                debugger.forget_step()
            self._services.past_by = self._services.past_by or step.author
        elif action == "continue" and runs:
            debugger.forget_step()
            self._answers.ack(step.ref, True, "it runs")
            return
        elif runs and action in ("over", "out", "scan"):
            action = "in"
        program = self._resource.program
        try:
            within = None if step.range is None else resolve_range(program, debugger.placing.sites, step.range)
        except BadRange as bad:  # a different program runs by now
            self._answers.answer(step.ref, Refusal(str(bad), bad.near), action)
            return
        refusal = debugger.step(action, step.author, step.file, step.line, step.path, within)
        if refusal is None and not self._timeline.past:
            pacer.go()
        if self._timeline.past:
            self.note()  # before anybody sees it: a process that is killed now comes back showing it
        self._shown_moved(program)
        self._answers.answer(step.ref, refusal, action)

    # ---- time travel ----------------------------------------------------------------------------------------------

    def travel(self, travel: protocol.Travel) -> None:
        """Shows a scan of the past, or the live PLC; one that is not yet where it was halted before gets there all the same."""
        refusal = None
        if travel.scan is None:
            program = self._resource.program
            self._timeline.return_live()
            self._services.past_by = ""
            self._pacer.set_pace(self._resource.program.interval_ns)
            self._travelled(program)
        else:
            refusal = self._show(travel.scan, travel.count, travel.author)
        if self.stood and refusal is None:
            by = "" if travel.scan is None else travel.author
            self._keep(replace(self._kept, shown=travel.scan, shown_count=travel.count, shown_by=by))
            self.stood = self._kept.count > 0 or self._kept.shown_count > 0
        self.note()
        self._answers.answer(
            travel.ref, refusal, f"scan {self._resource.header.scan}" if travel.scan is not None else "live"
        )


def driven_of(timeline: Timeline) -> protocol.Driven:
    """How the run file says that the PLC is driven; as usual where it does not say that."""
    kept = timeline.recording.driven
    try:
        driven = unpack_kept(kept) if kept else None
    except BadMessage:
        driven = None
    match driven:
        case protocol.Driven(
            int() | float(), bool(), int() | None, str() | None, bool(), int(), int() | None, int(), str()
        ):
            return driven
        case _:
            return protocol.Driven()
