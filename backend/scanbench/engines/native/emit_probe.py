"""Probed code: a test where chosen statements begin; see `engines.probe`. All other statements are as in the run flavour."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from scanbench.check.layout import Layout
from scanbench.check.program import Expr, If, Pou, Program, Stmt
from scanbench.check.sites import Sites, sites_of
from scanbench.engines.native import walk
from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.emit_function import UNLIKELY
from scanbench.engines.native.flavour import Flavour
from scanbench.engines.probe import BadProbe, Probe

SLOTS = "@probes"
"""An i64 for each probe: the last scan that reached it, or `NEVER`."""
NEVER = -1
SILENT = "@probes.silent"
"""u8: what runs is not the user's program. Looked at only in POUs that it runs too."""
TAG = "#probes"
"""Of accesses to these: no variable lies there."""


def status(number: int) -> int:
    """What code that this probe halts is left with; the numbers of traps are positive."""
    return -1 - number


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

    def may_select(self, body: Body, statement: If) -> bool:
        return not self._inside(statement)

    def _inside(self, statement: Stmt) -> bool:
        inner = [each for each_body in walk.bodies(statement) for each in each_body]
        return any(self.sites.number(each) in self._at or self._inside(each) for each in inner)

    @contextmanager
    def statement(self, body: Body, statement: Stmt) -> Iterator[None]:
        site = self.sites.number(statement)
        for number in self._at.get(site, ()) if site is not None else ():
            self._probe(body, number)
        yield

    def _probe(self, body: Body, number: int) -> None:
        self._refer(body.unit)
        text, probe = body.text, self._probes[number]
        on = text.name("on")
        if body.pou in self._doubtful:
            silent = text.op(f"load i8, ptr {SILENT}, align 1{body.module.tag(TAG)}")
            heard = text.name("heard")
            text.choose(text.op(f"icmp ne i8 {silent}, 0"), on, heard)
            text.begin(heard)
        if probe.condition is not None:
            holds, reached = _value(body, probe.condition, on), text.name("reached")
            text.choose(holds, reached, on, UNLIKELY)
            text.begin(reached)
        scan = text.address(body.image, Layout.SCAN)
        now = text.op(f"load i64, ptr {scan}, align 8{body.module.tag('#scan')}")
        slot = f"getelementptr (i8, ptr {SLOTS}, i64 {8 * number})"
        text.do(f"store i64 {now}, ptr {slot}, align 8{body.module.tag(TAG)}")
        text.go(text.fail(str(status(number))) if probe.halt else on)
        text.begin(on)

    def _refer(self, unit: Unit) -> None:
        unit.module.refer(SLOTS, "external global [0 x i64], align 8")
        unit.module.refer(SILENT, "external global i8, align 1")


def _value(body: Body, condition: Expr, trapped: str) -> str:
    """The condition's value; where it traps the code goes on at a block."""
    # its places may name the same bytes otherwise than the program does
    with body.text.trapping_to(trapped), body.module.any_variable():
        value = body.scalar(condition).ssa
    body.text.end_statement()
    return value


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
