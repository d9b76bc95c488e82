"""The hook of the debug flavour: decides, in the middle of a scan, where a breakpoint acts and where a step ends."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TypeVar

from scanbench.debug.assign import Assigning
from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.goals import Goal
from scanbench.debug.halt import Found, HaltReason
from scanbench.debug.placed import Placed, Placing
from scanbench.debug.violating import Violating
from scanbench.debug.watching import Watching
from scanbench.engines.debug import Frame, Listen
from scanbench.problems import Span
from scanbench.program.layout import Layout
from scanbench.program.program import Pou
from scanbench.runtime.resource import Resource

T = TypeVar("T")
Position = tuple[int, int]
"""Scan and count, see `engines.debug`."""


class Actions:
    """What breakpoints do instead of halting. In the past they do nothing."""

    def say(self, breakpoint: Breakpoint, text: str, span: Span | None) -> None:
        """A logpoint's message."""

    def assign(self, breakpoint: Breakpoint, frame: Frame, assigning: Assigning, instance: int, count: int) -> None:
        """An execution point: these assignments, for this instance."""

    def counted(self) -> None:
        """A breakpoint was hit."""


@dataclass(slots=True)
class Passed:
    """Up to where nothing acts any more, as it was there before; and from where on the past ends."""

    begin: Position = (-1, 0)
    """Statements up to this one have acted, and accesses before it."""
    end: Position | None = None
    """Halts there in any case."""


