"""Phase 7, tool services: value frames, state, diagnostics, forces, marks; what the parent is told of the PLC."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from scanbench.debug.debugger import Debugger
from scanbench.faults.arm import ARMED, armed_faults
from scanbench.faults.device import Watched, read_device
from scanbench.faults.device_shapes import DeviceErrors
from scanbench.faults.disturb.disturb import DISTURBED, disturbances
from scanbench.faults.inject import ACTIVE
from scanbench.faults.line_faults import BROKEN_LINES
from scanbench.faults.preview import preview
from scanbench.host.link import Link
from scanbench.host.lookup import watch_item
from scanbench.host.marks import marks_of
from scanbench.host.pacer import Pacer
from scanbench.host.status import host_state
from scanbench.host.swaps import Optimising
from scanbench.recording.recording import RecordingInfo
from scanbench.recording.timeline import PAST, Timeline
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.forces import FORCED, Force, ForcedValue, forced_values
from scanbench.runtime.resource import Resource
from scanbench.symbols.symbols import Symbol
from scanbench.symbols.violations import Violations, read_violations
from scanbench.taps.watch import WatchPlan
from scanbench.wire import host as protocol
from scanbench.wire.symbols import WatchItem

TICK_NS = 50_000_000
IDLE_TICK_NS = 1_000_000_000
"""While nobody looks."""
COUNTING_NS = 200_000_000
"""How often the state is sent when nothing but scan number and time changed."""
_INFO_NS = 1_000_000_000
NOTED_NS = 1_000_000_000
OPTIMISING = "the program is being optimised: it runs slower for a moment"


class Services:
    """Reads the image in the seam; never writes it."""

    def __init__(
        self, timeline: Timeline, pacer: Pacer, link: Link, note: str, tiers: Optimising | None,
        sources: Callable[[int], protocol.Sources], debugger: Debugger,
    ) -> None:  # fmt: skip
        self._timeline, self._pacer, self._link, self._note, self._tiers = timeline, pacer, link, note, tiers
        self._debugger = debugger
        self._sources, self._version_told = sources, timeline.live.version
        self.past_by = ""
        self._attended = False
        self._quick_since = 0
        self._watched: dict[int, str] = {}
        self._plan = WatchPlan(self._resource.program, {}, len(self._resource.memory))
        self._last_state: protocol.PlcState | None = None
        self._state_at = self._counted_at = self._info_at = 0
        self._diagnosed: Violations | None = None
        self._in_effect: protocol.InEffect | None = None
        self._held: Mapping[str, Force] | None = None
        self._forces: tuple[ForcedValue, ...] | None = None if timeline.live_scan else ()
        """As they were told; a run that is gone on with may have lost one that nobody was told of."""
        self._info: RecordingInfo | None = None
        self._device = Watched(self._resource.program.layout)
        self._device_in_past: bool | None = None
        timeline.new_entries()  # those of earlier lives were told by their hosts
        link.post(protocol.RunMarks(timeline.recording.info, marks_of(timeline.live_journal), fresh=True))

    @property
    def _resource(self) -> Resource:
        return self._timeline.resource

    @property
    def _time_ns(self) -> int:
        """When the scan that is next begins: the same in frames and states."""
        return self._resource.header.next_clock_ns(self._resource.program.interval_ns)

    @property
    def tick_ns(self) -> int:
        """How soon the next tick is wanted."""
        return TICK_NS if self._attended else IDLE_TICK_NS

    @property
    def state(self) -> protocol.PlcState:
        """The state now."""
        note = self._pacer.reached or self._note or self._tier_note(monotonic_ns())
        return host_state(self._timeline, self._pacer, self.past_by, note, self._debugger)

    @property
    def previous_version(self) -> int | None:
        """What a roll back swaps in, as it was told last; for any thread."""
        return None if self._last_state is None else self._last_state.previous_version

    @property
    def in_effect(self) -> protocol.InEffect | None:
        """What holds, as it was told last; for any thread."""
        return self._in_effect

    # ---- what the parent asks -------------------------------------------------------------------------------------

    def serve(self, message: object) -> None:
        """Watching, and whether somebody looks."""
        match message:
            case protocol.WatchPaths():
                self._watch(message)
            case protocol.UnwatchIds():
                for id in message.ids:
                    self._watched.pop(id, None)
                self._plan_watch(())
            case protocol.WantSnapshot():
                header = self._resource.header
                frame = self._plan.snapshot(self._resource.memory, header.scan, self._time_ns)
                self._link.post(protocol.Frame(frame, self._timeline.live_scan, message.to))
            case protocol.WantForces():
                self._tell_in_effect()  # what holds is known by then, too
                self._diagnose()
                self._link.post(protocol.ForcesAre(forced_values(self._resource.view), message.ref))
            case protocol.WantDevice():
                self._link.post(protocol.DeviceIs(self._read_device(), message.ref))
            case protocol.PreviewErrors():
                self._preview(message)
            case protocol.Attend():
                self._attended = message.anybody

    def entered(self) -> None:
        """Reports the journal's new entries, after the program that runs now if that changed. Which faults and errors they
        leave armed or present is reported before anybody gets an answer."""
        if self._timeline.live.version != self._version_told:
            self._version_told = self._timeline.live.version
            self._link.post(protocol.NowRuns(self._sources(self._version_told)))
        entries = self._timeline.new_entries()
        if entries:
            self._link.post(protocol.Entered(tuple(entries)))
            self._tell_in_effect()

    def before_answer(self) -> None:
        """What an answer comes after: its entries, forces and the state, where the parent keeps up. Who begins a new run after
        *paused* begins a paused one."""
        self.entered()
        if not self._link.backlogged:
            self._tell_forces(False)
            self._tell_state(monotonic_ns())

    def moved(self) -> None:
        """Plans the watch again, as a new program is shown, in which every variable may have a new place."""
        self._device = Watched(self._resource.program.layout)
        self._link.post(protocol.Watching(None, self._plan_watch(self._watched)))

    # ---- at each tick ---------------------------------------------------------------------------------------------

    def tick(self) -> None:
        """Tells what changed; when the parent does not keep up, it is told what changed until then once it does."""
        now = monotonic_ns()
        if self._link.backlogged:
            self._pacer.look()
            if now >= self._counted_at:
                self._counted_at = now + COUNTING_NS
                self._timeline.note()
            return
        self.entered()
        self._pacer.look()
        header = self._resource.header
        if len(self._plan):
            frame = self._plan.sample(self._resource.memory, header.scan, self._time_ns)
            if frame is not None:
                self._link.post(protocol.Frame(frame, self._timeline.live_scan))
        self._tell_forces(
            now >= self._counted_at
        )  # first: who sees it run again after a death also sees the last of them
        self._tell_state(now)
        self._tell_in_effect()  # after it: what is present is read as the past's or as live, by the state
        if now >= self._counted_at:
            self._counted_at = now + COUNTING_NS
            self._diagnose()
            self._tell_device()
            self._timeline.note()
        if now >= self._info_at:
            self._info_at = now + _INFO_NS
            self._tell_info()

    def _tell_state(self, now: int) -> None:
        state = self.state
        if state != self._last_state and (now >= self._state_at or self._differs(state)):
            self._last_state, self._state_at = state, now + COUNTING_NS
            self._link.post(state)

    def _tier_note(self, now: int) -> str:
        """What to say of code that is not optimised yet, unless that is soon over."""
        if self._tiers is None or not self._tiers.optimising:
            self._quick_since = 0
            return ""
        self._quick_since = self._quick_since or now
        return OPTIMISING if now - self._quick_since > NOTED_NS else ""

    def _tell_in_effect(self) -> None:
        journal = self._resource.journal
        present = journal.derived(ACTIVE)
        in_effect = protocol.InEffect(
            dict(present), armed_faults(journal.derived(ARMED)), disturbances(journal.derived(DISTURBED)),
            tuple(journal.derived(BROKEN_LINES).values()),
        )  # fmt: skip
        if in_effect != self._in_effect:
            self._in_effect = in_effect
            self._link.post(in_effect)

    def _tell_forces(self, values: bool) -> None:
        """Which forces hold at once, what they do a few times a second."""
        held = self._resource.journal.derived(FORCED)
        if held is self._held and not (values and held):
            return
        forces = forced_values(self._resource.view)
        if forces != self._forces:
            self._forces = forces
            self._link.post(protocol.ForcesAre(forces))
        self._held = held

    def _tell_device(self) -> None:
        past = self._timeline.past
        if self._device.changed(self._resource.memory) or past != self._device_in_past:
            self._device_in_past = past
            self._link.post(protocol.DeviceIs(self._read_device()))

    def _read_device(self) -> DeviceErrors:
        return read_device(self._resource.view, self._timeline.past)

    def _preview(self, asked: protocol.PreviewErrors) -> None:
        view = self._resource.view
        if self._timeline.past:
            told = protocol.PreviewedErrors(False, PAST, view.header.scan, ())
        else:
            found = preview(view, asked.errors, asked.again, asked.anyway)
            told = protocol.PreviewedErrors(found.ok, found.message, view.header.scan, found.writes, found.more)
        self._link.post(protocol.ErrorsPreviewed(asked.ref, told))

    def _tell_info(self) -> None:
        info = self._timeline.recording.info
        if info != self._info:
            self._info = info
            self._link.post(protocol.RunMarks(info, (), fresh=False))

    def _diagnose(self) -> None:
        violations = read_violations(self._resource.program, self._resource.memory)
        if violations != self._diagnosed:
            self._diagnosed = violations
            self._link.post(protocol.Diagnosed(violations))

    def _differs(self, state: protocol.PlcState) -> bool:
        """Whether more than counters changed: people wait for that, and in a pause for every scan."""
        last = self._last_state
        if last is None or self._pacer.paused or self._timeline.past or state.halt is not None:
            return True
        counted = replace(
            last, scan=state.scan, live_scan=state.live_scan, time_ns=state.time_ns, cycle_us=state.cycle_us,
            late_percent=state.late_percent, late_us=state.late_us, worst_us=state.worst_us,
        )  # fmt: skip
        return counted != state

    # ---- watching -------------------------------------------------------------------------------------------------

    def _watch(self, message: protocol.WatchPaths) -> None:
        self._watched.update(message.paths)
        asked = [id for id, _ in message.paths]
        items = {item.id: item for item in self._plan_watch(asked)}
        self._link.post(protocol.Watching(message.ref, tuple(items[id] for id in asked)))

    def _plan_watch(self, again: "list[int] | dict[int, str] | tuple[int, ...]") -> tuple[WatchItem, ...]:
        """Makes the gather plan again; values of the ids in `again` are sent even if they did not change."""
        items: list[WatchItem] = []
        symbols: dict[int, Symbol] = {}
        for id, path in self._watched.items():
            item, symbol = watch_item(self._resource.program, id, path)
            items.append(item)
            if symbol is not None:
                symbols[id] = symbol
        plan = WatchPlan(self._resource.program, symbols, len(self._resource.memory))
        plan.keep_last(self._plan, again)
        self._plan = plan
        return tuple(items)
