"""SetClock: what the PLC's own clock shows."""

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

from scanbench.program.layout import Layout
from scanbench.public import iso
from scanbench.runtime.command import Command, Patch, Plan, Refusal, View

_1970 = datetime(1970, 1, 1, tzinfo=UTC)
_LAST = datetime(2200, 1, 1, tzinfo=UTC)


@dataclass(frozen=True, slots=True)
class SetClock(Command):
    """In the next scan the clock shows `at`; it goes on with virtual time. Permitted in every mode."""

    at: datetime

    def plan(self, view: View) -> Plan | Refusal:
        """A patch of the epoch: virtual time itself never jumps."""
        at = self.at if self.at.tzinfo is not None else self.at.replace(tzinfo=UTC)
        if not _1970 <= at < _LAST:
            return Refusal(f"the clock of a PLC cannot show {at.year}: set a time from 1970 to 2199")
        shown = (at - _1970) // timedelta(microseconds=1) * 1000
        epoch = shown - view.header.next_clock_ns(view.program.interval_ns)
        return Plan((Patch.whole(Layout.EPOCH, epoch.to_bytes(8, "little", signed=True)),), f"clock set to {iso(at)}")
