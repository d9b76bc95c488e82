"""Which statements of a program can read error memory: used for those that a run did not reach.

Reads of a block or function through an in-out are found; reads through a reference are not.
"""

from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass

from scanbench.faults.reaction.alike import representatives
from scanbench.faults.reaction.deciding import Instances
from scanbench.faults.reaction.error_memory import Watched
from scanbench.faults.reaction.places import heads, parts, ref_of
from scanbench.faults.reaction.reaction import Obstacle, Unreached
from scanbench.program.bodies import bodies
from scanbench.program.copies import makes_copies
from scanbench.program.program import Base, CallBlock, CallFunction, Place, Pou, Program, Stmt
from scanbench.program.tasks import Task
from scanbench.program.types import ULINT
from scanbench.symbols.sites import Sites, sites_of

_BYTES = 1 << 16
"""Of a place with computed indices so many are looked at."""


@dataclass(frozen=True, slots=True)
class Reading:
    """A statement that reads something, and on which instances it runs."""

    site: int
    file: str
    line: int
    paths: tuple[str, ...]
    pou: Pou | None
    """None: in a CONFIGURATION."""


class Readings:
    """The places that the statements of one program read."""

    def __init__(self, program: Program, instances: Instances) -> None:
        self._sites: Sites = sites_of(program)
        self._paths: dict[Pou, tuple[str, ...]] = {}
        self._around: dict[int, int | None] = {}
        """By statement the one around it."""
        self.statements: dict[int, Stmt] = {}
        """By their numbers."""
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
        self._alike = representatives(self.statements)

    def only_in(self, reached: Set[int], other: Set[int]) -> list[int]:
        """The statements that ran in one run, and neither they nor ones that do the same in a different branch in the other."""
        there = {self._alike.get(each, each) for each in other}
        return sorted(
            each for each in reached - other if each in self.statements and self._alike.get(each, each) not in there
        )

    def of(self, watched: Watched) -> list[Reading]:
        """The statements that read any of these bits, in the order of their lines."""
        found: dict[int, Pou | None] = {site: pou for site, pou, place in self._direct if _looks_at(place, watched)}
        for each in self._slots(watched):
            for site in self._through.get(each, ()):
                found[site] = each[0]
        return [self._reading(site, pou) for site, pou in sorted(found.items(), key=lambda each: each[0])]

    def _slots(self, watched: Watched) -> set[tuple[Pou, Place]]:
        """The in-outs that may refer to these bits."""
        slots: set[tuple[Pou, Place]] = set()
        grown = True
        while grown:
            before = len(slots)
            for caller, callee, slot, actual in self._given:
                passed = actual.slot is not None and caller is not None and (caller, actual.slot) in slots
                if passed or _looks_at(actual, watched):
                    slots.add((callee, slot))
            grown = len(slots) > before
        return slots

    def reads(self, bits: Mapping[int, int]) -> frozenset[tuple[int, int, int, int]]:
        """The places that read any of these bits (masks by byte), as (statement, first byte, end, mask)."""
        if not bits:
            return frozenset()
        watched = Watched({}, {}, dict(bits), {})
        slots = self._slots(watched)
        found = {
            (site, *ref_of(place)[1:]) for site, _, place in self._direct if _looks_at(place, watched)
        }  # fmt: skip
        found |= {(site, slot.offset, 0, 0) for pou, slot in slots for site in self._through.get((pou, slot), ())}
        return frozenset(found)

    def any_in(self, begin: int, end: int) -> bool:
        """Whether any of these bytes is read or given to an in-out."""
        places = (*(place for _, _, place in self._direct), *(actual for _, _, _, actual in self._given))
        refs = (ref_of(place) for place in places if place.slot is None and place.base is Base.IMAGE)
        return any(ref.base is Base.IMAGE and ref.begin < end and begin < ref.end for ref in refs)

    def place(self, number: int) -> str:
        """`file:line` of a statement."""
        span = self._sites.statements[number].span
        return f"{span.file}:{span.line}"

    def missed(self, reading: Reading, reached: Set[int], idle: Iterable[Task]) -> Unreached:
        """Why a statement was not executed, of which so many were; `idle`: tasks that had no turn."""
        why, at = self._obstacle(reading, reached, idle)
        return Unreached(reading.file, reading.line, reading.paths, why, at)

    def _obstacle(self, reading: Reading, reached: Set[int], idle: Iterable[Task]) -> tuple[Obstacle, str]:
        if reading.site in reached:  # a part of it that comes before has decided: ELSIF, OR_ELSE
            return "condition", self.place(reading.site)
        around = self._around.get(reading.site)
        while around is not None:
            if around in reached:
                return "condition", self.place(around)
            around = self._around[around]
        if reading.pou is None:
            return "body", ""
        if not reached.isdisjoint(self._sites.bodies.get(reading.pou, ())):
            return "left", ""
        for task in idle:
            if any(each.pou is reading.pou for each in task.programs):
                return "task", task.name
        return "body", ""

    def _reading(self, number: int, pou: Pou | None) -> Reading:
        site = self._sites.statements[number]
        paths = self._paths[pou] if pou is not None else (site.pou,)
        return Reading(number, site.span.file, site.span.line, paths, pou)

    def _nested(self, body: Iterable[Stmt], around: int | None) -> Iterator[Stmt]:
        for stmt in body:
            number = self._sites.number(stmt)
            if number is not None:
                self._around[number], self.statements[number] = around, stmt
            yield stmt
            for inner in bodies(stmt):
                yield from self._nested(inner, around if number is None else number)

    def _take(self, pou: Pou | None, body: Iterable[Stmt]) -> None:
        for stmt in self._nested(body, None):
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
