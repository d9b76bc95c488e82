"""Probed code: a test where chosen statements begin; see `engines.probe`. All other statements are as in the run flavour."""

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext

from scanbench.engines.native import walk
from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.emit_function import UNLIKELY
from scanbench.engines.native.flavour import Flavour
from scanbench.engines.native.speculate import harmless
from scanbench.engines.probe import BadProbe, Probe
from scanbench.program.bodies import bodies
from scanbench.program.layout import Layout
from scanbench.program.program import Expr, If, Pou, Program, Stmt
from scanbench.symbols.sites import Sites, sites_of

SLOTS = "@probes"
"""An i64 for each probe: the last scan that reached it, or `NEVER`."""
NEVER = -1
HITS = "@probes.hits"
"""u8 for each probe: reached in this scan. Eight at a time are looked at when the scan is done."""
SILENT = "@probes.silent"
"""u8: what runs is not the user's program. Looked at only in POUs that it runs too."""
TAG = "#probes"
"""Of accesses to these: no variable lies there."""


HALTED = -1
"""The status of a scan in which a probe that halts was reached; the numbers of traps are positive. The scan is run to its end
before: nobody can tell, as the image is of no use, and leaving at once would keep loops from being optimised."""

COLLECT = """\
@probes.halts = internal constant [{count} x i8] c"{halts}"
define internal i1 @probes.collect(i64 %scan) noinline cold #0 {{
; notes the scan in which probes were reached; whether one of them halts
entry:
  br label %next
next:
  %i = phi i64 [ 0, %entry ], [ %after, %on ]
  %halt = phi i8 [ 0, %entry ], [ %now, %on ]
  %more = icmp ult i64 %i, {count}
  br i1 %more, label %look, label %done
look:
  %hitat = getelementptr inbounds i8, ptr {hits}, i64 %i
  %hit = load i8, ptr %hitat, align 1
  %haltsat = getelementptr inbounds i8, ptr @probes.halts, i64 %i
  %halts = load i8, ptr %haltsat, align 1
  %both = and i8 %hit, %halts
  %now = or i8 %halt, %both
  %reached = icmp ne i8 %hit, 0
  br i1 %reached, label %note, label %on
note:
  store i8 0, ptr %hitat, align 1
  %slotat = getelementptr inbounds i64, ptr {slots}, i64 %i
  store i64 %scan, ptr %slotat, align 8
  br label %on
on:
  %after = add i64 %i, 1
  br label %next
done:
  %any = icmp ne i8 %halt, 0
  ret i1 %any
}}"""


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
        unit.module.define(HITS, f"global [{_padded(len(self._probes))} x i8] zeroinitializer, align 8")
        unit.module.define(SILENT, "global i8 0, align 1")

    # ---- the code ---------------------------------------------------------------------------------------------

    def silence(self, body: Body, silent: bool) -> None:
        if self._doubtful:
            self._refer(body.unit)
            body.text.do(f"store i8 {int(silent)}, ptr {SILENT}, align 1{body.module.tag(TAG)}")

    def done(self, body: Body) -> None:
        text, tag, found = body.text, body.module.tag(TAG), "0"
        self._refer(body.unit)
        for start in range(0, _padded(len(self._probes)), 8):
            eight = text.op(f"load i64, ptr {_hit(start)}, align 8{tag}")
            found = text.op(f"or i64 {found}, {eight}")
        reached, on = text.name("reached"), text.name("on")
        text.choose(text.op(f"icmp ne i64 {found}, 0"), reached, on, UNLIKELY)
        text.begin(reached)
        halts = "".join(f"\\{int(probe.halt):02X}" for probe in self._probes)
        body.module.declare(
            "@probes.collect", COLLECT.format(hits=HITS, slots=SLOTS, count=len(self._probes), halts=halts)
        )
        scan = text.op(f"load i64, ptr {text.address(body.image, Layout.SCAN)}, align 8{body.module.tag('#scan')}")
        text.choose(text.op(f"call i1 @probes.collect(i64 {scan})"), text.fail(str(HALTED)), on)
        text.begin(on)

    def may_select(self, body: Body, statement: If) -> bool:
        return all(harmless(body, each) for each in self._conditions(statement))

    def _conditions(self, statement: Stmt) -> Iterator[Expr]:
        """Of the probes inside of a statement."""
        for inner in (each for each_body in bodies(statement) for each in each_body):
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
        for name in (SLOTS, HITS):
            unit.module.refer(name, "external global [0 x i64], align 8")
        unit.module.refer(SILENT, "external global i8, align 1")


def _note(body: Body, number: int, holds: str) -> None:
    text, tag, hit = body.text, body.module.tag(TAG), "1"
    if holds != "true":
        before = text.op(f"load i8, ptr {_hit(number)}, align 1{tag}")
        hit = text.op(f"or i8 {before}, {text.op(f'zext i1 {holds} to i8')}")
    text.do(f"store i8 {hit}, ptr {_hit(number)}, align 1{tag}")


def _hit(number: int) -> str:
    return f"getelementptr (i8, ptr {HITS}, i64 {number})"


def _padded(count: int) -> int:
    return -(-count // 8) * 8


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
