"""The debugger of one PLC: breakpoints, halts, steps, forward and back. In the thread that runs the scans."""

from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from scanbench.debug.assign import Assign, Assigning
from scanbench.debug.breakpoint import Breakpoint, Verdict
from scanbench.debug.breakpoints import Breakpoints
from scanbench.debug.goals import Goal, Within
from scanbench.debug.halt import Found, Halt, halt_of
from scanbench.debug.listener import Actions, Listener, Position
from scanbench.debug.past import Past
from scanbench.debug.placed import Placing
from scanbench.debug.probing import Probes
from scanbench.debug.raised import RaisedErrors
from scanbench.debug.trapping import Trapping
from scanbench.engines.debug import Frame
from scanbench.engines.engine import Pace, Reason, Stop
from scanbench.engines.probe import MakeProbed, Probe, ProbedEngine
from scanbench.problems import Span
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Command, Entry, Plan, Refusal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource

STEPS = ("continue", "in", "within", "over", "out", "statement", "scan", "to", "pause", "entry")

MOST_ASSIGNED = 1_000
"""In one scan: each time is an entry of the journal, and nobody is served meanwhile."""


class Told(Protocol):
    """Who is told what breakpoints do, and knows what the debugger does not."""

    def said(self, breakpoint: Breakpoint, text: str, scan: int, span: Span | None) -> None:
        """A logpoint was reached."""

    def raised(self, entry: Entry) -> tuple[str, ...]:
        """The errors that an entry of the journal raises."""


