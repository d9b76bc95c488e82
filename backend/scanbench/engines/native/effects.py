"""What a POU may write, itself or through what it calls; so which variables stay as they are during a loop."""

from collections.abc import Iterable

from scanbench.engines.native import walk
from scanbench.engines.native.emit_types import has_members
from scanbench.program.program import Place, Pou, Stmt

ANY = ""
"""Means every variable: for a write through a reference, or of a whole structure."""


class Effects:
    """Summaries of the POUs of one program, made once each."""

    def __init__(self, known: dict[Pou, frozenset[str]] | None = None) -> None:
        """`known` are summaries that were made before, and hold still."""
        self._written: dict[Pou, frozenset[str]] = {} if known is None else known

    def written_by(self, pou: Pou) -> frozenset[str]:
        """Names of the variables that a run of the POU may write."""
        known = self._written.get(pou)
        if known is None:
            known = self._written[pou] = self._around(pou) if pou.recursive else self.written(pou.body)
        return known

    def _around(self, pou: Pou) -> frozenset[str]:
        """Of a POU that may lead to itself: all that is written by what it leads to."""
        names, found, open_ = set[str](), {pou}, [pou]
        while open_:
            own, callees = touched(open_.pop().body)
            names |= own
            for callee in callees:
                if callee.recursive and callee not in found:
                    found.add(callee)
                    open_.append(callee)
                elif not callee.recursive:
                    names |= self.written_by(callee)
        return frozenset(names)

    def written(self, statements: Iterable[Stmt]) -> frozenset[str]:
        """Names of the variables that these statements may write."""
        names, callees = touched(statements)
        return frozenset(names.union(*(self.written_by(callee) for callee in callees)))


def touched(statements: Iterable[Stmt]) -> tuple[set[str], list[Pou]]:
    """Names of the variables that these statements write themselves, and whom they call."""
    names: set[str] = set()
    callees: dict[Pou, None] = {}
    for seen in walk.of_statements(statements):
        if isinstance(seen, Pou):
            callees[seen] = None
        elif seen[1] in (walk.Use.WRITE, walk.Use.REFERENCE):
            names.add(_name(seen[0]))
    return names, list(callees)


def _name(place: Place) -> str:
    return ANY if has_members(place.type) else place.variable


def plain(place: Place) -> bool:
    """Whether the place has a fixed offset and consists of whole bytes."""
    return place.slot is None and place.reference is None and not place.indices and place.bit is None


def keeps(written: frozenset[str], place: Place) -> bool:
    """Whether a plain variable is certainly untouched by code that writes these."""
    name = place.variable
    return plain(place) and name != ANY and not name.startswith("@") and name not in written and ANY not in written
