"""Faults with a shape in time as commands, and what the journal says of them.

`Arm` gives a fault its number. From then on each step is a `Generate` or `Recover` that names it; `schedule.py` says
which is due. What can be told of a lane after a step follows from `Arm` and that step alone, so that a journal may
forget the steps between.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

from scanbench.check.typed.condition import BadCondition, compile_condition
from scanbench.faults.details import choose
from scanbench.faults.inject import Generate, Recover, choose_all, settled_ref, unfitted
from scanbench.faults.lines import find_line
from scanbench.faults.reference import ErrorRef, error_of, find_error
from scanbench.faults.shapes import Wanted, describe_shape, flaw, lasts, step_count, waits_first
from scanbench.public import Public
from scanbench.runtime.command import Category, Command, Entry, Numbered, Plan, Refusal, View
from scanbench.runtime.journal import Fold

MOST_ARMED = 200
"""Faults that may be armed at once."""


@dataclass(frozen=True, slots=True)
class Arm(Command):
    """Errors that are to come, and how."""

    category: ClassVar[Category] = "error"

    wanted: Wanted

    def settled(self, view: View) -> "Arm":
        """With what tells the instances of its errors apart."""
        refs: list[ErrorRef] = []
        for ref in self.wanted.errors:
            entry = find_error(view.model, ref.id)
            chosen = entry if isinstance(entry, Refusal) else choose(entry, dict(ref.details), view.program.layout)
            if isinstance(chosen, Refusal):
                return self
            refs.append(settled_ref(ref, chosen))
        return replace(self, wanted=replace(self.wanted, errors=tuple(refs)))

    def plan(self, view: View) -> Plan | Refusal:
        """A number for it; the first step is entered when it is due, which may be in this very seam."""
        wanted = self.wanted
        refusal = _refused(self.author, wanted, view)
        if refusal is not None:
            return refusal
        number = view.derived(NUMBERED) + 1
        ids = ", ".join(map(str, wanted.errors))
        return Plan((), f"armed {number}: {ids}, {describe_shape(wanted)}", Numbered(number))


@dataclass(frozen=True, slots=True)
class Disarm(Command):
    """Takes armed faults back, None is all. What they raised and is still present is recovered in the same seam."""

    category: ClassVar[Category] = "recover"

    ids: tuple[int, ...] | None
    why: str = ""
    """Empty when somebody wants it; else why it could not go on."""

    def plan(self, view: View) -> Plan | Refusal:
        """Nothing but words: the fold knows it, and recovering is a step of its own."""
        armed = {lane.number for lane in view.derived(ARMED).values()}
        for id in self.ids or ():
            if id not in armed:
                known = ", ".join(map(str, sorted(armed))) or "none"
                return Refusal(f"no fault {id} is armed: it is over, or never was. Armed: {known}")
        ids = sorted(armed) if self.ids is None else list(dict.fromkeys(self.ids))
        if not ids:
            return Plan((), "no fault is armed")
        faults = f"fault{'s' * (len(ids) != 1)} {', '.join(map(str, ids))}"
        return Plan((), f"{faults} ended: {self.why}" if self.why else f"{faults} taken back")


@dataclass(frozen=True, slots=True)
class Missed(Command):
    """A step of an armed fault that the PLC did not take: it is passed over."""

    category: ClassVar[Category] = "error"

    arm: int
    step: int
    ids: tuple[str, ...]
    why: str

    def plan(self, view: View) -> Plan | Refusal:
        """For the log, and so that the next step comes."""
        return Plan((), f"fault {self.arm} passed over a step: {self.why}")


@dataclass(frozen=True, slots=True)
class Lane:
    """Errors of an armed fault that go through its shape together: all of them, or with a gap each alone."""

    number: int
    wanted: Wanted
    by: str
    errors: tuple[ErrorRef, ...]
    offset: int
    """Scans after the first lane."""
    due: int | None
    """Before which scan its next step comes; None: it waits for its start, or for somebody who recovers it."""
    step: int = 0
    """The next one; even steps raise, odd ones recover."""
    present: tuple[str, ...] = ()
    """What it raised and nobody took over or recovered, in the notation of references; in older runs ids alone."""
    ending: bool = False
    """Taken back: nothing but a recovery comes any more."""

    @property
    def texts(self) -> tuple[str, ...]:
        """Its errors, in the notation of references."""
        return tuple(map(str, self.errors))

    def has_raised(self, ref: ErrorRef) -> bool:
        """Whether this is one of its errors that is present."""
        return any(_same(text, ref) for text in self.present)

    def has(self, ref: ErrorRef) -> bool:
        """Whether this is one of its errors."""
        return any(each.id == ref.id and set(each.details) <= set(ref.details) for each in self.errors)

    @property
    def waiting(self) -> bool:
        """Whether its start, a condition or a line, has not come."""
        return self.step == 0 and self.due is None

    @property
    def since(self) -> int:
        """Before which scan it raised what is present; of one that is to be recovered in time."""
        return 0 if self.due is None else self.due - lasts(self.wanted.shape, self.step - 1)

    @property
    def over(self) -> bool:
        """Whether nothing comes any more."""
        if self.ending:
            return not self.present
        last = step_count(self.wanted.shape)
        return not self.present and last is not None and self.step >= last


@dataclass(frozen=True, slots=True)
class ArmedInfo(Public):
    """A fault that was armed and is not over, for people."""

    PUBLIC: ClassVar = "ArmedFault"

    id: int
    errors: tuple[str, ...]
    text: str
    """Start and shape in a sentence."""
    by: str
    state: Literal["waiting", "running"]
    raised: int
    """How often until now."""
    next_scan: int | None
    """Of its next step, when that is known."""


def armed_faults(lanes: Mapping[str, Lane]) -> tuple[ArmedInfo, ...]:
    """What is armed and not over."""
    faults: dict[int, list[Lane]] = {}
    for lane in lanes.values():
        faults.setdefault(lane.number, []).append(lane)
    return tuple(_info(number, of) for number, of in faults.items())


def _info(number: int, lanes: Sequence[Lane]) -> ArmedInfo:
    wanted = lanes[0].wanted
    raised = max((lane.step + 1) // 2 for lane in lanes)
    dues = [lane.due for lane in lanes if lane.due is not None]
    return ArmedInfo(
        number, tuple(map(str, wanted.errors)), describe_shape(wanted), lanes[0].by,
        "running" if raised else "waiting", raised, min(dues, default=None),
    )  # fmt: skip


# ---- what is refused -----------------------------------------------------------------------------------------------


def _refused(author: str, wanted: Wanted, view: View) -> Refusal | None:
    """Why nothing is entered."""
    if not wanted.errors:
        return Refusal("no error is named: say which error is to come")
    text = flaw(wanted)
    if text is not None:
        return Refusal(text)
    if len({lane.number for lane in view.derived(ARMED).values()}) >= MOST_ARMED:
        return Refusal(f"{MOST_ARMED} faults are armed: take some back first")
    scan = wanted.start.scan
    if wanted.start.kind == "scan" and scan is not None and scan < view.header.scan:
        return Refusal(f"scan {scan} is over: the PLC is at scan {view.header.scan}")
    flawed = unmeant(wanted, view)
    if flawed is not None:
        return flawed
    if wanted.start.kind == "now" and not waits_first(wanted.shape):
        plan = Generate(author, _lanes(wanted)[0]).plan(view)
        return plan if isinstance(plan, Refusal) else None
    return None


def unmeant(wanted: Wanted, view: View, started: bool = False) -> Refusal | None:
    """What of its errors, conditions and lines has no meaning for this program; of one that has begun only what is still
    to come."""
    refusal = _bad_errors(wanted, view)
    if refusal is not None:
        return refusal
    conditions = [wanted.start.condition] if wanted.start.kind == "condition" and not started else []
    if wanted.shape.kind == "unacknowledged" and wanted.shape.acknowledge:
        conditions.append(wanted.shape.acknowledge)
    for text in conditions:
        bad = compile_condition(view.program, text)
        if isinstance(bad, BadCondition):
            return Refusal(f"`{text}`: {bad.message}" if text.strip() else bad.message, bad.near)
    if wanted.start.kind == "line" and not started:
        found = find_line(view.statements, wanted.start.file, wanted.start.line)
        return found if isinstance(found, Refusal) else None
    return None


def _bad_errors(wanted: Wanted, view: View) -> Refusal | None:
    chosen = choose_all(view, wanted.errors)
    if isinstance(chosen, Refusal):
        return chosen
    for index, each in enumerate(chosen):
        entry = each.error
        if (unfit := unfitted(view.model, each)) is not None:
            return unfit
        if entry.severity != "fatal":
            continue
        if wanted.shape.kind != "stay":
            return Refusal(
                f"{entry.id} is fatal: where it stops the program, no scans pass after which it could go. Let it stay, and "
                "recover it by hand"
            )
        if wanted.gap and index < len(wanted.errors) - 1:
            return Refusal(
                f"{entry.id} is fatal: where it stops the program, the errors after it would never come. Put it last, or "
                "raise all at once (gap 0)"
            )
    return None


def _lanes(wanted: Wanted) -> list[tuple[ErrorRef, ...]]:
    return [(ref,) for ref in wanted.errors] if wanted.gap else [wanted.errors]


# ---- what the journal says -----------------------------------------------------------------------------------------

Lanes = Mapping[str, Lane]


def _step(lanes: Lanes, entry: Entry) -> Lanes:
    if entry.plan.starts_fresh:
        return {} if lanes else lanes
    command = entry.command
    match command:
        case Arm():
            return {**lanes, **dict(_armed(command, entry))}
        case Disarm() | Missed() | Generate() | Recover() if lanes:
            changed = {key: _changed(lane, command, entry.scan) for key, lane in lanes.items()}
            if isinstance(command, Generate | Missed) and command.arm is not None:
                changed = _with_others(changed, lanes, command.arm, entry.scan)
            if all(changed[key] is lane and not lane.over for key, lane in lanes.items()):
                return lanes
            return {key: lane for key, lane in changed.items() if not lane.over}
    return lanes


def _armed(command: Arm, entry: Entry) -> Iterator[tuple[str, Lane]]:
    number = entry.plan.effect.number if isinstance(entry.plan.effect, Numbered) else 0
    wanted = command.wanted
    begin = {"now": entry.scan, "scan": wanted.start.scan}.get(wanted.start.kind)
    for index, errors in enumerate(_lanes(wanted)):
        offset = index * wanted.gap
        due = None if begin is None else begin + offset + waits_first(wanted.shape)
        yield f"{number}.{index}", Lane(number, wanted, command.author, errors, offset, due)


def _changed(lane: Lane, command: Command, scan: int) -> Lane:
    """A lane after a command, its own or somebody else's."""
    match command:
        case Disarm(ids=ids):
            taken = ids is None or lane.number in ids
            return replace(lane, ending=True, due=scan if lane.present else None) if taken else lane
        case Generate(arm=lane.number, step=step) if any(map(lane.has, command.errors)):
            return _after(lane, step, scan, lane.texts)
        case Generate():
            return _without(lane, lambda text: _gives_way(text, command))
        case Recover(arm=lane.number, step=step) if any(_goes(text, command) for text in lane.texts):
            return _after(lane, step, scan)
        case Recover():
            return _without(lane, lambda text: _goes(text, command))
        case Missed(arm=lane.number, step=step) if not set(command.ids).isdisjoint((*lane.texts, *_ids(lane))):
            if step % 2 == 1:
                return _after(lane, step, scan)
            # the scans in which it would have been present pass all the same
            return _after(lane, step + 1, scan + lasts(lane.wanted.shape, step))
    return lane


