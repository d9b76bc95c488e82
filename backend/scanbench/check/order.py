"""Callees before callers. Recursion is refused, as every POU has one frame, but for what `recursion.py` allows."""

from collections.abc import Iterable

from scanbench.check.context import Report
from scanbench.check.declare.scopes import Pous
from scanbench.program.program import Pou

MAX_CALLS = 1_000_000
"""Calls that one call may lead to, loops not counted: those have a budget at run time, plain calls have none."""


class Order:
    """Walks who calls whom, from everything that the user declared."""

    def __init__(self, report: Report, pous: Pous) -> None:
        self.report = report
        self.uses = pous.uses
        self.found: list[Pou] = []
        self._state: dict[Pou, int] = {}
        self._calls: dict[Pou, int] = {}
        self._path: list[Pou] = []

    def of(self, roots: Iterable[Pou]) -> list[Pou]:
        """All that these call, and they themselves; a POU that calls itself, by whatever way, is reported."""
        for pou in roots:
            self._visit(pou)
        return self.found

    def _visit(self, pou: Pou) -> None:
        if self._state.get(pou) == 2:
            return
        if self._state.get(pou) == 1:
            if pou.recursive:
                return
            names = " -> ".join(each.name for each in [*self._path[self._path.index(pou) :], pou])
            self.report.error("D009", f"Recursion is not allowed: {names}.", pou.span)
            return
        self._state[pou] = 1
        self._path.append(pou)
        for callee in self.uses.get(pou, {}):
            self._visit(callee)
        self._path.pop()
        self._state[pou] = 2
        self.found.append(pou)
        self._count(pou)

    def _count(self, pou: Pou) -> None:
        called = self.uses.get(pou, {}).items()
        calls = 1 + sum(self._calls.get(callee, 0) * places for callee, places in called)
        if calls > MAX_CALLS:
            self.report.error(
                "D013", f"One call of `{pou.name}` leads to {calls} calls; at most {MAX_CALLS}.", pou.span
            )
            calls = 0
        self._calls[pou] = calls
