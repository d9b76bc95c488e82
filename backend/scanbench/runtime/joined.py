"""Several agendas as one."""

from dataclasses import replace

from scanbench.runtime.agenda import NOTHING, Agenda, Met, Waits
from scanbench.runtime.command import Command, Refusal, View


class Joined:
    """What is due of the first one comes first. Only one of them may wait to enter something inside of a scan."""

    def __init__(self, *agendas: Agenda) -> None:
        self._agendas = agendas
        self._asked = agendas[0]
        """Whose command was due last."""

    def due(self, view: View, met: Met) -> Command | None:
        """See `Agenda`."""
        for agenda in self._agendas:
            command = agenda.due(view, met)
            if command is not None:
                self._asked = agenda
                return command
        return None

    def refused(self, command: Command, refusal: Refusal) -> Command:
        """See `Agenda`."""
        return self._asked.refused(command, refusal)

    def waits(self, view: View) -> Waits:
        """See `Agenda`."""
        all = NOTHING
        for agenda in self._agendas:
            each = agenda.waits(view)
            if each is NOTHING:
                continue
            scans = [scan for scan in (all.scan, each.scan) if scan is not None]
            all = each if all is NOTHING else replace(
                all, scan=min(scans, default=None), conditions=(*all.conditions, *each.conditions),
                sites=all.sites | each.sites, observed=all.observed or each.observed, inside=all.inside or each.inside,
            )  # fmt: skip
        return all
