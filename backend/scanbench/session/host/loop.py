"""The host's main thread: the scan loop, and the seam between two runs of the engine.

The engine runs without the GIL until it is knocked: by a message that wants something, or by the tick that takes value
frames and state. Everything that touches the image is here, in one thread.
"""

import threading
from collections import deque
from dataclasses import replace

import zstandard

from scanbench.check.symbols import Symbol
from scanbench.check.violations import Violations, read_violations
from scanbench.engines.engine import Pace, Reason
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Refusal
from scanbench.runtime.resource import Resource
from scanbench.session import protocol
from scanbench.session.host.link import Link
from scanbench.session.host.lookup import watch_item
from scanbench.session.host.status import host_state
from scanbench.session.host.swaps import BuildRefused, Optimising, Recode, Swap
from scanbench.taps.watch import WatchPlan

TICK_NS = 50_000_000
COUNTING_NS = 200_000_000
"""How often the state is sent when nothing but scan number and time changed."""
CHECKPOINT_NS = 2_000_000_000
_FOREVER = 1 << 40
_MAX_SPEED = 0.0
NOTED_NS = 1_000_000_000
OPTIMISING = "the program is being optimised: it runs slower for a moment"


class Loop:
    """Runs one resource, and serves what comes from the parent between scans."""

    def __init__(
        self, resource: Resource, link: Link, version: int, speed: float, paused: bool, note: str,
        tiers: Optimising | None = None,
    ) -> None:  # fmt: skip
        self.resource = resource
        self._tiers = tiers
        self._quick_since = 0
        self._link, self._version, self._note = link, version, note
        self._inbox: deque[object] = deque()
        self._wake = threading.Event()
        self._tick = True
        self._quit = False
        self._paused = paused
        self._single = 0
        self._speed = speed
        self._pace: Pace | None = None
        self._watched: dict[int, str] = {}
        self._plan = WatchPlan({}, len(resource.memory))
        self._last_state: protocol.HostState | None = None
        self._state_at = self._checkpoint_at = self._diagnosed_at = 0
        self._diagnosed: Violations | None = None
        self._checkpointed = (-1, -1)
        self._sent_entries = len(resource.journal)
        self._set_pace()

    # ---- from the link's thread -----------------------------------------------------------------------------------

    def give(self, message: object) -> None:
        """Hands over a message; the engine comes back for it after the current scan."""
        self._inbox.append(message)
        self._knock()

    def tick(self) -> None:
        """Time for frames and state."""
        self._tick = True
        self._knock()

    def _knock(self) -> None:
        self.resource.engine.knock()
        self._wake.set()

    # ---- the loop -------------------------------------------------------------------------------------------------

    def run(self) -> None:
        """Runs scans until `Quit`."""
        while not self._quit:
            while self._inbox:
                self._serve(self._inbox.popleft())
            if self._tick:
                self._tick = False
                self._services()
            if self.resource.runnable and self._single:
                if self.resource.run(1).reason is not Reason.KNOCKED:  # the knock that brought the request, for one
                    self._single -= 1
                self._enter_new()
                self._tick = True
            elif self.resource.runnable and not self._paused:
                self.resource.run(_FOREVER, self._pace)
                self._enter_new()
            else:
                self._single = 0
                self._wake.wait()
                self._wake.clear()

    def _serve(self, message: object) -> None:
        match message:
            case protocol.Submit():
                outcome = self.resource.submit(message.command)
                self._enter_new()
                if isinstance(outcome, Refusal):
                    self._ack(message.ref, False, outcome.message, outcome.near)
                else:
                    self._ack(message.ref, True, outcome.plan.message)
                self._tick = True
            case protocol.Drive():
                self._drive(message)
            case protocol.WatchPaths():
                self._watch(message)
            case protocol.UnwatchIds():
                for id in message.ids:
                    self._watched.pop(id, None)
                self._plan_watch(())
            case protocol.WantSnapshot():
                header = self.resource.header
                frame = self._plan.snapshot(self.resource.memory, header.scan, header.clock_ns)
                self._link.post(protocol.Frame(frame, message.to))
            case Swap():
                self._swap(message)
            case Recode():
                if message.program is self.resource.program and message.engine is not None:
                    self.resource.engine = message.engine
            case BuildRefused():
                self._ack(message.ref, False, message.message)
            case protocol.Quit():
                self._quit = True

    def _ack(self, ref: int, ok: bool, message: str, near: tuple[str, ...] = ()) -> None:
        self._link.post(protocol.Ack(ref, ok, message, self.resource.header.scan, near))

    def _enter_new(self) -> None:
        """Sends the journal's new entries."""
        journal = self.resource.journal
        for entry in journal[self._sent_entries :]:
            self._link.post(protocol.Entered(entry))
        self._sent_entries = len(journal)

    # ---- pace -----------------------------------------------------------------------------------------------------

    def _drive(self, drive: protocol.Drive) -> None:
        if drive.speed is not None:
            self._speed = drive.speed
        refusal = self._drive_action(drive.action)
        self._set_pace()
        self._tick = True
        speed = "as fast as possible" if self._speed == _MAX_SPEED else f"speed x{self._speed:g}"
        self._ack(drive.ref, refusal is None, refusal or f"{drive.action}, {speed}")

    def _drive_action(self, action: str) -> str | None:
        if action == "restart":
            self.resource.restart()
            self._new_run()
            return None
        if action == "pause":
            self._paused = True
            return None
        if not self.resource.runnable:
            state = host_state(self.resource, self._speed, self._paused, self._version, "")
            return f"the program is stopped: {state.message}"
        if action == "scan":
            self._paused = True
            self._single += 1
        else:
            self._paused = False
        return None

    def _set_pace(self) -> None:
        if self._speed == _MAX_SPEED:
            self._pace = None
        else:
            period = max(1, round(self.resource.program.interval_ns / self._speed))
            self._pace = Pace(period, monotonic_ns())

    def _new_run(self) -> None:
        """The journal begins anew; a replay must never look before this point."""
        self._link.post(protocol.ColdStart())
        self._sent_entries, self._checkpointed = 0, (-1, -1)
        self._enter_new()
        self._checkpoint()

    # ---- program --------------------------------------------------------------------------------------------------

    def _swap(self, swap: Swap) -> None:
        old_journal = self.resource.journal
        report = self.resource.swap(swap.program, swap.engine, swap.memory, swap.author, swap.version)
        self._version = swap.version
        self._set_pace()
        if self.resource.journal is old_journal:
            self._enter_new()
            self._checkpoint()
        else:
            self._new_run()
        self._link.post(protocol.Watching(None, self._plan_watch(self._watched)))
        self._tick = True
        self._ack(swap.ref, True, report)

    # ---- services: phase 7 ----------------------------------------------------------------------------------------

    def _services(self) -> None:
        now = monotonic_ns()
        header = self.resource.header
        if len(self._plan) and not self._link.backlogged:
            frame = self._plan.sample(self.resource.memory, header.scan, header.clock_ns)
            if frame is not None:
                self._link.post(protocol.Frame(frame))
        state = host_state(self.resource, self._speed, self._paused, self._version, self._note or self._tier_note(now))
        if state != self._last_state and (now >= self._state_at or self._differs(state)):
            self._last_state, self._state_at = state, now + COUNTING_NS
            self._link.post(state)
        if now >= self._diagnosed_at:
            self._diagnosed_at = now + COUNTING_NS
            self._diagnose()
        if now >= self._checkpoint_at:
            self._checkpoint()

    def _tier_note(self, now: int) -> str:
        """What to say of code that is not optimised yet, unless that is soon over."""
        if self._tiers is None or not self._tiers.optimising:
            self._quick_since = 0
            return ""
        self._quick_since = self._quick_since or now
        return OPTIMISING if now - self._quick_since > NOTED_NS else ""

    def _diagnose(self) -> None:
        violations = read_violations(self.resource.program, self.resource.memory)
        if violations != self._diagnosed:
            self._diagnosed = violations
            self._link.post(protocol.Diagnosed(violations))

    def _differs(self, state: protocol.HostState) -> bool:
        """Whether more than counters changed: people wait for that, and in a pause for every scan."""
        last = self._last_state
        if last is None or self._paused:
            return True
        return replace(last, scan=state.scan, time_ns=state.time_ns, cycle_us=state.cycle_us) != state

    def _checkpoint(self) -> None:
        """Copies the state; it is packed in the link's thread."""
        self._checkpoint_at = monotonic_ns() + CHECKPOINT_NS
        scan, entries = self.resource.header.scan, len(self.resource.journal)
        if self._checkpointed == (scan, entries):
            return
        self._checkpointed = (scan, entries)
        version, state = self._version, self.resource.state

        def packed() -> protocol.Checkpoint:
            image = zstandard.ZstdCompressor(level=1).compress(state)
            return protocol.Checkpoint(scan, entries, version, image)

        self._link.post(packed)

    # ---- watching -------------------------------------------------------------------------------------------------

    def _watch(self, message: protocol.WatchPaths) -> None:
        self._watched.update(message.paths)
        asked = [id for id, _ in message.paths]
        items = {item.id: item for item in self._plan_watch(asked)}
        self._link.post(protocol.Watching(message.ref, tuple(items[id] for id in asked)))
        self._tick = True

    def _plan_watch(self, again: "list[int] | dict[int, str] | tuple[int, ...]") -> tuple[protocol.WatchItem, ...]:
        """Makes the gather plan anew; values of the ids in `again` are sent even if they did not change."""
        items: list[protocol.WatchItem] = []
        symbols: dict[int, Symbol] = {}
        for id, path in self._watched.items():
            item, symbol = watch_item(self.resource.program, id, path)
            items.append(item)
            if symbol is not None:
                symbols[id] = symbol
        plan = WatchPlan(symbols, len(self.resource.memory))
        plan.keep_last(self._plan, again)
        self._plan = plan
        return tuple(items)
