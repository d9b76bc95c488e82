"""Breakpoints as probes: what the run flavour can look for itself, nearly as fast as without."""

from collections.abc import Iterable, Sequence

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.breakpoints import Breakpoints
from scanbench.debug.placed import Placed, Placing
from scanbench.debug.writers import writers
from scanbench.engines.probe import Probe, ProbedEngine
from scanbench.runtime.programs import Loaded


class Probes:
    """The probes that implement the breakpoints of a program, and code that has them."""

    def __init__(self) -> None:
        self._wanted: tuple[Probe, ...] | None = None
        self.engine: ProbedEngine | None = None

    def want(self, breakpoints: Breakpoints, loaded: Loaded) -> tuple[Probe, ...] | None:
        """The probes, when code has to be made for them; None: there is code, or none can do."""
        placed = breakpoints.placed
        wanted = probes_of(placed, breakpoints.placing(loaded)) if placed else None
        if self.engine is not None and wanted == self.engine.probes:
            return None
        self._wanted, self.engine = wanted, None
        return wanted

    def take(self, engine: ProbedEngine) -> None:
        """Takes it, if it is still what is wanted."""
        if engine.probes == self._wanted:
            self.engine = engine


def probes_of(placed: Iterable[Placed], placing: Placing) -> tuple[Probe, ...] | None:
    """Probes that say when any of these may act; None where one needs the debug flavour to know."""
    found: list[Probe] = []
    for each in placed:
        if not each.active or each.breakpoint.kind in ("error", "trap", "scan"):
            continue
        made = _of_line(each, placing, halt=True) if _plain(each.breakpoint) else None
        if made is None:
            return None
        found += made
    return tuple(found) or None


def notes_of(placed: Sequence[Placed], placing: Placing) -> tuple[Probe, ...] | None:
    """The same to find out afterwards where they would have halted last: more probes may be reached than that."""
    found: list[Probe] = []
    for each in placed:
        if not each.active:
            continue
        if each.breakpoint.kind == "line":
            found += _of_line(each, placing, halt=False) or ()
        elif each.symbol is not None and each.breakpoint.access in ("write", "change"):
            sites = writers(placing.program, placing.sites, each.symbol)
            if sites is None:
                return None
            found += [Probe(site, sites[site], False) for site in sorted(sites)]
        elif each.breakpoint.kind not in ("error", "trap", "scan"):
            return None
    return tuple(found)


def _plain(breakpoint: Breakpoint) -> bool:
    """Whether nothing but its line and condition says when it halts."""
    more = breakpoint.hits or breakpoint.log or breakpoint.assign or breakpoint.instance or breakpoint.task
    return breakpoint.kind == "line" and not more.strip()


def _of_line(placed: Placed, placing: Placing, halt: bool) -> list[Probe] | None:
    made = []
    for site in sorted(placed.sites):
        text, expr = placed.breakpoint.condition, None
        if text.strip():
            local = placing.texts.local(placing.pou_of.get(site), text)
            if local.calls:
                if halt:
                    return None
            else:
                expr = local.expr
        made.append(Probe(site, expr, halt))
    return made
