"""What is entered once more in a run that goes differently: its armed faults and disturbances may have other numbers there."""

from collections.abc import Sequence
from dataclasses import replace

from scanbench.faults.arm import Disarm
from scanbench.faults.disturb.disturb import Calm
from scanbench.runtime.command import Command, Entry, Numbered, Refusal


class Numbers:
    """What the numbers were in the original, and are now."""

    def __init__(self) -> None:
        self._now: dict[int, int | None] = {}
        """None: it was refused this time."""

    def renamed(self, command: Command) -> Command | Refusal:
        """The command with the numbers of now; refused where all that it names was refused."""
        if not isinstance(command, Disarm | Calm) or not command.ids:
            return command
        ids = tuple(now for each in command.ids if (now := self._now.get(each, each)) is not None)
        if not ids:
            return Refusal(f"what it takes back was refused this time: {_listed(command.ids)}")
        return replace(command, ids=ids)

    def note(self, number: int | None, outcome: Entry | Refusal) -> None:
        """What came of the command that had this number in the original."""
        if number is None:
            return
        if isinstance(outcome, Refusal):
            self._now[number] = None
        elif isinstance(outcome.plan.effect, Numbered):
            self._now[number] = outcome.plan.effect.number


def refused(scan: int, command: Command, refusal: Refusal) -> str:
    """For people: before which scan it was not taken, and why."""
    named = f"{type(command).__name__} by {command.author}"
    return f"before scan {scan}: {named}: {refusal.message}"


def _listed(numbers: Sequence[int]) -> str:
    return ", ".join(map(str, numbers))
