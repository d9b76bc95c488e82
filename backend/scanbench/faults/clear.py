"""The device's own way to clear errors: what a tool or the program may take back, and what shows again at once.

An error whose cause lasts comes back as soon as it is cleared. The error simulator is the cause of what it raised, so such
an error stays until it is recovered there.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.faults.details import Chosen
from scanbench.faults.inject import ACTIVE, Recover, describe, present_choices
from scanbench.faults.present import Active, Raised, Way
from scanbench.faults.reference import ErrorRef
from scanbench.faults.switch import rank
from scanbench.runtime.command import Category, Command, Patch, Plan, Refusal, View
from scanbench.runtime.rights import Right, may

WILL_NOT_CLEAR = "error will not clear"
"""How a refusal begins when the cause is still there."""


@dataclass(frozen=True, slots=True)
class ClearErrors(Command):
    """As a tool does it: the most serious error, all of them, or that of a code. Journaled as the `Recover` it comes to."""

    what: Literal["current", "all"] | int

    def settled(self, view: View) -> Command:
        """The Recover of what goes now; itself where nothing does."""
        present = view.derived(ACTIVE)
        return clear(view, present, self.author, self._wanted(view, present), "tool")[0] or self

    def plan(self, view: View) -> Plan | Refusal:
        """What the Recover plans, or why nothing goes."""
        if (refusal := may(view.header.mode, Right.CLEAR)) is not None:
            return refusal
        present = view.derived(ACTIVE)
        recover, held = clear(view, present, self.author, self._wanted(view, present), "tool")
        if recover is not None:
            return recover.plan(view)
        if held:
            which = ", ".join(map(describe, held))
            near = tuple(dict.fromkeys(one.error.id for one in held))
            return Refusal(
                f"{WILL_NOT_CLEAR}: the cause of {which} is still there; recover it in the error simulator", near
            )
        if present and not isinstance(self.what, int):
            return Plan((), "no error is present that the device clears: what is there has no code")
        if isinstance(self.what, int):
            code = view.model.show_code(self.what)
            return Refusal(f"no error with code {code} is present", tuple(present))
        return Plan((), "no error is present")

    def _wanted(self, view: View, present: Mapping[str, Active]) -> Callable[[Chosen], bool]:
        if self.what == "all":
            return lambda one: True
        if self.what == "current":
            return most_serious(view, present, lambda one: True)
        return lambda one: one.code == self.what


@dataclass(frozen=True, slots=True)
class ClearErrorLog(Command):
    """As a tool does it: the model's own error log is empty."""

    category: ClassVar[Category] = "recover"

    def plan(self, view: View) -> Plan | Refusal:
        """The counter to 0; records stay in the memory, as on the device."""
        log = view.model.log
        if log is None:
            return Refusal(f"{view.model.name} has no error log in its memory")
        counter = view.program.layout.areas[log.counter.area.name] + log.counter.byte
        return Plan((Patch.whole(counter, bytes(2)),), "error log cleared")


def clear(
    view: View, present: Mapping[str, Active], author: str, wanted: Callable[[Chosen], bool], way: Way
) -> tuple[Recover | None, list[Chosen]]:
    """The command that takes back what is wanted and can go, if anything can, and what cannot. What has no code is not
    among the errors that a device clears."""
    ids: list[str] = []
    numbers: list[ErrorRef] = []
    held: list[Chosen] = []
    for id, several in present_choices(view, present).items():
        chosen = [
            (each, one)
            for each, one in zip(present[id].raised, several, strict=True)
            if one.error.coded and wanted(one)
        ]
        gone = [each.ref for each, one in chosen if not holds(each, one)]
        held += [one for each, one in chosen if holds(each, one)]
        if gone and len(gone) == len(several):
            ids.append(id)
        else:
            numbers += gone
    gone_now = Recover(author, tuple(ids), numbers=tuple(numbers), way=way) if ids or numbers else None
    return gone_now, held


def holds(raised: Raised, chosen: Chosen) -> bool:
    """Whether the cause is still there."""
    return chosen.lasting and raised.origin == "simulator"


def most_serious(
    view: View, present: Mapping[str, Active], among: Callable[[Chosen], bool]
) -> Callable[[Chosen], bool]:
    """Just the one that the code word shows, of those that `among` lets through."""
    every = [
        one for several in present_choices(view, present).values() for one in several if one.error.coded and among(one)
    ]
    first = min(every, key=rank, default=None)
    return lambda one: first is not None and one.error is first.error and one.details == first.details


def nonfatal(one: Chosen) -> bool:
    """Whether the program goes on with it."""
    return one.error.severity == "nonfatal"
