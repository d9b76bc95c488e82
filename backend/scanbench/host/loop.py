"""The host's main thread: the scan loop, and the seam between two runs of the engine.

The engine runs without the GIL until it is knocked: by a message that wants something, or by the tick that takes value
frames and state. Everything that touches the image is here, in one thread.
"""

import threading
from collections import deque
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.engine import Reason
from scanbench.faults.carried import why_not_carried
from scanbench.faults.inject import ACTIVE, Active
from scanbench.host.covering import Covering
from scanbench.host.debugcode import Debuggable, Probed
from scanbench.host.debugging import Debugging
from scanbench.host.link import Link
from scanbench.host.observed import Observable
from scanbench.host.pacer import MAX_SPEED, Pacer
from scanbench.host.programs import HostPrograms
from scanbench.host.run_files import run_limit
from scanbench.host.services import Services
from scanbench.host.swaps import BuildRefused, Copied, Optimising, Recode, Swap
from scanbench.host.traces import Traces
from scanbench.program.program import Program
from scanbench.recording.timeline import PAST, Timeline
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.header import Mode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.resource import Resource, not_kept
from scanbench.runtime.rights import Right, may
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import host as protocol
from scanbench.wire.codec import BadMessage, pack_body, unpack
from scanbench.wire.debugging import DebugRequest
from scanbench.wire.traces import DefineTrace, DriveTrace