class Debugger:
    """Runs the PLC in place of its timeline. The PLC must not be run while `halt` is set."""

    def __init__(self, timeline: Timeline, told: Told) -> None:
        self._timeline, self._told = timeline, told
        self.breakpoints = Breakpoints()
        self.covering = False
        """Somebody wants to know what is reached: the debug flavour runs."""
        self.changed = False
        """Whether hits were counted since somebody last looked."""
        self.live_halt: Halt | None = None
        """Where the PLC itself is halted, also while its past is shown."""
        self._past_halt: Halt | None = None
        self._number = 0
        self._goal: Goal | None = None
        self._pending: Found | None = None
        self._listener: Listener | None = None
        self._trapping = Trapping(timeline, self.breakpoints)
        self._raised = RaisedErrors(timeline, self.breakpoints, told.raised)
        self._stood: Position = (-1, 0)
        """Where it was halted in the scan that is next: up to there nothing halts it."""
        self._past = Past(timeline, self.breakpoints)
        self._past.raised = told.raised
        self._probes = Probes()
        self.want_probes: Callable[[Loaded, tuple[Probe, ...]], None] = lambda loaded, probes: None
        """Asks somebody to make code with these probes, for `take_probed`; until that is there the debug flavour runs."""
        self._exact: int | None = None
        """The scan in which a probe was reached: it is run statement by statement."""
        timeline.resource.listening.call(self._on_trap, self._on_probe)

    # ---- what there is --------------------------------------------------------------------------------------------

    @property
    def resource(self) -> Resource:
        """What is shown."""
        return self._timeline.resource

    @property
    def halt(self) -> Halt | None:
        """Where it is halted: the PLC, or what is shown of its past."""
        return self._past_halt if self._timeline.past else self.live_halt

    @property
    def stepping(self) -> bool:
        """Whether the PLC runs, and is to halt where a step ends."""
        return self._goal is not None and not self._timeline.past

    @property
    def moving(self) -> bool:
        """Whether a step goes on in the past: `move` is to be called."""
        return self._past.moving

    @property
    def busy(self) -> bool:
        """Whether the debug flavour is wanted now, or may be at any time."""
        listens = any(each.active for each in self.breakpoints.placed)
        return listens or self.covering or self._goal is not None or self.halt is not None or self._timeline.past

    @property
    def flavour(self) -> str:
        """Which code runs, or would: empty is the ordinary one."""
        listening = self.resource.listening
        if listening.inside is not None or (self.busy and listening.hook is not None):
            return "debug"
        return "probed" if self.busy and listening.probed is not None else ""

    def search_with(self, prober: MakeProbed | None) -> None:
        """Who makes code with probes for searches back; without it long ones take longer."""
        self._past.prober = prober

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """All breakpoints, and what became of each."""
        if not self.breakpoints.placed:
            return ()
        sites = self.breakpoints.placing(self._timeline.live).sites
        return tuple(each.verdict(sites) for each in self.breakpoints.placed)

    @property
    def placing(self) -> Placing:
        """Of the program that is shown."""
        return self.breakpoints.placing(self.resource.loaded)

    # ---- breakpoints ----------------------------------------------------------------------------------------------

    def set(
        self, group: str, kind: str | None, file: str | None, breakpoints: tuple[Breakpoint, ...]
    ) -> tuple[Verdict, ...]:  # fmt: skip
        """All breakpoints of a group from now on; `kind` and `file` narrow that."""
        placing = self.breakpoints.placing(self._timeline.live)
        made = self.breakpoints.set(group, kind, file, breakpoints, placing, self._timeline.live_scan)
        self._listener = None
        self._find_probes()
        return tuple(each.verdict(placing.sites) for each in made)

    def moved(self) -> None:
        """Places all breakpoints again after a program change."""
        self.breakpoints.place_again(self._timeline.live, self._timeline.live_scan)
        self._listener, self.changed = None, True
        self._find_probes()
        if not self._timeline.past:
            self._goal = None

    def take_probed(self, loaded: Loaded, engine: ProbedEngine) -> None:
        """Code that was asked for; it runs from the next scan on that nobody has to listen to."""
        if loaded is self._timeline.live:
            self._probes.take(engine)

    def _find_probes(self) -> None:
        loaded = self._timeline.live
        wanted = self._probes.want(self.breakpoints, loaded)
        if wanted is not None:
            self.want_probes(loaded, wanted)

    # ---- running --------------------------------------------------------------------------------------------------

    def halt_at_start(self, why: str) -> None:
        """Halts in the present seam, before the PLC runs for the first time."""
        self._halted(Found("pause", why, ""))

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """As `Timeline.run`. HALTED: `halt` says where, and it is not to be run until somebody steps."""
        if self.live_halt is not None:
            raise RuntimeError("the PLC is halted: it must not be run")
        resource = self.resource
        scans = min(scans, self.breakpoints.scans_left(resource.header.scan))
        listener = self._arm()
        if listener is not None:
            listener.begin()
            if self._probes.engine is not None:
                scans = 1  # then the faster code goes on
        stop = self._timeline.run(scans, pace)
        self._look_for_errors()
        if stop.reason is Reason.HALTED:
            trapping = self._trapping.take()
            found = trapping or (listener.found if listener is not None else None)
            if trapping is not None and listener is not None:
                listener.pending = None  # of the statement that is before it again
            assert found is not None
            self._halted(found)
        elif listener is not None and stop.reason is Reason.TRAP:
            listener.pending = None
        elif listener is not None and not resource.begun:
            found = listener.after_scan()
            if found is not None:
                self._halted(found)
                return Stop(Reason.HALTED)
        if not resource.runnable:
            self._goal = self._pending = None
        return stop

    def submit(self, command: Command) -> Entry | Refusal:
        """As `Timeline.submit`; what needs the seam lets a halted scan run to its end."""
        if self._timeline.past:
            return self._timeline.submit(command)
        halt, resource, scan = self.live_halt, self.resource, self.resource.header.scan
        if halt is not None and resource.begun:
            listener = self._arm()
            if listener is not None:
                listener.begin()
        outcome = self._timeline.submit(command)
        self._look_for_errors()
        if halt is not None and halt.count and not resource.begun:
            self._finished(halt, scan)
        return outcome

    def _finished(self, halt: Halt, scan: int) -> None:
        """The scan ran to its end in which it was halted, as something was to be entered after it."""
        self._trapping.forget()
        if self._listener is not None:
            self._listener.pending = None
        if self.resource.header.scan == scan:  # it trapped
            self.live_halt = None
        else:
            self._halted(Found(halt.reason, f"{halt.text}; the scan ran to its end", halt.by, halt.breakpoints))

    def step(
        self, action: str, author: str, file: str = "", line: int = 0, path: str = "", within: Within | None = None
    ) -> Refusal | None:  # fmt: skip
        """Begins a step, which is over when `halt` has a new number. Steps back are completed at once."""
        if action in ("back", "reverse"):
            return self._back(action, author, path)
        if action not in STEPS:
            return Refusal(f"there is no step `{action}`: there are {', '.join(STEPS)}, back, reverse")
        goal = _goal_of(self.resource, self.placing, action, author, file, line)
        if isinstance(goal, Refusal):
            return goal
        if within is not None:
            goal = replace(goal, within=within)
        if self._timeline.past:
            self._past_halt = None
            self._past.begin(goal)
            return None
        if not self.resource.runnable and not self.resource.begun:
            return Refusal("the program is stopped: let it run first")
        if action == "pause" and self.live_halt is not None:
            return None
        self._goal, self.live_halt = None if action == "continue" else goal, None
        return None

    def forget_step(self) -> None:
        """A step that is under way is not to halt any more."""
        self._goal = self._pending = None

    def move(self) -> None:
        """Goes on with a step in the past."""
        found = self._past.move()
        if found is None:
            return
        if found == "live":
            self._return()
        else:
            self._number += 1
            self._past_halt = halt_of(self.resource, self.placing, found, self._number, True)

    def travelled(self) -> None:
        """Somebody went to the past, or returned."""
        self._past.stop()
        self._past_halt = None

    # ---- halting --------------------------------------------------------------------------------------------------

    def _halted(self, found: Found) -> None:
        self._number += 1
        self._goal = self._pending = None
        self.live_halt = halt_of(self.resource, self.placing, found, self._number, False)

    def _arm(self) -> Listener | None:
        """Who listens from now on; nobody where there is nothing to listen for."""
        resource, placed = self.resource, self.breakpoints.placed
        listener = self._listener
        if listener is None:
            listener = self._listener = Listener(resource, self.placing, placed, _Acting(self, resource))
        due = self.breakpoints.scans_left(resource.header.scan, 0) == 0
        wanted = self._goal is not None or self._pending is not None or self.covering or due
        probed = self._probes.engine
        if not wanted and listener.needed:
            wanted = probed is None or resource.begun or self._exact == resource.header.scan
        if not wanted:
            if resource.listening.hook is not None:
                resource.listening.look()
            resource.listening.attach(None)
            resource.listening.probe(probed if listener.needed else None)
            return None
        listener.goal, listener.pending = self._goal, self._pending or listener.pending
        inside, scan = resource.listening.inside, resource.header.scan
        if inside is not None:
            self._stood = scan, inside.count
        elif self._stood[0] != scan:  # else an interrupt came before the scan had run up to there again
            self._stood = -1, 0
        listener.passed.begin = self._stood
        resource.listening.attach(listener)
        return listener

    def _look_for_errors(self) -> None:
        """Errors that were raised since: the next statement is the first one after them."""
        self._pending = self._raised.look() or self._pending
        self.changed = self.changed or self._raised.counted

    def _on_trap(self) -> bool:
        halts = self._trapping.halts()
        self.changed = self.changed or halts
        return halts

    def _on_probe(self) -> None:
        """The scan in which a probe was reached is run again, statement by statement."""
        self._timeline.rewind()
        self._exact = self.resource.header.scan

    # ---- the past -------------------------------------------------------------------------------------------------

    def _back(self, action: str, author: str, path: str) -> Refusal | None:
        if self.resource.runnable and self.live_halt is None and not self._timeline.past and self._goal is not None:
            return Refusal("a step is under way: wait until it is over, or pause")
        found = self._past.back(author) if action == "back" else self._past.reverse(author, path)
        if isinstance(found, Refusal):
            return found
        self._number += 1
        self._past_halt = halt_of(self.resource, self.placing, found, self._number, True)
        return None

    def _return(self) -> None:
        """Shows the live PLC again."""
        self._timeline.return_live()
        self._past_halt = None
        if self.live_halt is None:
            self._halted(Found("step", "this is where the PLC is", ""))


