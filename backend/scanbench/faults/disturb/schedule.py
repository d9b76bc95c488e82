"""When a disturbance comes about: `runtime.agenda.Agenda` over the journal."""

from collections.abc import Sequence

from scanbench.faults.disturb.definition import bits_of, chance, single_value, writing_sites
from scanbench.faults.disturb.disturb import DISTURBED, Disturbed
from scanbench.faults.disturb.fire import Firing, Flip, Hold, Unfired, Unhold
from scanbench.faults.disturb.result import Results, Wish
from scanbench.program.program import Program
from scanbench.runtime.agenda import NOTHING, Met, Waits
from scanbench.runtime.command import Command, Refusal, View


class DisturbanceSchedule:
    """Keeps nothing but what it worked out last, for the same program, and why a result did not come about."""

    def __init__(self) -> None:
        self._program: Program | None = None
        self._sites: dict[str, frozenset[int] | Refusal] = {}
        self._wishes: Sequence[Wish] = ()
        self._scan = 0

    def due(self, view: View, met: Met) -> Command | None:
        """See `Agenda`."""
        all = view.derived(DISTURBED)
        self._scan = scan = view.header.scan
        for each in all.values():
            command: Command | None = None
            if each.active:
                command = _held_on(each, scan)
            elif each.next is not None and each.next <= scan:
                command = self._result(each, view) if each.wanted.kind == "result" else _firing(each, view)
            if command is not None:
                return command
        return None

    def refused(self, command: Command, refusal: Refusal) -> Command:
        """It did not come about, and the log says why."""
        if not isinstance(command, Firing) or isinstance(command, Unfired):
            raise ValueError(f"{command} is no step of a disturbance, and was refused: {refusal.message}")
        fired = command.fired - (not isinstance(command, Unhold))
        return Unfired(command.author, command.id, command.time, fired, self._scan, refusal.message)

    def waits(self, view: View) -> Waits:
        """The next time in the order of scans, and the results to be disturbed in the one that is next."""
        all = view.derived(DISTURBED)
        if not all:
            return NOTHING
        scan = view.header.scan
        self._wishes = [
            Wish(each, sites)
            for each in all.values()
            if each.wanted.kind == "result"
            and each.next == scan
            and isinstance(sites := self._sites_of(each.wanted.site, view), frozenset)
        ]
        scans = [scan + 1] if self._wishes else []
        for each in all.values():
            at = each.until if each.active else each.next
            if at is not None and at > scan:
                scans.append(at)
        return Waits(min(scans, default=None), inside=Results(view.program, self._wishes) if self._wishes else None)

    def _result(self, each: Disturbed, view: View) -> Unfired | None:
        """A result of a scan that is over and was not disturbed, or cannot be."""
        assert each.next is not None
        sites, why = self._sites_of(each.wanted.site, view), ""
        if each.next < view.header.scan:
            tried = (wish for wish in self._wishes if wish.of.number == each.number and wish.of.time == each.time)
            why = next((wish.why for wish in tried), "the statement did not run")
        elif isinstance(sites, Refusal):
            why = sites.message
        return Unfired(each.by, each.number, each.time + 1, each.fired, each.next, why) if why else None

    def _sites_of(self, site: str, view: View) -> frozenset[int] | Refusal:
        if view.statements is not self._program:
            self._program = view.statements
            self._sites.clear()
        if site not in self._sites:
            self._sites[site] = writing_sites(view.statements, site)
        return self._sites[site]


def _held_on(each: Disturbed, scan: int) -> Command | None:
    """The end of what is held; or its hold again, if a restart or a program change removed it."""
    if each.until is not None and each.until <= scan:
        return Unhold(each.by, each.number, each.time, each.fired)
    if each.holding:
        return None
    return Hold(each.by, each.number, each.time, each.fired, each.wanted.path, each.until, each.wanted.kind == "late")


def _firing(each: Disturbed, view: View) -> Command:
    wanted, time, fired, scan = each.wanted, each.time + 1, each.fired + 1, view.header.scan
    if wanted.kind != "flip":
        until = None if wanted.lasts is None else scan + wanted.lasts
        return Hold(each.by, each.number, time, fired, wanted.path, until, wanted.kind == "late")
    symbol = single_value(view, wanted.path)
    bit = wanted.bit
    if bit is None:
        bit = 0 if isinstance(symbol, Refusal) else chance(wanted, each.number, each.time, "bit") % bits_of(symbol)
    return Flip(each.by, each.number, time, fired, wanted.path, bit)
