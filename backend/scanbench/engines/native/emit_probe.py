"""Probed code: a test where chosen statements begin; see `engines.probe`. All other statements are as in the run flavour."""

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext

from scanbench.check.layout import Layout
from scanbench.check.program import Expr, If, Pou, Program, Stmt
from scanbench.check.sites import Sites, sites_of
from scanbench.engines.native import walk
from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.flavour import Flavour
from scanbench.engines.native.speculate import harmless
from scanbench.engines.probe import BadProbe, Probe

SLOTS = "@probes"
"""An i64 for each probe: the last scan that reached it, or `NEVER`."""
NEVER = -1
SILENT = "@probes.silent"
"""u8: what runs is not the user's program. Looked at only in POUs that it runs too."""
TAG = "#probes"
"""Of accesses to these: no variable lies there."""


HALTED = -1
"""The status of a scan in which a probe that halts was reached; the numbers of traps are positive. The scan is run to its end
before: nobody can tell, as the image is of no use, and leaving at once would keep loops from being optimised."""


class Probing(Flavour):
    """Code with probes."""

    def __init__(self, program: Program, probes: Sequence[Probe]) -> None:
        """Raises BadProbe."""
        self.sites: Sites = sites_of(program)
        self._probes = tuple(probes)
        self._at: dict[int, list[int]] = {}
        self._of: dict[Pou, list[int]] = {}
        pous = {site: pou for pou, sites in self.sites.bodies.items() for site in sites}
        for number, probe in enumerate(probes):
            self._check(probe)
            self._at.setdefault(probe.site, []).append(number)
            if probe.site in pous:
                self._of.setdefault(pous[probe.site], []).append(number)
        others = _runs(each.pou for each in (*program.common, *program.plant))
        self._doubtful = frozenset(pou for pou in self._of if pou in others)

    def _check(self, probe: Probe) -> None:
        if not 0 <= probe.site < len(self.sites.statements):
            raise BadProbe(probe, None, f"the program has {len(self.sites.statements)} of them")
        if probe.condition is not None and walk.disturbs(probe.condition):
            why = "its condition calls the program; put a breakpoint of the debug flavour there"
            raise BadProbe(probe, self.sites.statements[probe.site], why)

    # ---- what the code of a POU depends on --------------------------------------------------------------------

    def key(self, pou: Pou) -> object:
        own = self._of.get(pou)
        return own and (tuple((number, self._at_site(pou, number)) for number in own), pou in self._doubtful)

    def _at_site(self, pou: Pou, number: int) -> object:
        # the numbers of sites change with other POUs
        probe = self._probes[number]
        return self.sites.bodies[pou].index(probe.site), probe.condition, probe.halt

    def looks(self, pou: Pou) -> tuple[Expr, ...]:
        conditions = (self._probes[number].condition for number in self._of.get(pou, ()))
        return tuple(each for each in conditions if each is not None)

    def declare(self, unit: Unit) -> None:
        slots = ", ".join(f"i64 {NEVER}" for _ in self._probes)
        unit.module.define(SLOTS, f"global [{len(self._probes)} x i64] [ {slots} ], align 8")
        unit.module.define(SILENT, "global i8 0, align 1")

    # ---- the code ---------------------------------------------------------------------------------------------

    def silence(self, body: Body, silent: bool) -> None:
        if self._doubtful:
            self._refer(body.unit)
            body.text.do(f"store i8 {int(silent)}, ptr {SILENT}, align 1{body.module.tag(TAG)}")

    def done(self, body: Body) -> None:
        halting = [number for number, probe in enumerate(self._probes) if probe.halt]
        for number in halting:
            self._refer(body.unit)
            reached = body.text.op(f"icmp eq i64 {_last(body, number)}, {_now(body)}")
            body.text.trap_status(reached, str(HALTED))

    def may_select(self, body: Body, statement: If) -> bool:
        return all(harmless(body, each) for each in self._conditions(statement))

    def _conditions(self, statement: Stmt) -> Iterator[Expr]:
        """Of the probes inside of a statement."""
        for inner in (each for each_body in walk.bodies(statement) for each in each_body):
            probes = (self._probes[number] for number in self._numbers(inner))
            yield from (probe.condition for probe in probes if probe.condition is not None)
            yield from self._conditions(inner)

    def _numbers(self, statement: Stmt) -> Sequence[int]:
        site = self.sites.number(statement)
        return () if site is None else self._at.get(site, ())

    def statement(self, body: Body, statement: Stmt) -> AbstractContextManager[None]:
        self.selected(body, statement, "true")
        return nullcontext()

    def selected(self, body: Body, statement: Stmt, guard: str) -> None:
        for number in self._numbers(statement):
            self._refer(body.unit)
            self._look(body, number, guard)

    def _look(self, body: Body, number: int, guard: str) -> None:
        """Without a branch if that can be: then a loop around may still be turned into one for vectors."""
        text, condition = body.text, self._probes[number].condition
        if body.pou in self._doubtful:
            silent = text.op(f"load i8, ptr {SILENT}, align 1{body.module.tag(TAG)}")
            guard = text.op(f"and i1 {guard}, {text.op(f'icmp eq i8 {silent}, 0')}")
        if condition is None:
            _note(body, number, guard)
        elif harmless(body, condition):
            _note(body, number, text.op(f"and i1 {guard}, {body.scalar(condition).ssa}"))
        else:
            evaluate, on = text.name("evaluate"), text.name("on")
            text.choose(guard, evaluate, on)
            text.begin(evaluate)
            with text.trapping_to(on):
                holds = body.scalar(condition).ssa
            _note(body, number, holds)
            text.go(on)
            text.begin(on)
        text.end_statement()

    def _refer(self, unit: Unit) -> None:
        unit.module.refer(SLOTS, "external global [0 x i64], align 8")
        unit.module.refer(SILENT, "external global i8, align 1")


def _note(body: Body, number: int, holds: str) -> None:
    scan = _now(body)
    if holds != "true":
        scan = body.text.op(f"select i1 {holds}, i64 {scan}, i64 {_last(body, number)}")
    body.text.do(f"store i64 {scan}, ptr {_slot(number)}, align 8{body.module.tag(TAG)}")


def _slot(number: int) -> str:
    return f"getelementptr (i8, ptr {SLOTS}, i64 {8 * number})"


def _last(body: Body, number: int) -> str:
    """The scan that last reached it."""
    return body.text.op(f"load i64, ptr {_slot(number)}, align 8{body.module.tag(TAG)}")


def _now(body: Body) -> str:
    where = body.text.address(body.image, Layout.SCAN)
    return body.text.op(f"load i64, ptr {where}, align 8{body.module.tag('#scan')}")


def _runs(pous: Iterator[Pou]) -> set[Pou]:
    """These POUs and all that they call."""
    found: set[Pou] = set()
    left = list(pous)
    while left:
        pou = left.pop()
        if pou not in found:
            found.add(pou)
            left += [seen for seen in walk.of_statements(pou.body) if isinstance(seen, Pou)]
    return found
