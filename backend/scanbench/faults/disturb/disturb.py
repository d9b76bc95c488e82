"""Disturbances of the control device: commands through the one door, and what the journal says of them.

`Disturb` gives a disturbance its number. Whenever its time comes, `schedule.py` enters what it does
(`fire.py`), so a replay has all of it and asks nobody. The monitor leaves all of these commands out.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

from scanbench.faults.arm import NUMBERED
from scanbench.faults.disturb.definition import Disturbance, DisturbanceKind, describe, flaw, next_firing, what_of
from scanbench.faults.disturb.fire import Corrupt, Firing, Flip, Hold, Unfired, Unhold, freed
from scanbench.public import Public
from scanbench.runtime.command import Category, Command, Entry, Numbered, Plan, Refusal, Restarted, Swapped, View
from scanbench.runtime.command import Freed as FreedEffect
from scanbench.runtime.journal import Fold

MOST_DISTURBANCES = 200
"""That may be there at once."""


@dataclass(frozen=True, slots=True)
class Disturb(Command):
    """Something is to go wrong, once or by chance."""

    category: ClassVar[Category] = "disturbance"

    wanted: Disturbance

    def plan(self, view: View) -> Plan | Refusal:
        """A number for it; what it does is entered when its time comes, which may be in this very seam."""
        refusal = flaw(self.wanted, view)
        if refusal is not None:
            return refusal
        if len(view.derived(DISTURBED)) >= MOST_DISTURBANCES:
            return Refusal(f"there are {MOST_DISTURBANCES} disturbances: take some back first")
        number = view.derived(NUMBERED) + 1
        return Plan((), f"disturbance {number}: {describe(self.wanted)}", Numbered(number))


@dataclass(frozen=True, slots=True)
class Calm(Command):
    """Takes disturbances back, None is all. What they hold has its real value again."""

    category: ClassVar[Category] = "disturbance"

    ids: tuple[int, ...] | None

    def plan(self, view: View) -> Plan | Refusal:
        """What is held is let go."""
        known = [each.number for each in view.derived(DISTURBED).values()]
        for id in self.ids or ():
            if id not in known:
                numbers = ", ".join(map(str, known)) or "none"
                return Refusal(f"there is no disturbance {id}: it is over, or never was. There are: {numbers}")
        ids = tuple(known) if self.ids is None else tuple(dict.fromkeys(self.ids))
        if not ids:
            return Plan((), "there is no disturbance")
        text = f"disturbance{'s' * (len(ids) != 1)} {', '.join(map(str, ids))} taken back"
        return Plan(freed(view, ids), text, FreedEffect(ids))


@dataclass(frozen=True, slots=True)
class Disturbed:
    """A disturbance that is not over."""

    number: int
    wanted: Disturbance
    by: str
    next: int | None
    """The scan in which it comes next; None: not any more."""
    time: int = 0
    """How often it was tried."""
    fired: int = 0
    """How often that changed anything."""
    active: bool = False
    """It holds an input."""
    until: int | None = None
    """Before this scan it lets go; None: when it is taken back."""
    holding: bool = False
    """What it holds is in the force table, from which a restart or a program change removes it."""
    missed: str = ""
    """Why it never came about, though its time is over: it is known until somebody takes it back."""

    @property
    def over(self) -> bool:
        """Whether nothing comes any more, and it was what it should be."""
        return not self.active and self.next is None and not self.missed


Disturbeds = Mapping[str, Disturbed]


@dataclass(frozen=True, slots=True)
class DisturbanceInfo(Public):
    """A disturbance that is not over, or was missed, for people."""

    id: int
    text: str
    """`Memory D120, bit 0, once in scan 500`"""
    kind: DisturbanceKind
    by: str
    state: Literal["waiting", "active", "missed"]
    """missed: its time is over and nothing was changed; it is listed until it is taken back."""
    fired: int
    """How often until now."""
    next_scan: int | None
    why: str = ""
    """missed: the scan, and why."""


def disturbances(state: Disturbeds) -> tuple[DisturbanceInfo, ...]:
    """Those that are not over; `state` is that of `DISTURBED`."""
    return tuple(
        DisturbanceInfo(
            each.number, describe(each.wanted), each.wanted.kind, each.by,
            "missed" if each.missed else "active" if each.active else "waiting", each.fired, each.next, each.missed,
        )
        for each in state.values()
    )  # fmt: skip


# ---- for the monitor -----------------------------------------------------------------------------------------------


def is_disturbance(command: Command) -> bool:
    """Whether the monitor leaves this out: it happens to the control device alone."""
    return command.category == "disturbance"


def told(entry: Entry) -> str:
    """What was done to the control device, for people: `Memory D120, bit 0`; empty for what disturbs nothing."""
    command = entry.command
    match command:
        case Flip():
            return f"{what_of('flip', command.path, '')}, bit {command.bit}"
        case Corrupt():
            return f"{what_of('result', '', command.site)}, bit {command.index}"
        case Hold():
            return _told_held("late" if command.late else "stuck", command.path)
    return ""


def told_held(state: Disturbeds) -> Iterator[str]:
    """What is done to the control device as long as it is held: `Input start stuck`; `state` is that of `DISTURBED`."""
    return (_told_held(each.wanted.kind, each.wanted.path) for each in state.values() if each.holding)


def _told_held(kind: DisturbanceKind, path: str) -> str:
    return f"{what_of(kind, path, '')} {kind}"


# ---- what the journal says -----------------------------------------------------------------------------------------


def _step(all: Disturbeds, entry: Entry) -> Disturbeds:
    command, effect = entry.command, entry.plan.effect
    if all and (isinstance(effect, Swapped) or (isinstance(effect, Restarted) and effect.kind != "warm")):
        return {key: replace(each, holding=False) if each.holding else each for key, each in all.items()}
    match command:
        case Disturb():
            made = _begun(command, entry)
            return all if made.over else {**all, str(made.number): made}
        case Calm(ids=ids) if all:
            return {key: each for key, each in all.items() if ids is not None and each.number not in ids}
        case Firing(id=id) if str(id) in all:
            changed = _after(all[str(id)], command, entry.scan)
            if changed.over:
                return {key: each for key, each in all.items() if key != str(id)}
            return {**all, str(id): changed}
    return all


def _begun(command: Disturb, entry: Entry) -> Disturbed:
    number = entry.plan.effect.number if isinstance(entry.plan.effect, Numbered) else 0
    # the scan in which it is entered has begun already where a debugger had halted that
    first = max(command.wanted.scan or 0, entry.scan + (1 if entry.step else 0))
    return Disturbed(number, command.wanted, command.author, next_firing(command.wanted, number, 0, first))


def _after(each: Disturbed, command: Firing, scan: int) -> Disturbed:
    """After what it did before this scan, or inside of it."""
    tried = replace(each, time=command.time, fired=command.fired)
    match command:
        case Hold():
            return replace(tried, next=None, active=True, until=command.until, holding=True)
        case Unhold():
            return replace(tried, next=_next(tried, scan), active=False, until=None, holding=False)
        case Unfired():
            tried = replace(tried, next=_next(tried, command.scan + 1), active=False, until=None, holding=False)
            missed = tried.next is None and not tried.fired
            return replace(tried, missed=f"scan {command.scan}: {command.why}") if missed else tried
    return replace(tried, next=_next(tried, scan + 1))


def _next(each: Disturbed, first: int) -> int | None:
    enough = bool(each.wanted.times) and each.fired >= each.wanted.times
    return None if enough else next_firing(each.wanted, each.number, each.time, first)


DISTURBED: Fold[Disturbeds] = Fold({}, _step)
"""The disturbances that are not over, by number; those that never came about stay until they are taken back."""