class _Acting(Actions):
    """What breakpoints do in the PLC that runs."""

    def __init__(self, debugger: Debugger, resource: Resource) -> None:
        self._debugger, self._resource = debugger, resource
        self._scan = -1
        self._assigned = 0
        """How often something was assigned in this scan."""

    def say(self, breakpoint: Breakpoint, text: str, span: Span | None) -> None:
        self._debugger._told.said(breakpoint, text, self._resource.header.scan, span)

    def assign(self, breakpoint: Breakpoint, frame: Frame, assigning: Assigning, instance: int, count: int) -> None:
        resource, scan = self._resource, self._resource.header.scan
        self._assigned = self._assigned + 1 if scan == self._scan else 1
        self._scan = scan
        if self._assigned > MOST_ASSIGNED + 1:
            return
        outcome: Plan | Entry | Refusal = Refusal(
            f"{MOST_ASSIGNED:,} times is all that execution points may assign in one scan: give it a condition"
        )
        if self._assigned <= MOST_ASSIGNED:
            outcome = assigning.plan(resource.view, instance)
        if isinstance(outcome, Plan):
            command = Assign(breakpoint.author, frame.pou.name, frame.instance, breakpoint.assign)
            outcome = resource.enter_planned(command, outcome, step=count)
        if isinstance(outcome, Refusal):
            self.say(
                breakpoint,
                f"nothing was assigned: {outcome.message}",
                self._debugger.placing.sites.statements[frame.site].span,
            )

    def counted(self) -> None:
        self._debugger.changed = True


def _goal_of(
    resource: Resource, placing: Placing, action: str, author: str, file: str, line: int
) -> Goal | Refusal:  # fmt: skip
    """Where a step ends that begins here."""
    inside = resource.listening.inside
    frames = inside.frames if inside is not None else ()
    sites: frozenset[int] = frozenset()
    if action == "to":
        placed = placing.place(Breakpoint(0, "line", author, file=file, line=line), resource.header.scan)
        if placed.flaw:
            return Refusal(placed.flaw)
        sites = placed.sites
    return Goal(action, author, resource.header.scan, frames, sites, placing.minor)
