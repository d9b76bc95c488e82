"""Where the code of a body keeps what flows: the power after each element, and what the wires of a diagram have.

The checker keeps both in hidden variables (`check.body.network_code`, `ladder`, `diagram`, `chart`); which statement of the text they belong to
follows from the places of the statements, as for `symbols.sites`.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from scanbench.problems import Span
from scanbench.program.bodies import bodies
from scanbench.program.program import Assign, Base, Blocks, CallBlock, If, Place, Pou, Program, Stmt
from scanbench.program.types import Elementary, Record, StringType
from scanbench.symbols.sites import Sites

_KEPT = re.compile(r"\.\$(POWER\d+|PIN\d+|OK\d+|HERE\..+)$")
_WIRE = "#"


@dataclass(frozen=True, slots=True)
class Bit:
    """A BOOL of the compiler's own, in the frame of the body."""

    offset: int
    inverted: bool = False


@dataclass(frozen=True, slots=True)
class Wire:
    """A wire of a function block diagram, `#low`. Other networks may have one of this name, too."""

    name: str
    line: int
    type: Elementary | StringType
    base: Base
    offset: int


@dataclass(slots=True)
class FlowSites:
    """Of one body."""

    pou: Pou
    sites: frozenset[int]
    first: int
    """The statement with which a call begins, where `entries` has no others."""
    entries: frozenset[int]
    """One of these begins first in every call."""
    power: dict[int, Bit] = field(default_factory=dict)
    """Where the power is kept that comes out of the element at a site."""
    written: dict[int, tuple[Place, ...]] = field(default_factory=dict)
    """The variables that an element gives a value, or would: coils, results, what the outputs of a called block are copied to."""
    wires: tuple[Wire, ...] = ()


_MADE: list[tuple[Sites, str, list[FlowSites]]] = []
_KEPT_LAST = 8


def flow_sites(program: Program, sites: Sites, name: str) -> list[FlowSites]:
    """The bodies that are drawn as the text of this POU: its own, and those of its actions. Empty where there is none of this name.

    The same, again and again, as long as few other ones are asked about: a drawing asks twenty times a second.
    """
    wanted = name.upper()
    for known, which, made in _MADE:
        if known is sites and which == wanted:
            return made
    found = []
    for pou, own in sites.bodies.items():
        action = pou.name.upper().startswith(f"{wanted}.") and pou.span.file == _file_of(program, wanted)
        if pou.name.upper() == wanted or action:
            found.append(_of_body(pou, sites, own))
    _MADE.append((sites, wanted, found))
    del _MADE[:-_KEPT_LAST]
    return found


def _file_of(program: Program, name: str) -> str:
    return next((pou.span.file for pou in program.pous if pou.name.upper() == name), "")


def _of_body(pou: Pou, sites: Sites, own: tuple[int, ...]) -> FlowSites:
    begins = sites.number(_first(pou.body))
    entries = frozenset(own) if begins is None else frozenset((begins,))
    found = FlowSites(pou, frozenset(own), own[0], entries, wires=tuple(_wires(pou)))
    for site, owner, statement in _by_site(pou.body, sites):
        here = _begin(statement.span.plain()) == _begin(sites.statements[site].span)
        bit = _bit(statement) if isinstance(statement, Assign) else None
        if bit is not None and (isinstance(owner, If) if bit.inverted else here):
            found.power[site] = bit
        elif here:
            found.written[site] = (*found.written.get(site, ()), *filter(_is_steady, _targets(statement)))
    return found


def _first(body: Sequence[Stmt]) -> Stmt:
    first = body[0]
    return _first(first.blocks[0]) if isinstance(first, Blocks) and first.blocks[0] else first


def _targets(statement: Stmt) -> tuple[Place, ...]:
    if isinstance(statement, Assign):
        return (statement.target,)
    return tuple(place for _, place in statement.outputs) if isinstance(statement, CallBlock) else ()


def _is_steady(place: Place) -> bool:
    """Whether it is at the same place of its base, or of what an in-out refers to, as long as the call is under way. What the
    compiler keeps for itself is left out."""
    slot = place.slot
    steady = (
        not place.indices and place.reference is None and (slot is None or (slot.slot is None and not slot.indices))
    )
    return steady and "$" not in place.variable


def _bit(statement: Assign) -> Bit | None:
    target = statement.target
    kept = _KEPT.search(target.variable) if target.base is Base.FRAME and target.slot is None else None
    return None if kept is None else Bit(target.offset, kept.group(1).startswith("HERE."))


def _begin(span: Span) -> tuple[int, int]:
    return span.line, span.column


def _by_site(body: Iterable[Stmt], sites: Sites) -> Iterator[tuple[int, Stmt, Stmt]]:
    """All statements of a body, each with the site that it is a part of, and the statement there: itself, or one before it."""
    site, owner = -1, None
    ahead = list(body)[::-1]
    while ahead:
        statement = ahead.pop()
        number = sites.number(statement)
        if number is not None:
            site, owner = number, statement
        if owner is not None:
            yield site, owner, statement
        for inner in reversed(list(bodies(statement))):
            ahead += list(inner)[::-1]


def _wires(pou: Pou) -> Iterator[Wire]:
    records: tuple[tuple[Record, Base], ...] = (pou.frame, Base.FRAME), (pou.instance, Base.SELF)
    for record, base in records:
        for name, member in record.members.items():
            if name.startswith(_WIRE) and isinstance(member.type, Elementary | StringType):
                yield Wire(name.partition("/")[0], member.span.line, member.type, base, member.offset)
