"""Which step of an armed fault is due: `runtime.agenda.Agenda` over the journal."""

from collections.abc import Iterator

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.observe import MakeObserved, Observed
from scanbench.faults.arm import ARMED, Disarm, Lane, Lanes, Missed, unmeant
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.lasting import returning
from scanbench.faults.lines import find_line
from scanbench.faults.shapes import Wanted
from scanbench.program.program import Program
from scanbench.runtime.agenda import NOTHING, Met, Waits
from scanbench.runtime.command import Command, Refusal, View
from scanbench.runtime.programs import Loaded


class Schedule:
    """Keeps nothing but what it worked out last, for the same lanes and program."""

    def __init__(self, make: MakeObserved) -> None:
        """`make` is asked only when somebody waits for a statement."""
        self._make = make
        self._lanes: Lanes | None = None
        self._program: Program | None = None
        self._waits = NOTHING
        self._ended: Disarm | None = None
        self._places: dict[tuple[str, int], frozenset[int]] = {}
        self._conditions: dict[str, Condition] = {}
        self._flaws: dict[tuple[Wanted, bool], Refusal | None] = {}

    def due(self, view: View, met: Met) -> Command | None:
        """What a restart cut off and must be there again; the first step that is due, in the order in which the faults were
        armed."""
        again = returning(view)
        if again is not None:
            return again
        lanes = view.derived(ARMED)
        if not lanes:
            return None
        self._look(lanes, view)
        if self._ended is not None:
            return self._ended
        scan = view.header.scan
        for lane in lanes.values():
            if lane.waiting and lane.offset == 0 and self._started(lane, met):
                return _raising(lane)
            acknowledge = lane.wanted.shape.acknowledge
            if _acknowledgeable(lane) and acknowledge in met.conditions and lane.since < scan:
                after = f"{scan - lane.since} of {lane.wanted.shape.scans} scans"
                return Disarm(lane.by, (lane.number,), f"acknowledged after {after}: {acknowledge}")
            if lane.due is not None and lane.due <= scan:
                if lane.present:
                    return Recover(lane.by, lane.present, lane.number, lane.step)
                return _raising(lane)
        return None

    def refused(self, command: Command, refusal: Refusal) -> Command:
        """The step is passed over, and the log says so."""
        match command:
            case Generate(arm=int(arm), step=step):
                return Missed(command.author, arm, step, tuple(map(str, command.errors)), refusal.message)
            case Recover(arm=int(arm), step=step, ids=tuple(ids)):
                return Missed(command.author, arm, step, ids, refusal.message)
        raise ValueError(f"{command} is no step of an armed fault, and was refused: {refusal.message}")

    def waits(self, view: View) -> Waits:
        """The next step in time, and what starts or acknowledges."""
        lanes = view.derived(ARMED)
        if not lanes:
            return NOTHING
        self._look(lanes, view)
        return self._waits

    def _observed(self, loaded: Loaded) -> Observed:
        """Made again: whoever wants it soon has `make` prepare it."""
        return self._make(loaded.statements, loaded.memory)

    def _look(self, lanes: Lanes, view: View) -> None:
        if lanes is self._lanes and view.program is self._program:
            return
        if view.program is not self._program:
            self._places.clear()
            self._conditions.clear()
            self._flaws.clear()
        self._lanes, self._program = lanes, view.program
        self._ended = next(self._meaningless(lanes, view), None)
        if self._ended is not None:
            return
        dues = [lane.due for lane in lanes.values() if lane.due is not None]
        texts: dict[str, None] = {}
        sites: frozenset[int] = frozenset()
        for lane in lanes.values():
            start = lane.wanted.start
            if lane.waiting and start.kind == "condition":
                texts[start.condition] = None
            elif lane.waiting and start.kind == "line":
                sites |= self._sites(start.file, start.line, view)
            if _acknowledgeable(lane):
                texts[lane.wanted.shape.acknowledge] = None
        conditions = tuple(self._condition(each, view.program) for each in texts)
        self._waits = Waits(min(dues, default=None), conditions, sites, self._observed if sites else None)

    def _meaningless(self, lanes: Lanes, view: View) -> Iterator[Disarm]:
        """Ends of faults that wait for something that this program does not have."""
        for lane in lanes.values():
            wanted, started = lane.wanted, not lane.waiting
            if (wanted, started) not in self._flaws:
                self._flaws[wanted, started] = unmeant(wanted, view, started)
            flawed = self._flaws[wanted, started]
            if flawed is not None and not lane.ending:
                yield Disarm(lane.by, (lane.number,), f"the program has no meaning for it any more: {flawed.message}")

    def _started(self, lane: Lane, met: Met) -> bool:
        start = lane.wanted.start
        if start.kind == "condition":
            return start.condition in met.conditions
        return not met.sites.isdisjoint(self._places.get((start.file, start.line), ()))

    def _sites(self, file: str, line: int, view: View) -> frozenset[int]:
        if (file, line) not in self._places:
            found = find_line(view.statements, file, line)
            self._places[file, line] = frozenset() if isinstance(found, Refusal) else frozenset(found)
        return self._places[file, line]

    def _condition(self, text: str, program: Program) -> Condition:
        if text not in self._conditions:
            made = compile_condition(program, text)
            assert isinstance(made, Condition), made.message  # `_meaningless` has looked
            self._conditions[text] = made
        return self._conditions[text]


def _acknowledgeable(lane: Lane) -> bool:
    shape = lane.wanted.shape
    return shape.kind == "unacknowledged" and bool(shape.acknowledge and lane.present) and not lane.ending


def _raising(lane: Lane) -> Generate:
    return Generate(lane.by, lane.errors, arm=lane.number, step=lane.step)
