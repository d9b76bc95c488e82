"""All breakpoints of one PLC, group by group, with their places in the program that runs."""

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.placed import Placed, Placing
from scanbench.debug.texts import Texts
from scanbench.runtime.programs import Loaded
from scanbench.symbols.sites import sites_of

_KEPT = 3
"""Programs whose statements stay known."""


class Breakpoints:
    """Keeps them in the order in which they were set."""

    def __init__(self) -> None:
        self.placed: tuple[Placed, ...] = ()
        self._placings: list[tuple[Loaded, Placing]] = []

    def placing(self, loaded: Loaded) -> Placing:
        """Places breakpoints in this program."""
        found = next((placing for known, placing in self._placings if known is loaded), None)
        if found is None or found.program is not loaded.statements:
            program = loaded.settled()  # of which debugged code is made, too
            sites = loaded.debug.sites if loaded.debug is not None else sites_of(program)
            found = Placing(program, sites, Texts(program, loaded.memory))
            rest = [each for each in self._placings if each[0] is not loaded]
            self._placings = [*rest[1 - _KEPT :], (loaded, found)]
        return found

    def set(
        self, group: str, kind: str | None, file: str | None, breakpoints: tuple[Breakpoint, ...], placing: Placing,
        scan: int,
    ) -> list[Placed]:  # fmt: skip
        """Puts these in the place of those of the group, of a kind and a file only where these are given. What stays
        as it was goes on counting."""
        known = {each.breakpoint: each for each in self.placed}
        made = [known.get(each) or placing.place(each, scan) for each in breakpoints]
        others = (each for each in self.placed if not each.breakpoint.is_of(group, kind, file))
        self.placed = (*others, *made)
        return made

    def place_again(self, loaded: Loaded, scan: int) -> None:
        """Places all breakpoints in the program `loaded`."""
        if not self.placed:
            return
        placing = self.placing(loaded)
        again = []
        for old in self.placed:
            new = placing.place(old.breakpoint, scan)
            new.hits = old.hits
            again.append(new)
        self.placed = tuple(again)

    def placed_in(self, loaded: Loaded, scan: int) -> tuple[Placed, ...]:
        """The breakpoints with their places in a program that ran earlier; those in `placed` are not changed."""
        placing = self.placing(loaded)
        return tuple(placing.place(each.breakpoint, scan) for each in self.placed)

    def scans_left(self, scan: int, least: int = 1) -> int:
        """Scans that may run, from this one on, until the debug flavour is needed for a breakpoint at a scan."""
        each = [one.breakpoint.scan - scan for one in self.placed if one.breakpoint.kind == "scan" and one.active]
        ahead = [one for one in each if one >= 0]
        return max(least, min(ahead)) if ahead else 1 << 40
