"""The host's main thread: the scan loop, and the seam between two runs of the engine.

The engine runs without the GIL until it is interrupted: by a message that wants something, or by the tick that takes value
frames and state. Everything that touches the image is here, in one thread.
"""

import threading
from collections import deque
from collections.abc import Mapping
from pathlib import Path

from scanbench.engines.engine import Reason
from scanbench.faults.carried import why_not_carried
from scanbench.faults.inject import ACTIVE
from scanbench.faults.network import NetworkRequest
from scanbench.faults.present import Active
from scanbench.host.answers import Answers
from scanbench.host.communication import Communication
from scanbench.host.covering import Covering
from scanbench.host.debugcode import Debuggable, Probed, StandAgain
from scanbench.host.debugging import Debugging
from scanbench.host.driving import HALTED_BEFORE, Driving, driven_of
from scanbench.host.flows import FlowsOf
from scanbench.host.link import Link
from scanbench.host.lookup import words_found
from scanbench.host.observed import Observable
from scanbench.host.pacer import Pacer
from scanbench.host.programs import HostPrograms
from scanbench.host.run_files import run_limit
from scanbench.host.services import Services
from scanbench.host.swaps import BuildRefused, Copied, Optimising, Recode, Swap
from scanbench.host.traces import Traces
from scanbench.program.program import Program
from scanbench.recording.timeline import PAST, Timeline
from scanbench.runtime.command import Refusal
from scanbench.runtime.header import Mode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.resource import Resource
from scanbench.runtime.rights import Right, may
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import host as protocol
from scanbench.wire.codec import pack_body
from scanbench.wire.debugging import DebugRequest
from scanbench.wire.memory import FindWords
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
        self._quit, self._rested = False, True
        driven = start.driven or driven_of(timeline)
        self._pacer = Pacer(self.resource.program.interval_ns, driven.speed, driven.paused, start.cpu_percent)
        self.debugging = Debugging(timeline, link, Covering(timeline, programs.sources))
        self._debugger = self.debugging.debugger
        if driven.halted:
            self._debugger.halt_at_start(HALTED_BEFORE)
        self._services = Services(timeline, self._pacer, link, note, tiers, programs.sources, self._debugger)
        self.traces = Traces(timeline, link)
        self._answers = Answers(timeline, self._services, link, self._wants_tick)
        self._flows = FlowsOf(timeline, link, self._debug)
        self._communication = Communication(timeline, self._debugger, self._services, link)
        self._driving = Driving(
            timeline, self._pacer, self._debugger, self._services, self._answers, self.traces, driven
        )

    @property
    def resource(self) -> Resource:
        """What is shown: the PLC, or its past."""
        return self.timeline.resource

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
        in_effect = self._services.in_effect
        return self._change_refusal(new, {} if in_effect is None else in_effect.errors)

    def _change_refusal(self, new: Program, present: Mapping[str, Active]) -> str:
        if self.timeline.past:
            return PAST
        header = self.resource.header
        if header.halted_by_trap:  # it starts again with the new one
            return ""
        refusal = may(header.mode, Right.TRANSFER if header.mode is Mode.PROGRAM else Right.CHANGE)
        return refusal.message if refusal is not None else why_not_carried(present, self.live_program, new)

    def give(self, message: object) -> None:
        """Hands over a message; the engine comes back for it after the current scan."""
        self._inbox.append(message)
        self._interrupt()

    def tick(self) -> None:
        """Time for frames and state."""
        self._tick = True
        self._interrupt()

    def tick_ns(self) -> int:
        """How soon the next tick is wanted."""
        return self._services.tick_ns

    def _wants_tick(self) -> None:
        self._tick = True

    def _interrupt(self) -> None:
        self.resource.engine.interrupt()
        self._wake.set()

    # ---- the loop -------------------------------------------------------------------------------------------------

    def run(self) -> None:
        """Runs scans until `Quit`."""
        if self._driving.stood:
            self._serve(StandAgain())
        while self._served():
            if self._tick:
                self._tick = False
                self._driving.note()
                self._services.tick()
                self.debugging.tick()
                self.traces.tick()
            if self._debugger.moving:
                self._driving.move()
                self._tick = True
            elif self._driving.waits:
                if self._flows.waiting:
                    self._flows.answer()
                    continue
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
        self._driving.note()
        self.timeline.close()

    def _served(self) -> bool:
        """Serves what was given; false after `Quit`."""
        while self._inbox:
            message = self._inbox.popleft()
            if not self._communication.serve(message):
                self._serve(message)
        return not self._quit

    def _run(self) -> None:
        resource, pacer = self.resource, self._pacer
        first, busy, known = resource.header.scan, resource.measured.busy_ns, len(resource.journal)
        begin = self._flows.begin()
        stop = self._debugger.run(pacer.scans if begin is None else 1, pacer.pace)
        self.traces.drain()
        if any(isinstance(each.command, NetworkRequest) for each in resource.journal[known:]):
            self._services.entered()  # another PLC is waited for
        scan = resource.header.scan
        pacer.ran(scan - first, stop.reason is Reason.CONDITION, scan)
        if pacer.paused:
            self.resource.waiting.until = ()
        if pacer.paused or stop.reason is Reason.HALTED:
            self._tick = True
        pacer.worked(resource.measured.busy_ns - busy)
        if begin is not None:
            self._flows.ran(begin)

    def _serve(self, message: object) -> None:
        match message:
            case protocol.Submit():
                self._answers.entered(message.ref, self._debugger.submit(message.command))
            case protocol.Drive():
                self._driving.drive(message)
            case _ if isinstance(message, DebugRequest | Debuggable | Probed | StandAgain):
                self._debug(message)
            case FindWords():
                self._link.post(words_found(self.resource, message))
            case protocol.Travel():
                self._driving.travel(message)
                self.programs.drop_idle(self.timeline.resource.version, self.timeline.live.version)
            case protocol.Copy():
                self._copy(message)
            case Copied():
                self._answers.answer(message.ref, message.refusal, "written")
            case Swap():
                self._swap(message)
            case Observable():
                self._observe(message)
            case Recode():
                self._recode(message)
            case BuildRefused():
                self._answers.ack(message.ref, False, message.message)
            case protocol.SetLimits():
                self.timeline.recording.bounds.set_limit(run_limit(message.run_mib))
                self._pacer.cpu_percent = message.cpu_percent
            case DefineTrace() | DriveTrace():
                self.traces.serve(message)
            case protocol.Quit():
                self._quit = True
            case _:
                self._services.serve(message)
                self._tick = True

    # ---- the debugger ---------------------------------------------------------------------------------------------

    def _debug(self, message: DebugRequest | Debuggable | Probed | StandAgain) -> None:
        self._tick = True
        if isinstance(message, Probed):
            self._debugger.take_probed(message.loaded, message.engine)
        elif isinstance(message, Debuggable):
            for waiting in self.debugging.on_ready(message):
                self._serve(waiting)
        elif self.debugging.ready(message):
            if isinstance(message, StandAgain):
                self._driving.stand_again()
            elif isinstance(message, debug_protocol.Step):
                self._driving.step(message)
            elif isinstance(message, debug_protocol.WantFlow):
                self._flows.ask(message)
            else:
                self.debugging.serve(message)
                self._services.entered()

    def _copy(self, copy: protocol.Copy) -> None:
        """Writes the copy in a different thread, as that takes a while."""

        def done(refusal: Refusal | None) -> None:
            self.give(Copied(copy.ref, refusal))

        self.timeline.copy(Path(copy.path), copy.scan, copy.author, done)

    # ---- program --------------------------------------------------------------------------------------------------

    def _swap(self, swap: Swap) -> None:
        refused = self._change_refusal(swap.loaded.program, self.resource.journal.derived(ACTIVE))
        if refused:  # before it is kept in the run
            self._answers.ack(swap.ref, False, refused)
            return
        self.programs.put(swap.loaded, swap.sources)
        if swap.loaded.version not in self.timeline.recording.programs:
            refusal = self.timeline.add_program(swap.loaded.version, pack_body(swap.sources))
            if refusal is not None:
                self._answers.answer(swap.ref, refusal, "")
                return
        outcome = self._debugger.submit(ProgramChange(swap.author, swap.loaded.version))
        if not isinstance(outcome, Refusal):
            self._moved()
        self._answers.entered(swap.ref, outcome)

    def _moved(self) -> None:
        """Adapts places, pace and conditions to a new program."""
        self._pacer.set_pace(self.resource.program.interval_ns)
        condition = self._pacer.condition
        again = next(iter(self.resource.waiting.until), None)
        if condition is not None and again is None:
            self._pacer.lose(f"paused: the new program has no meaning for {condition.text}")
        else:
            self._pacer.condition = again
        self.programs.drop_idle(self.timeline.resource.version, self.timeline.live.version)
        self._services.moved()
        self.debugging.moved()
        self.traces.moved()

    def _observe(self, observable: Observable) -> None:
        loaded, then = self.timeline.live, observable.then
        if loaded.version != observable.version:
            self._answers.ack(
                then.ref, False, "the program was changed meanwhile: see where the statement is now, and arm again"
            )
            return
        loaded.fresh = observable.program
        self._answers.entered(then.ref, self._debugger.submit(then.command))

    def _recode(self, recode: Recode) -> None:
        if recode.engine is not None:
            self.programs.recode(recode.program, recode.engine)
