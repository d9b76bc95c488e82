"""What all parts of the checker share: problems met, sites of traps and subrange checks, near matches."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from functools import lru_cache
from heapq import nlargest
from itertools import pairwise
from operator import itemgetter
from typing import NamedTuple

from scanbench.check.uses import Symbol, Use
from scanbench.problems import Problem, Severity, Span, perhaps
from scanbench.program.program import Pou
from scanbench.program.sites import CallSite, CheckSite, TrapKind, TrapSite


class Rejected(Exception):
    """A construct was reported as wrong; whoever checks the next one catches it."""


Mark = tuple[int, int, int, int, int, int, int, int]
"""Lengths of the lists of a report."""

UNKNOWN = ("T001", "D002")
REPEATED = 3
"""How often a name that is not known is reported in one POU: it is one mistake, wherever the name is used."""

Told = dict[tuple[str, str], list[Problem]]
"""Errors by code and message."""


class Borrowed(NamedTuple):
    """Memory that the program may only read is passed to an in-out."""

    reader: Symbol
    """The in-out."""
    problem: Problem
    """What is wrong if anything writes to it."""


@dataclass(slots=True)
class Report:
    """Collects problems and sites of one check."""

    problems: list[Problem] = field(default_factory=list)
    traps: list[TrapSite] = field(default_factory=list)
    checks: list[CheckSite] = field(default_factory=list)
    calls: list[CallSite] = field(default_factory=list)
    uses: list[Use] = field(default_factory=list)
    """Which names mean what; some are told more than once."""
    written: list[Span] = field(default_factory=list)
    """Of the variables that are assigned, or that something else may write: spans end where those of their uses end."""
    lent: list[Span] = field(default_factory=list)
    """Of what is written, what may be read there, too: it is passed to an in-out, bound to a reference, or counted by a FOR."""
    borrowed: list[Borrowed] = field(default_factory=list)
    parts: dict[Pou, "Report"] = field(default_factory=dict)
    """What was met in the body of each POU; its sites are numbered from 1 there."""
    compared: int = 0
    """Names that unknown ones were compared with in this check, see `MOST_COMPARED`."""
    _told: Told = field(default_factory=dict)
    _near: dict[tuple[str, str], str] = field(default_factory=dict)
    """What was meant by a name, by its kind and itself: it is often wrong in many places."""

    @contextmanager
    def apart(self) -> Iterator["Report"]:
        """What is met meanwhile goes into a report of its own, for `parts`."""
        names = self.uses, self.written, self.lent, self.borrowed
        before, inner = (self.problems, self.traps, self.checks, self.calls), Report()
        self.problems, self.traps, self.checks, self.calls = inner.problems, inner.traps, inner.checks, inner.calls
        self.uses, self.written, self.lent, self.borrowed = inner.uses, inner.written, inner.lent, inner.borrowed
        known = self._told, self._near
        self._told, self._near = inner._told, inner._near
        try:
            yield inner
        finally:
            self.problems, self.traps, self.checks, self.calls = before
            self.uses, self.written, self.lent, self.borrowed = names
            self._told, self._near = known

    def add(self, part: "Report") -> None:
        """Takes over what was met apart, which has no sites."""
        self.problems += part.problems
        self.uses += part.uses
        self.written += part.written
        self.lent += part.lent
        self.borrowed += part.borrowed

    def join(self, order: Iterable[Pou]) -> None:
        """Takes over the parts of these POUs, whose sites then count from the end of what is there."""
        told = set(self.problems)
        for pou in order:
            part = self.parts.get(pou)
            if part is not None:
                pou.first_trap, pou.first_check, pou.first_call = len(self.traps), len(self.checks), len(self.calls)
                self.problems += [problem for problem in part.problems if problem not in told]
                told.update(part.problems)
                self.traps += part.traps
                self.checks += part.checks
                self.calls += part.calls

    def error(self, code: str, message: str, span: Span) -> None:
        problem = Problem(code, message, span)
        same = self._told.setdefault((code, problem.message), [])
        if problem not in same and (code not in UNKNOWN or len(same) < REPEATED):
            same.append(problem)
            self.problems.append(problem)

    def warn(self, code: str, message: str, span: Span) -> None:
        self.problems.append(Problem(code, message, span, Severity.WARNING))

    def reject(self, code: str, message: str, span: Span) -> Rejected:
        """Reports, and gives what to raise."""
        self.error(code, message, span)
        return Rejected()

    def trap(self, kind: TrapKind, span: Span, pou: str, message: str) -> int:
        """The number of a new trap site: its index plus one."""
        self.traps.append(TrapSite(kind, span, pou, message))
        return len(self.traps)

    def check(self, site: CheckSite) -> int:
        """The number of a new subrange check: its index plus one."""
        self.checks.append(site)
        return len(self.checks)

    def call(self, site: CallSite) -> int:
        """The number of a new call: its index plus one."""
        self.calls.append(site)
        return len(self.calls)

    def use(self, span: Span, name: str, symbol: Symbol) -> None:
        """Notes what a name means; `span` ends in the name, of which only the part after the last point counts."""
        self.uses.append(Use(span, len(name) - name.rfind(".") - 1, symbol))

    def mark(self) -> Mark:
        """Where the lists end now, for `undo`."""
        found = len(self.problems), len(self.traps), len(self.checks), len(self.calls)
        return *found, len(self.uses), len(self.written), len(self.lent), len(self.borrowed)

    def undo(self, mark: Mark) -> None:
        """Forgets what was reported since, before the same is checked once more."""
        problems, traps, checks, calls, uses, written, lent, borrowed = mark
        for each in self.problems[problems:]:
            same = self._told.get((each.code, each.message), [])
            if each in same:
                same.remove(each)
        del self.problems[problems:], self.traps[traps:], self.checks[checks:], self.calls[calls:]
        del self.uses[uses:], self.written[written:], self.lent[lent:], self.borrowed[borrowed:]

    def needless(self, number: int, why: str) -> None:
        """What was to be checked there needs no check."""
        self.checks[number - 1] = replace(self.checks[number - 1], needless=why)

    def near(self, name: str, known: Callable[[], Iterable[str]], kind: str = "") -> str:
        """` Did you mean ...?` or nothing. `kind` says what the name would be, so that the answer is found once in a POU.

        Only the first unknown names of a check are compared with others: nobody reads thousands of answers.
        """
        key = (kind, name.upper())
        if key not in self._near and self.compared < MOST_COMPARED:
            names = tuple(known())
            self.compared += len(names) + LETTERS
            self._near[key] = did_you_mean(name, names)
        return self._near.get(key, "")


MOST_COMPARED = 60_000
"""Names that the unknown ones of a check are compared with in all: about 50 ms."""
COMPARED = 12
"""Names that are compared letter by letter with one that is not known: those that share the most pairs of letters with it."""
LETTERS = 200
"""What that costs, counted in names that are compared by their pairs."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """` Did you mean ...?` or nothing."""
    by_upper = {item.upper(): item for item in known}
    likely = list(by_upper)
    if len(likely) > COMPARED:
        wanted, length = _pairs(name.upper()), len(name)
        scores = [((wanted & _pairs(item)).bit_count() / (len(item) + length), item) for item in likely]
        likely = [item for _, item in nlargest(COMPARED, scores, key=itemgetter(0))]
    near = get_close_matches(name.upper(), likely, n=2, cutoff=0.6)
    return perhaps(by_upper[item] for item in near)


@lru_cache(1 << 15)
def _pairs(name: str) -> int:
    """The letters that follow each other, its first and its last one too, as bits: a name of one letter has pairs as well.

    Kept by name, as each POU knows others, but most of them are those that every POU knows.
    """
    codes = f" {name} ".encode("utf-32-le")[::4]
    bits = 0
    for first, second in pairwise(codes):
        bits |= 1 << (first * 37 + second) % 1021
    return bits