class Listener:
    """Acts on the breakpoints of one program. `found` says why it halted last."""

    def __init__(
        self, resource: Resource, placing: Placing, placed: Iterable[Placed], actions: Actions | None
    ) -> None:  # fmt: skip
        """No actions: the past is shown; breakpoints halt there whenever their condition holds."""
        self._resource, self._placing, self._actions = resource, placing, actions
        self.loaded = resource.loaded
        every = [each for each in placed if each.active]
        self._at: dict[int, list[Placed]] = {}
        for each in every:
            for site in each.sites:
                self._at.setdefault(site, []).append(each)
        self._watching = Watching((each for each in every if each.symbol is not None), resource.memory)
        self._violations = [each for each in every if each.breakpoint.kind == "violation"]
        self._scans = [each for each in every if each.breakpoint.kind == "scan"]
        self._due: list[Placed] = []
        """Those of the scan that runs which have not acted yet."""
        self._first = frozenset(numbers[0] for numbers in placing.sites.bodies.values() if self._watching.moving)
        self.needed = bool(self._at or self._violations or any(each.symbol is not None for each in every))
        """Whether it has to listen although no step is under way."""
        self.goal: Goal | None = None
        self.passed = Passed()
        self.pending: Found | None = None
        """Halts before the next statement."""
        self.found: Found | None = None
        self._violated = 0
        self._violating = Violating(resource, placing)

    # ---- what it listens for --------------------------------------------------------------------------------------

    def begin(self) -> None:
        """Before each run."""
        self.found = None
        self._watching.follow()
        self._violated = self._violation_count()
        self._violating.begin(listens=bool(self._violations))
        self._tell()

    def _tell(self, in_scan: bool = False) -> None:
        """`in_scan`: its first statement has begun."""
        goal, end = self.goal, self.passed.end
        scan = self._resource.header.scan
        listens = goal.listens(scan) if goal is not None and goal.action != "continue" else frozenset[int]()
        every = self.pending is not None or bool(self._violations or self._due) or listens is None
        count = 1 if end is not None or self._watching.bytes or self._first or self._scans else 0
        if in_scan and end is not None and end[0] == scan:
            count = end[1]  # the last scan that is kept: it ends in the middle
        sites = frozenset(self._at) | self._first | (listens or frozenset())
        self._resource.listening.listen(Listen(sites, every, count, self._watching.bytes))

    # ---- the hook -------------------------------------------------------------------------------------------------

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        scan = self._resource.header.scan
        here = scan, count
        if count == 1:
            self._watching.follow()
            self._due = [each for each in self._scans if each.breakpoint.scan == scan]
            self._tell(in_scan=True)
        elif site in self._first and self._watching.follow():
            self._tell(in_scan=True)
        if self.passed.end is not None and here >= self.passed.end:
            self.found = None
            return True
        if here <= self.passed.begin:
            self._violated = self._violation_count()
            self._take_due()
            return False
        found = self._after_statement() or self._acting(site, count, scan)
        self._violating.statement()
        if found is None and self.goal is not None:
            if self.goal.reached(site, count, depth, self._frames, scan):
                found = reached(self.goal)
        self.found = found
        return found is not None

    def entered(self) -> None:
        """See `Onlooker`."""
        self._watching.look()

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""
        bits = self._resource.loaded.debugged().bits
        for placed, text in self._watching.touched(
            offset, size, bits, written, lambda placed: self._copies(placed, site)
        ):
            if (self._resource.header.scan, count) < self.passed.begin or not self._acts(placed, None):
                continue
            if self._hit(placed, site, None):
                by, id = placed.breakpoint.author, placed.breakpoint.id
                self._touched(count, Found("data breakpoint", text, by, (id,)))

    def _copies(self, placed: Placed, site: int) -> bool:
        """Whether the block of an in-out by value copies what was passed, before its statements or after them."""
        found = None if placed.block is None else placed.block.locate(self._resource.memory)
        frame = self._frames()[0]
        if found is None or frame.instance != found[0]:
            return False
        return site in self._placing.returns or self._placing.pou_of.get(site) is not frame.pou

    def _touched(self, count: int, found: Found) -> None:
        """Halts after the statement. It may be the last one of the scan."""
        if self.pending is None:
            self.pending = found
            self._resource.loaded.debugged().interrupt()
            self._tell(in_scan=True)

    def after_scan(self) -> Found | None:
        """The halt that the last statement of a scan caused, in the seam after that scan; None if there is none."""
        return self._after_statement()

    # ---- why --------------------------------------------------------------------------------------------------------

    def _after_statement(self) -> Found | None:
        """The halt that the previous statement caused; None if there is none."""
        pending, self.pending = self.pending, None
        count, before = self._violation_count(), self._violated
        self._violated = count
        if pending is not None or count <= before:
            return pending
        for placed in self._violations:
            if self._acts(placed, None) and self._hit(placed, None, None):
                return self._violating.found(placed.breakpoint)
        return None

    def _acting(self, site: int, count: int, scan: int) -> Found | None:
        """What breakpoints do before this statement."""
        found = [each for each in self._take_due() if self._holds(each, None) and self._hit(each, None, None)]
        at_scan = len(found)
        for placed in self._at.get(site, ()):
            frame = self._frames()[0]
            if self._acts(placed, frame) and self._hit(placed, site, frame):
                found.append(placed)
        if not found:
            return None
        by, ids = found[0].breakpoint.author, tuple(each.breakpoint.id for each in found)
        if at_scan:
            return Found("scan", f"scan {scan}", by, ids)
        span = self._placing.sites.statements[site].span
        return Found("breakpoint", f"breakpoint at {span.file}:{span.line}", by, ids)

    def _take_due(self) -> list[Placed]:
        """The breakpoints of this scan that act here: before the first statement of their task, or instance."""
        if not self._due:
            return []
        found = [each for each in self._due if self._is_here(each)]
        if found:
            self._due = [each for each in self._due if each not in found]
            self._tell(in_scan=True)
        return found

    def _acts(self, placed: Placed, frame: Frame | None) -> bool:
        """Whether it is this instance and task, and the condition holds."""
        return self._is_here(placed) and self._holds(placed, frame)

    def _is_here(self, placed: Placed) -> bool:
        """Whether its task and its instance run; a FUNCTION runs for the instance that called it."""
        if placed.instance is None and not placed.task:
            return True
        frames = self._frames()
        if placed.task and self._placing.task_of.get(frames[-1].instance) != placed.task:
            return False
        nearest = next((each.instance for each in frames if each.instance), 0)
        return placed.instance is None or nearest == placed.instance

    def _holds(self, placed: Placed, frame: Frame | None) -> bool:
        """Whether its condition holds."""
        if not placed.conditions:
            return True
        holds, instance = _of_scope(placed.conditions, frame)
        return holds is not None and holds(instance)

    def _hit(self, placed: Placed, site: int | None, frame: Frame | None) -> bool:
        """Counts it, and does what is to be done; whether it halts."""
        actions = self._actions
        if actions is None:
            return placed.halts
        placed.hits += 1
        actions.counted()
        if placed.rule is not None and not placed.rule.holds(placed.hits):
            return False
        breakpoint = placed.breakpoint
        if breakpoint.log:
            says, instance = _of_scope(placed.messages, frame)
            span = None if site is None else self._placing.sites.statements[site].span
            actions.say(breakpoint, says(instance) if says is not None else "", span)
        if breakpoint.assign and frame is not None:
            assigning, instance = _of_scope(placed.assigns, frame)
            assert assigning is not None
            actions.assign(breakpoint, frame, assigning, instance, self._resource.loaded.debugged().count)
            self._watching.look()
        return placed.halts

    def _frames(self) -> tuple[Frame, ...]:
        return self._resource.loaded.debugged().frames()

    def _violation_count(self) -> int:
        return int.from_bytes(self._resource.memory[Layout.SUBRANGE_COUNT : Layout.SUBRANGE_COUNT + 4], "little")


def _of_scope(made: Mapping[Pou | None, T], frame: Frame | None) -> tuple[T | None, int]:
    """What was made for the POU of this frame, and its instance; else what was made for the whole program."""
    if frame is not None and frame.pou in made:
        return made[frame.pou], frame.instance
    return made.get(None), 0


def reached(goal: Goal) -> Found:
    """The halt at the end of a step."""
    reason: HaltReason = "step"
    if goal.action in ("pause", "entry"):
        reason = "pause" if goal.action == "pause" else "entry"
    elif goal.action == "to":
        reason = "goto"
    return Found(reason, goal.words, goal.author)
