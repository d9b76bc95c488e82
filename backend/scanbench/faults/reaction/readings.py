"""Which statements of a program can read error memory: used for those that a run did not reach.

Reads of a block or function through an in-out are found; reads through a reference are not.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from scanbench.faults.reaction.deciding import Instances
from scanbench.faults.reaction.error_memory import Watched
from scanbench.faults.reaction.flows import heads, parts, ref_of
from scanbench.program.bodies import every
from scanbench.program.copies import makes_copies
from scanbench.program.program import Base, CallBlock, CallFunction, Place, Pou, Program, Stmt
from scanbench.program.types import ULINT
from scanbench.symbols.sites import Sites, sites_of

_PATHS = 3
_BYTES = 1 << 16
"""Of a place with computed indices so many are looked at."""


@dataclass(frozen=True, slots=True)
class Reading:
    """A statement that reads something, and on which instances it runs."""

    site: int
    file: str
    line: int
    paths: tuple[str, ...]

    def __str__(self) -> str:
        more = len(self.paths) - _PATHS
        named = ", ".join(self.paths[:_PATHS]) + (f" and {more} more" if more > 0 else "")
        return f"{self.file}:{self.line} ({named})"


class Readings:
    """The places that the statements of one program read."""

    def __init__(self, program: Program, instances: Instances) -> None:
        self._sites: Sites = sites_of(program)
        self._paths: dict[Pou, tuple[str, ...]] = {}
        self._direct: list[tuple[int, Pou | None, Place]] = []
        """In an area of the model."""
        self._through: dict[tuple[Pou, Place], list[int]] = {}
        """Sites that read through an in-out of a POU."""
        self._given: list[tuple[Pou | None, Pou, Place, Place]] = []
        """Caller, callee, its in-out, and what it is given."""
        for pou in program.tasked:
            named = tuple(each.path for each in instances.of.get(pou.instance.name, ()))
            self._paths[pou] = named if pou.kind != "function" and named else (pou.name,)
            self._take(pou, pou.body)
        for task in program.tasks:
            for each in task.programs:
                self._take(None, (*each.before, *each.after))

    def of(self, watched: Watched) -> list[Reading]:
        """The statements that read any of these bits, in the order of their lines."""
        found: dict[int, Pou | None] = {site: pou for site, pou, place in self._direct if _looks_at(place, watched)}
        slots: set[tuple[Pou, Place]] = set()
        grown = True
        while grown:
            before = len(slots)
            for caller, callee, slot, actual in self._given:
                passed = actual.slot is not None and caller is not None and (caller, actual.slot) in slots
                if passed or _looks_at(actual, watched):
                    slots.add((callee, slot))
            grown = len(slots) > before
        for each in slots:
            for site in self._through.get(each, ()):
                found[site] = each[0]
        return [self._reading(site, pou) for site, pou in sorted(found.items(), key=lambda each: each[0])]

    def _reading(self, number: int, pou: Pou | None) -> Reading:
        site = self._sites.statements[number]
        return Reading(number, site.span.file, site.span.line, self._paths[pou] if pou is not None else (site.pou,))

    def _take(self, pou: Pou | None, body: Iterable[Stmt]) -> None:
        for stmt in every(body):
            number = self._sites.number(stmt)
            passed: set[int] = set()
            for node in parts(heads(stmt)):
                if isinstance(node, CallFunction):
                    passed |= {id(given) for given in node.args}  # the function reads it, not who calls
                    for name, given in zip(node.pou.parameters, node.args, strict=False):
                        member = node.pou.frame.members[name]
                        if isinstance(given, Place) and member.bound:
                            slot = Place(ULINT, Base.FRAME, member.offset)
                            self._given.append((pou, node.pou, slot, _with_plain_slot(given)))
                elif isinstance(node, Place) and number is not None and id(node) not in passed:
                    self._read(number, pou, node)
            if isinstance(stmt, CallBlock):
                for slot, actual in stmt.in_outs:
                    self._given.append((pou, stmt.pou, _plain(slot), _with_plain_slot(actual)))
                    if makes_copies(stmt.pou.instance) and number is not None:
                        self._read(number, pou, actual)

    def _read(self, number: int, pou: Pou | None, place: Place) -> None:
        if place.slot is not None:
            if pou is not None:
                self._through.setdefault((pou, _plain(place.slot)), []).append(number)
        elif place.reference is None and place.base is Base.IMAGE:
            self._direct.append((number, pou, place))


def _plain(slot: Place) -> Place:
    """Where a slot is, and nothing else of it."""
    return Place(ULINT, slot.base, slot.offset)


def _with_plain_slot(place: Place) -> Place:
    return place if place.slot is None else Place(place.type, place.base, place.offset, slot=_plain(place.slot))


def _looks_at(place: Place, watched: Watched) -> bool:
    if place.slot is not None or place.reference is not None or place.base is not Base.IMAGE:
        return False
    ref = ref_of(place)
    return any(
        any(True for _ in watched.kinds(offset, ref.mask))
        for offset in range(ref.begin, min(ref.end, ref.begin + _BYTES))
    )