def _same(text: str, ref: ErrorRef) -> bool:
    """Whether this text of a lane means this error, written as it is in `ACTIVE`."""
    return text in (ref.id, str(ref))


def _gives_way(text: str, command: Generate) -> bool:
    if command.replaces is None:
        return error_of(text) in (ref.id for ref in command.errors)
    return any(_same(text, ref) for ref in command.replaces)


def _goes(text: str, command: Recover) -> bool:
    if command.ids is None or error_of(text) in command.ids:
        return True
    return any(_same(text, ref) for ref in command.numbers)


def _ids(lane: Lane) -> Iterator[str]:
    """As steps that were missed name them in older runs."""
    return (ref.id for ref in lane.errors)


def _after(lane: Lane, step: int, scan: int, present: tuple[str, ...] = ()) -> Lane:
    """The lane after a step that was due before `scan`."""
    last = step_count(lane.wanted.shape)
    more = last is None or step + 1 < last
    due = scan + lasts(lane.wanted.shape, step) if more else None
    return replace(lane, step=step + 1, due=due, present=present)


def _without(lane: Lane, gone: Callable[[str], bool]) -> Lane:
    """Somebody else recovered these errors, or raised them again: they are not this lane's any more."""
    left = tuple(text for text in lane.present if not gone(text))
    if left == lane.present:
        return lane
    if left or lane.ending or lane.due is None:
        return replace(lane, present=left)
    return _after(lane, lane.step, lane.due)  # the next time comes when it would have come


def _with_others(changed: Lanes, lanes: Lanes, number: int, scan: int) -> dict[str, Lane]:
    """With the first step of a fault that waited for its start the time of its other lanes is known."""
    began = any(lane.number == number and lane.waiting and not changed[key].waiting for key, lane in lanes.items())
    return {
        key: replace(lane, due=scan + lane.offset) if began and lane.number == number and lane.waiting else lane
        for key, lane in changed.items()
    }


ARMED: Fold[Lanes] = Fold({}, _step)
"""The faults that are armed and not over, each lane by number and place: `3.0`."""
NUMBERED: Fold[int] = Fold(
    0, lambda last, entry: entry.plan.effect.number if isinstance(entry.plan.effect, Numbered) else last
)
"""The number that was given last."""
