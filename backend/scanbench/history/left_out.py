"""What a comparison of two runs leaves out: variables that only one program has, or has otherwise."""

from collections.abc import Iterable, Iterator

from scanbench.history.changes import Moment
from scanbench.history.contract import NotCompared
from scanbench.program.program import Program
from scanbench.program.types import ArrayType, Record, Reference, Section, Type
from scanbench.runtime.migrate_image import NEW, REMOVED, changes


class LeftOut:
    """Collects it over all pairs of programs that were compared; each path is told once, with the first reason."""

    def __init__(self) -> None:
        self._found: dict[tuple[str, str], NotCompared] = {}
        self.variables: int | None = None
        """Variables that both programs have, an array of plain values counts as one; the fewest of all pairs. None: one
        program ran in both."""
        self.nothing = True
        """No pair of programs had a variable in common."""

    def add(self, one: Moment, other: Moment) -> None:
        """One pair of programs that is compared."""
        intervals = one.program.interval_ns, other.program.interval_ns
        if intervals[0] != intervals[1]:
            here, there = (f"{each / 1e6:.10g}" for each in intervals)
            self._add("", f"a scan lasts {here} ms in A and {there} ms in B")
        if one.program is other.program:
            self.nothing = False
            return
        change = changes(one.program, other.program)
        for each in change.lost:
            self._add(each.path, _reason(each.reason))
        if one.same_layout(other):  # every byte is compared, whatever it is called
            self.nothing = False
            return
        pointers = list(_pointers(one.program))
        kept = max(0, change.kept - len(pointers))
        lost = {each.path for each in change.lost}
        for path in pointers:
            if not any(path == each or path.startswith((f"{each}.", f"{each}[")) for each in lost):
                self._add(path, "where it points is not compared between different programs")
        self.variables = kept if self.variables is None else min(kept, self.variables)
        self.nothing = self.nothing and kept == 0

    def lose(self, lost: Iterable[str]) -> None:
        """Stretches of which one of the files lost what was entered, in words."""
        for each in lost:
            self._found.setdefault(("", each), NotCompared("", each[:1].lower() + each[1:]))

    def found(self) -> tuple[NotCompared, ...]:
        """All of it, in the order in which it was found."""
        return tuple(self._found.values())

    def _add(self, path: str, reason: str) -> None:
        self._found.setdefault((path, ""), NotCompared(path, reason))


def _reason(reason: str) -> str:
    if reason == NEW:
        return "only in B"
    return "only in A" if reason == REMOVED else f"different in A and B ({reason})"


def _pointers(program: Program) -> Iterator[str]:
    """References and pointers of a program: they count bytes in its own memory. `[*]` is every element of an array."""
    if program.layout.globals is not None:
        yield from _inside("", program.layout.globals)
    for instance in program.instances:
        yield from _inside(instance.name, instance.pou.instance)


def _inside(path: str, type: Type) -> Iterator[str]:
    if isinstance(type, Reference):
        yield path
    elif isinstance(type, ArrayType):
        yield from _inside(f"{path}[*]", type.element)
    elif isinstance(type, Record):
        for each in type.members.values():
            if each.storage and not each.hidden and each.section not in (Section.IN_OUT, Section.EXTERNAL):
                yield from _inside(f"{path}.{each.name}" if path else each.name, each.type)
