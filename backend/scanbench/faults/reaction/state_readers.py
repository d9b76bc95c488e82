"""Which statements of a program read a variable, wherever it is: for state that decides something later.

Reads of a method, block or function through an in-out are found (`THIS` is one); reads through a reference are not.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from scanbench.faults.reaction.deciding import Instances
from scanbench.faults.reaction.places import Ref, heads, inside, parts, ref_of
from scanbench.program.bodies import every
from scanbench.program.program import Base, CallBlock, CallFunction, Place, Pou, Program, Stmt
from scanbench.program.types import Record
from scanbench.symbols.sites import Sites, sites_of

Slot = tuple[Pou | None, Base, int]
"""An in-out of a POU: where its reference is kept."""
_MOST = 10_000
"""So many places are followed for one in-out."""


class StateReaders:
    """The places that each body reads, with the statements that do."""

    def __init__(self, program: Program, instances: Instances) -> None:
        self._sites: Sites = sites_of(program)
        self._instances = instances
        self._in_image: list[tuple[Ref, int]] = []
        self._in_self: dict[str, list[tuple[Ref, int]]] = {}
        """By the name of the block or program."""
        self._through: dict[Slot, list[tuple[Ref, int]]] = {}
        """Places that count from what an in-out refers to."""
        self._given: list[tuple[Pou | None, Slot, Place]] = []
        """Caller, in-out of what it calls, and what it gives."""
        for pou in program.tasked:
            self._take(pou, pou.body)
        for task in program.tasks:
            for each in task.programs:
                self._take(None, (*each.before, *each.after))
        self._begins = self._followed()

    def of(self, begin: int, end: int) -> tuple[str, ...]:
        """`file:line` of the statements that read any of these bytes of the image, in the order of their lines."""
        found = {site for ref, site in self._in_image if ref.begin < end and begin < ref.end}
        for each in self._instances.around(begin, end):
            record: Record | None = each.record
            while record is not None:
                for ref, site in self._in_self.get(record.name, ()):
                    if each.begin + ref.begin < end and begin < each.begin + ref.end:
                        found.add(site)
                record = record.base
        for slot, begins in self._begins.items():
            for ref, site in self._through.get(slot, ()):
                if any(start + ref.begin < end and begin < start + ref.end for start in begins):
                    found.add(site)
        spans = [self._sites.statements[site].span for site in sorted(found)]
        return tuple(dict.fromkeys(f"{span.file}:{span.line}" for span in spans))

    def _followed(self) -> dict[Slot, set[int]]:
        """Where in the image that may begin which an in-out refers to."""
        begins: dict[Slot, set[int]] = {}
        grown = True
        while grown:
            grown = False
            for pou, slot, actual in self._given:
                known = begins.setdefault(slot, set())
                fresh = set(self._starts(pou, actual, begins)) - known if len(known) < _MOST else set()
                known |= fresh
                grown = grown or bool(fresh)
        return begins

    def _starts(self, pou: Pou | None, place: Place, begins: dict[Slot, set[int]]) -> Iterator[int]:
        if place.reference is not None:
            return
        if place.slot is not None:
            yield from (each + place.offset for each in begins.get(_slot(pou, place.slot), ()))
        elif place.base is Base.IMAGE:
            yield place.offset
        elif place.base is Base.SELF and pou is not None:
            yield from (each.begin + place.offset for each in self._instances.of.get(pou.instance.name, ()))

    def _take(self, pou: Pou | None, body: Iterable[Stmt]) -> None:
        for stmt in every(body):
            number = self._sites.number(stmt)
            self._given += ((pou, slot, actual) for slot, actual in _given(stmt))
            for place, ref in _read(stmt) if number is not None else ():
                assert number is not None
                if place.slot is not None:
                    reach = ref_of(replace(place, slot=None))
                    self._through.setdefault(_slot(pou, place.slot), []).append((reach, number))
                elif ref.base is Base.IMAGE:
                    self._in_image.append((ref, number))
                elif ref.base is Base.SELF and pou is not None:
                    self._in_self.setdefault(pou.instance.name, []).append((ref, number))


def _slot(pou: Pou | None, slot: Place) -> Slot:
    return pou, slot.base, slot.offset


def _given(stmt: Stmt) -> Iterator[tuple[Slot, Place]]:
    """The in-outs that a statement binds, and what it gives them."""
    if isinstance(stmt, CallBlock):
        yield from ((_slot(stmt.pou, slot), actual) for slot, actual in stmt.in_outs)
    for node in parts(heads(stmt)):
        if isinstance(node, CallFunction):
            for name, given in zip(node.pou.parameters, node.args, strict=False):
                member = node.pou.frame.members[name]
                if isinstance(given, Place) and member.bound:
                    yield (node.pou, Base.FRAME, member.offset), given


def _read(stmt: Stmt) -> Iterator[tuple[Place, Ref]]:
    bound = {id(given) for _, given in _given(stmt)}  # what is called reads it, not who calls
    for node in parts(heads(stmt)):
        if isinstance(node, Place) and id(node) not in bound:
            yield node, ref_of(node)
    if isinstance(stmt, CallBlock):
        for value, _ in stmt.outputs:
            for node in parts(value):
                if isinstance(node, Place):
                    yield node, inside(stmt.instance, ref_of(node))
