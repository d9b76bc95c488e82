"""What people say of an error at an alarm list: that they have seen it, and a remark. The PLC and its memory know nothing of it.

It is entered like any command, so it is in the log with its author, and in the run.
"""

from dataclasses import dataclass
from datetime import datetime
from typing import ClassVar

from scanbench.faults.details import Chosen, choose
from scanbench.faults.inject import RAISED
from scanbench.faults.reference import ErrorRef, named_reference
from scanbench.runtime.command import Category, Command, Plan, Refusal, View

LONGEST_REMARK = 200
"""Characters."""


@dataclass(frozen=True, slots=True)
class Acknowledged:
    """Who has seen that an error was raised."""

    by: str
    at: datetime
    scan: int
    remark: str
    """Empty: none."""


@dataclass(frozen=True, slots=True)
class Acknowledge(Command):
    """Somebody has seen that an error was raised; whether it is still present does not matter."""

    category: ClassVar[Category] = "system"

    error: str
    """In the notation of references: `battery-error`, `fal:number=5`."""
    remark: str
    raised: int | None = None
    """Before which scan it was raised, the time that was seen: it may have been raised again since. None: the last time."""

    def plan(self, view: View) -> Plan | Refusal:
        """Nothing in memory."""
        refused = _refused(view, self.error, self.remark) or self._not_that(view)
        if refused is not None:
            return refused
        if not self.remark:
            return Plan((), f"{self.error} was acknowledged")
        return Plan((), f"{self.error} was acknowledged: {self.remark}")

    def _not_that(self, view: View) -> Refusal | None:
        """Why there is nothing that could be acknowledged, or not what was seen."""
        key = _instance(view, named_reference(self.error))
        scans = [scan for text, scan in view.derived(RAISED).items() if _instance(view, named_reference(text)) == key]
        if not scans:  # or so long ago that the run file has dropped it, as it is gone: then the client knows when
            none = Refusal(f"{self.error} was not raised: there is nothing to acknowledge")
            return none if self.raised is None else None
        if self.raised is not None and self.raised != max(scans):
            return Refusal(
                f"{self.error} was raised again before scan {max(scans):,}: what was acknowledged was raised before scan "
                f"{self.raised:,}. Look at the new one first"
            )
        return None


@dataclass(frozen=True, slots=True)
class Remark(Command):
    """Somebody has something to say of an error."""

    category: ClassVar[Category] = "system"

    error: str
    remark: str

    def plan(self, view: View) -> Plan | Refusal:
        """Nothing in memory."""
        if not self.remark:
            return Refusal("a remark has to say something")
        return _refused(view, self.error, self.remark) or Plan((), f"{self.error}: remark: {self.remark}")


def _instance(view: View, ref: ErrorRef) -> str:
    """Which instance an error with these details is of, as lists of errors name it."""
    error = view.model.error(ref.id)
    chosen = None if error is None else choose(error, dict(ref.details), view.program.layout)
    return str(chosen.instance) if isinstance(chosen, Chosen) else str(ref)


def _refused(view: View, error: str, remark: str) -> Refusal | None:
    found = view.model.error(named_reference(error).id)
    if found is None:
        return Refusal(f"{view.model.name} has no error {error}")
    if len(remark) > LONGEST_REMARK:
        return Refusal(f"a remark has up to {LONGEST_REMARK} characters, not {len(remark)}")
    return None
