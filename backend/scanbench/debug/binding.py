"""What an in-out is bound to: who passes what to it, and which of them ran last."""

from scanbench.debug.bound_to import Bound, BoundTo, Convention
from scanbench.program.copies import Spot, referred
from scanbench.program.program import Program
from scanbench.program.tasks import Task
from scanbench.program.types import Elementary, StringType
from scanbench.runtime.command import View
from scanbench.runtime.target import not_called, passed_by, read_only_reason
from scanbench.symbols.call_sites import (
    Calls,
    CallSite,
    Formal,
    address,
    can_reach,
    formal_of,
    in_every_run,
    slot_value,
)
from scanbench.symbols.names import names_of, same_place
from scanbench.symbols.symbols import Symbol, resolve

UNKNOWN_INDEX = "what it passes cannot be told now: it is computed from values that are not there yet"


class Bindings:
    """Answers about one program; finds its calls once."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._calls: Calls | None = None

    def of(self, view: View, path: str, inside: bool = False) -> Bound:
        """The binding of the last in-out on a path; `inside`: a debugger has halted the scan in the middle. Raises
        `UnknownPath`."""
        symbol = resolve(self._program, path.strip())
        formal = formal_of(self._program, symbol.path)
        if formal is None:
            return Bound(False, f"{symbol.path} is no in-out: a write goes to itself", "reference", ())
        self._calls = self._calls or Calls(self._program)
        convention: Convention = "value" if formal.member.copied else "reference"
        sites = self._calls.sites(formal, view.memory)
        slot = slot_value(formal, view.memory)
        last = None if slot is None else referred(slot)
        chosen = _last(formal, sites, last, view)
        rows = [self._row(view, formal, symbol, each, each in chosen, inside) for each in sites]
        if last is None:
            return Bound(False, not_called(view, symbol), convention, tuple(rows))
        if not chosen:  # through a reference that refers elsewhere by now, or from a place that is no statement
            place = symbol.locate(view.memory)
            rows.insert(0, self._shown(view, symbol, place, None, True, None))
        return Bound(True, "", convention, tuple(rows))

    def _row(self, view: View, formal: Formal, symbol: Symbol, site: CallSite, last: bool, inside: bool) -> BoundTo:
        place = symbol.locate(view.memory) if last else passed_by(view, formal, symbol.path, site)
        scan = None if inside or view.header.halted_by_trap else self._scan(view, site, set())
        return self._shown(view, symbol, place, site, last, scan)

    def _shown(
        self, view: View, symbol: Symbol, place: Spot | None, site: CallSite | None, last: bool, scan: int | None
    ) -> BoundTo:
        actual, address, message = "", "", ""
        if place is None:
            message = UNKNOWN_INDEX
        elif (temporary := names_of(self._program).temporary(place[0])) is not None:
            pou, name = temporary
            actual = f"{pou.name}.{name}" if name else ""
            message = "a temporary, which is gone when the call is over" if name else "a value that was computed"
        else:
            named = names_of(self._program).variable(place, symbol.type)
            if named is not None:
                actual, address = named.path, named.address or ""
            if isinstance(symbol.type, Elementary | StringType):
                message = read_only_reason(view, symbol, *place) or ""
        if site is None:
            return BoundTo(actual, address, "", 0, 0, "", scan, last, message)
        span = site.span
        return BoundTo(actual, address, span.file, span.line, span.column, site.path, scan, last, message)

    # ---- when -----------------------------------------------------------------------------------------------------

    def _scan(self, view: View, site: CallSite, seen: set[int]) -> int | None:
        """The scan in which a call ran last, where it runs in each that its task runs in; else nobody noted it."""
        if not in_every_run(site.caller, site.call) or site.offset in seen or self._calls is None:
            return None
        if site.caller.kind == "function":
            return None
        task = next(
            (task for task in self._program.tasks if any(each.offset == site.offset for each in task.programs)), None
        )
        if task is not None:
            return _last_scan(view, task)
        callers = self._calls.of(resolve(self._program, site.path), view.memory)
        scans = {self._scan(view, each, seen | {site.offset}) for each in callers}
        return scans.pop() if len(scans) == 1 else None


def _last_scan(view: View, task: Task) -> int | None:
    """The last scan in which a task without an event ran."""
    ended = view.header.scan - 1
    if task.single is not None or not task.every or ended < view.header.started:
        return None
    scan = ended - ended % task.every
    return scan if scan >= view.header.started else None


def _last(formal: Formal, sites: list[CallSite], last: tuple[int, int] | None, view: View) -> list[CallSite]:
    """Which of them ran last: those that pass what the slot refers to, as far as that can be told."""
    if last is None:
        return []
    passing = [each for each in sites if _passes(formal, each, last, view)]
    if passing or len(sites) == 1:
        return passing or sites
    return [each for each in sites if _may_pass(formal, each, last)]


def _passes(formal: Formal, site: CallSite, last: tuple[int, int], view: View) -> bool:
    actual = site.passes(formal)
    found = None if actual is None else address(site.caller, actual, site.offset, view.memory)
    return found is not None and same_place(found, last)


def _may_pass(formal: Formal, site: CallSite, last: tuple[int, int]) -> bool:
    actual = site.passes(formal)
    return actual is not None and can_reach(actual, site.caller, site.offset, last[0])