class Loop:
    """Runs one PLC, and serves what comes from the parent between scans."""

    def __init__(
        self, timeline: Timeline, programs: HostPrograms, link: Link, start: protocol.Start, note: str,
        tiers: Optimising | None = None,
    ) -> None:  # fmt: skip
        self.timeline, self.programs = timeline, programs
        self._link = link
        self._inbox: deque[object] = deque()
        self._wake = threading.Event()
        self._tick = True
        self._quit = self._rested = False
        self._kept = driven = start.driven or driven_of(timeline)
        self._pacer = Pacer(self.resource.program.interval_ns, driven.speed, driven.paused, start.cpu_percent)
        self._go_on(driven)
        self.debugging = Debugging(timeline, link, Covering(timeline, programs.sources))
        self._debugger = self.debugging.debugger
        if driven.halted:
            self._debugger.stand("it was halted in this scan when its process ended")
        self._services = Services(timeline, self._pacer, link, note, tiers, programs.sources, self._debugger)
        self.traces = Traces(timeline, link)

    @property
    def resource(self) -> Resource:
        """What is shown: the PLC, or its past."""
        return self.timeline.resource

    def _go_on(self, driven: protocol.Driven) -> None:
        """To where the last life of this PLC was asked to run."""
        if driven.paused or (driven.end is None and driven.condition is None):
            return
        scan, condition = self.resource.header.scan, None
        if driven.condition is not None:
            compiled = compile_condition(self.resource.program, driven.condition)
            if not isinstance(compiled, Condition):
                self._pacer.lose(f"paused: the program has no meaning for {driven.condition}")
                return
            condition = compiled
        left = None if driven.end is None else driven.end - scan
        if left is not None and left <= 0:
            self._pacer.lose(f"stopped at scan {scan}, as asked for")
            return
        self.timeline.stop_when(condition)
        self._pacer.run_on(scan, left, condition)

    # ---- from other threads ---------------------------------------------------------------------------------------

    @property
    def live_program(self) -> Program:
        """The program that runs, also while the past is shown."""
        return self.timeline.live.program

    def previous_sources(self) -> protocol.Sources | None:
        """What ran before the last change of the program; None where there was none."""
        version = self._services.previous_version
        return None if version is None else self.programs.sources(version)

    def change_refusal(self, new: Program) -> str:
        """Why the program cannot be changed to this one now; empty when it can. In any thread: by what was told last."""
        standing = self._services.standing
        return self._change_refusal(new, {} if standing is None else standing.errors)

    def _change_refusal(self, new: Program, present: Mapping[str, Active]) -> str:
        if self.timeline.past:
            return PAST
        header = self.resource.header
        if header.halted_by_trap:  # it starts anew with the new one
            return ""
        refusal = may(header.mode, Right.TRANSFER if header.mode is Mode.PROGRAM else Right.CHANGE)
        return refusal.message if refusal is not None else why_not_carried(present, self.live_program, new)

    def give(self, message: object) -> None:
        """Hands over a message; the engine comes back for it after the current scan."""
        self._inbox.append(message)
        self._knock()

    def tick(self) -> None:
        """Time for frames and state."""
        self._tick = True
        self._knock()

    def tick_ns(self) -> int:
        """How soon the next tick is wanted."""
        return self._services.tick_ns

    def _knock(self) -> None:
        self.resource.engine.knock()
        self._wake.set()

    # ---- the loop -------------------------------------------------------------------------------------------------

    def run(self) -> None:
        """Runs scans until `Quit`."""
        while self._served():
            if self._tick:
                self._tick = False
                self._note_driven()
                self._services.tick()
                self.debugging.tick()
                self.traces.tick()
            if self._debugger.moving:
                self._move()
            elif self._stands():
                self._wake.wait()
                self._wake.clear()
                self._rested = True
            elif rest := self._pacer.rest_s:
                self._wake.wait(rest)
                self._wake.clear()
            else:
                if self._rested:  # what was missed meanwhile is not late
                    self._rested = False
                    self._pacer.set_pace(self.resource.program.interval_ns)
                self._run()
        self._note_driven()
        self.timeline.close()

    def _stands(self) -> bool:
        """Whether there is nothing to run, or nothing may: what it does by itself could not be kept."""
        halted = self._debugger.halt is not None or bool(self.timeline.recording.trouble)
        return self.timeline.past or halted or not self.resource.runnable or self._pacer.paused

    def _served(self) -> bool:
        """Serves what was given; false after `Quit`."""
        while self._inbox:
            self._serve(self._inbox.popleft())
        return not self._quit

    def _run(self) -> None:
        resource, pacer = self.resource, self._pacer
        first, busy = resource.header.scan, resource.measured.busy_ns
        stop = self._debugger.run(pacer.scans, pacer.pace)
        self.traces.drain()
        scan = resource.header.scan
        pacer.ran(scan - first, stop.reason is Reason.CONDITION, scan)
        if pacer.paused:
            self.timeline.stop_when(None)
        if pacer.paused or stop.reason is Reason.HALTED:
            self._tick = True
        pacer.worked(resource.measured.busy_ns - busy)

    def _serve(self, message: object) -> None:
        match message:
            case protocol.Submit():
                self._entered(message.ref, self._debugger.submit(message.command))
            case protocol.Drive():
                self._drive(message)
            case _ if isinstance(message, DebugRequest | Debuggable | Probed):
                self._debug(message)
            case protocol.Travel():
                self._travel(message)
            case protocol.Copy():
                self._copy(message)
            case Copied():
                self._answer(message.ref, message.refusal, "written")
            case Swap():
                self._swap(message)
            case Observable():
                self._observe(message)
            case Recode():
                self._recode(message)
            case BuildRefused():
                self._ack(message.ref, False, message.message)
            case protocol.SetLimits():
                self.timeline.recording.set_limit(run_limit(message.run_mib))
                self._pacer.cpu_percent = message.cpu_percent
            case DefineTrace() | DriveTrace():
                self.traces.serve(message)
            case protocol.Quit():
                self._quit = True
            case _:
                self._services.serve(message)
                self._tick = True

    # ---- answers --------------------------------------------------------------------------------------------------

    def _ack(self, ref: int, ok: bool, message: str, near: tuple[str, ...] = ()) -> None:
        self._services.entered()
        self._link.post(protocol.Ack(ref, ok, message, self.resource.header.scan, near))
        self._tick = True

    def _answer(self, ref: int, refusal: Refusal | None, message: str) -> None:
        if refusal is None:
            self._ack(ref, True, message)
        else:
            self._ack(ref, False, refusal.message, refusal.near)

    def _entered(self, ref: int, outcome: Entry | Refusal) -> None:
        if isinstance(outcome, Refusal):
            self._answer(ref, outcome, "")
        else:
            self._ack(ref, True, outcome.plan.message)

    # ---- pace -----------------------------------------------------------------------------------------------------

    def _driven(self) -> protocol.Driven:
        """How the PLC is driven now. A step that is under way ends in a halt."""
        pacer, condition = self._pacer, self._pacer.condition
        halted = self._debugger.stands or self._debugger.stepping
        text = condition.text if condition is not None else None
        return protocol.Driven(pacer.speed, pacer.paused, pacer.end, text, halted)

    def _keep(self, driven: protocol.Driven) -> Refusal | None:
        """Keeps how the PLC is to be driven, before it is."""
        if driven != self._kept:
            try:
                self.timeline.drive(pack_body(driven))
            except OSError as error:
                return not_kept(error)
            self._kept = driven
        return None

    def _note_driven(self) -> None:
        """Keeps what it came to by itself: a halt, the end that was asked for. Where it cannot be kept, at the next tick."""
        if not self.timeline.recording.trouble:
            self._keep(self._driven())

    def _no_room(self) -> Refusal | None:
        """Why no scan may run now, if so."""
        if self.timeline.recording.trouble:
            self.timeline.note()
        trouble = self.timeline.recording.trouble
        return Refusal(f"no space: {trouble}. Make room on the disk, then try again") if trouble else None

    def _drive(self, drive: protocol.Drive) -> None:
        said = self._drive_action(drive, self._pacer.speed if drive.speed is None else drive.speed)
        if isinstance(said, Refusal):
            self._answer(drive.ref, said, "")
            return
        if drive.speed is not None and drive.speed != self._pacer.speed:
            self._pacer.speed = drive.speed
            self._pacer.set_pace(self.resource.program.interval_ns)
        self.timeline.note()  # a scan that was run by hand is there again after whatever comes
        speed = "as fast as possible" if self._pacer.speed == MAX_SPEED else f"speed x{self._pacer.speed:g}"
        self._ack(drive.ref, True, f"{said}, {speed}" if said else speed)

    def _drive_action(self, drive: protocol.Drive, speed: float) -> str | Refusal:
        if drive.action == "speed":
            return self._keep(replace(self._driven(), speed=speed)) or ""
        if drive.action == "pause":
            refusal = self._keep(protocol.Driven(speed, paused=True, halted=self._debugger.stands))
            if refusal is not None:
                return refusal
            self._pacer.pause()
            self._debugger.forget_step()
            return "pause"
        if self.timeline.past:
            if drive.action != "scan":
                return Refusal(PAST)
            return self._scan_on() or "one scan on"
        if not self.resource.runnable:
            return Refusal(f"the program is stopped: {self._services.state.message}")
        if drive.action == "scan":
            halted = self._debugger.stands
            wanted = replace(self._driven(), speed=speed) if halted else protocol.Driven(speed, paused=True)
            return self._no_room() or self._keep(wanted) or self._single(drive.author)
        condition: Condition | None = None
        if drive.until is not None:
            compiled = compile_condition(self.resource.program, drive.until)
            if not isinstance(compiled, Condition):
                return Refusal(compiled.message, compiled.near)
            condition = compiled
        end = None if drive.scans is None else self.resource.header.scan + drive.scans
        refusal = self._no_room() or self._keep(protocol.Driven(speed, False, end, drive.until))
        if refusal is not None:
            return refusal
        self.timeline.stop_when(condition)
        self._pacer.run_on(self.resource.header.scan, drive.scans, condition)
        if self._debugger.halt is not None:
            self._debugger.step("continue", drive.author)
        return f"continue: {self._pacer.target}" if self._pacer.target else "continue"

    def _scan_on(self) -> Refusal | None:
        """One scan on in the past."""
        program = self.resource.program
        refusal = self.timeline.step()
        if refusal is None:
            self._debugger.travelled()
            self._shown_moved(program)
        return refusal

    def _single(self, author: str) -> str | Refusal:
        """One scan, whatever knocks meanwhile; from a halt to the first statement of the next one."""
        if self._debugger.halt is not None:
            return self._debugger.step("scan", author) or "one scan"
        self._pacer.pause()
        self.timeline.stop_when(None)
        scan = self.resource.header.scan
        while self.resource.runnable and self.resource.header.scan == scan:
            if self._debugger.run(1).reason in (Reason.TRAP, Reason.HALTED):
                break
        self._pacer.set_pace(self.resource.program.interval_ns)
        return "one scan"

    # ---- the debugger ---------------------------------------------------------------------------------------------

    def _debug(self, message: DebugRequest | Debuggable | Probed) -> None:
        self._tick = True
        if isinstance(message, Probed):
            self._debugger.take_probed(message.loaded, message.engine)
        elif isinstance(message, Debuggable):
            for waiting in self.debugging.on_ready(message):
                self._serve(waiting)
        elif self.debugging.ready(message):
            if isinstance(message, debug_protocol.Step):
                self._step(message)
            else:
                self.debugging.serve(message)
                self._services.entered()

    def _move(self) -> None:
        """Goes on with a step in the past."""
        program = self.resource.program
        self._debugger.move()
        self._shown_moved(program)
        self._tick = True

    def _shown_moved(self, program: Program) -> None:
        """Perhaps another program is shown."""
        if not self.timeline.past:
            self._services.past_by = ""
        if self.resource.program is not program:
            self._services.moved()
            self.traces.moved()

    def _step(self, step: debug_protocol.Step) -> None:
        """A step of a PLC that runs halts it first, at its next statement."""
        debugger, pacer = self._debugger, self._pacer
        runs = not self._stands()
        action = step.action
        if action not in ("back", "reverse") and not self.timeline.past:
            wanted = replace(self._driven(), paused=False, halted=action != "continue")
            refusal = self._no_room() or self._keep(wanted)
            if refusal is not None:
                self._answer(step.ref, refusal, "")
                return
        if action in ("back", "reverse"):
            if runs:
                pacer.pause()
                debugger.forget_step()
            self._services.past_by = self._services.past_by or step.author
        elif action == "continue" and runs:
            self._ack(step.ref, True, "it runs")
            return
        elif runs and action in ("over", "out", "scan"):
            action = "in"
        program = self.resource.program
        refusal = debugger.step(action, step.author, step.file, step.line, step.path)
        if refusal is None and not self.timeline.past:
            pacer.go()
        self._shown_moved(program)
        self._answer(step.ref, refusal, action)

    # ---- time travel ----------------------------------------------------------------------------------------------

    def _travel(self, travel: protocol.Travel) -> None:
        program = self.resource.program
        if travel.scan is None:
            self.timeline.return_live()
            self._services.past_by = ""
            self._pacer.set_pace(self.resource.program.interval_ns)
            refusal = None
        else:
            refusal = self.timeline.goto(travel.scan, travel.count)
            self._services.past_by = travel.author if self.timeline.past else ""
        self._debugger.travelled()
        if self.resource.program is not program:
            self._services.moved()
            self.traces.moved()
        self.programs.drop_idle(self.timeline.version, self.timeline.live_version)
        self._answer(travel.ref, refusal, f"scan {self.resource.header.scan}" if travel.scan is not None else "live")

    def _copy(self, copy: protocol.Copy) -> None:
        """Writing takes a while, and another thread."""

        def done(refusal: Refusal | None) -> None:
            self.give(Copied(copy.ref, refusal))

        self.timeline.copy(Path(copy.path), copy.scan, copy.author, done)

    # ---- program --------------------------------------------------------------------------------------------------

    def _swap(self, swap: Swap) -> None:
        refused = self._change_refusal(swap.loaded.program, self.resource.journal.derived(ACTIVE))
        if refused:  # before it is kept in the run
            self._ack(swap.ref, False, refused)
            return
        self.programs.put(swap.loaded, swap.sources)
        if swap.loaded.version not in self.timeline.recording.programs:
            refusal = self.timeline.add_program(swap.loaded.version, pack_body(swap.sources))
            if refusal is not None:
                self._answer(swap.ref, refusal, "")
                return
        outcome = self._debugger.submit(ProgramChange(swap.author, swap.loaded.version))
        if not isinstance(outcome, Refusal):
            self._moved()
        self._entered(swap.ref, outcome)

    def _moved(self) -> None:
        """Another program runs: its places, pace and conditions are others."""
        self._pacer.set_pace(self.resource.program.interval_ns)
        condition = self._pacer.condition
        if condition is not None and self.timeline.condition is None:
            self._pacer.lose(f"paused: the new program has no meaning for {condition.text}")
        else:
            self._pacer.condition = self.timeline.condition
        self.programs.drop_idle(self.timeline.version, self.timeline.live_version)
        self._services.moved()
        self.debugging.moved()
        self.traces.moved()

    def _observe(self, observable: Observable) -> None:
        loaded, then = self.timeline.live, observable.then
        if loaded.version != observable.version:
            self._ack(
                then.ref, False, "the program was changed meanwhile: see where the statement is now, and arm again"
            )
            return
        loaded.fresh = observable.program
        self._entered(then.ref, self._debugger.submit(then.command))

    def _recode(self, recode: Recode) -> None:
        if recode.engine is not None:
            self.programs.recode(recode.program, recode.engine)


def driven_of(timeline: Timeline) -> protocol.Driven:
    """How the run file says that the PLC is driven; as usual where it does not say that."""
    kept = timeline.recording.driven
    try:
        driven = unpack(kept) if kept else None
    except BadMessage:
        driven = None
    match driven:
        case protocol.Driven(int() | float(), bool(), int() | None, str() | None, bool()):
            return driven
        case _:
            return protocol.Driven()
