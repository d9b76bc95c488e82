"""What a place of the image is called: the way back from bytes to names.

`at` has the single values in some bytes, as the statements of a POU see them where a pass runs inside of one; `variable` the
symbol that means a place again; `path` and `text` are for people; `instance` and `holding` are about blocks. Which variables
people count where two states differ is `kept.py`.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from scanbench.program.copies import Image, Spot, referred
from scanbench.program.layout import Layout
from scanbench.program.program import Pou, Program
from scanbench.program.types import BOOL, SLOT_BYTES, ArrayType, Elementary, Kind, Member, Record, Section, Type
from scanbench.symbols.descent import Descent, Part
from scanbench.symbols.header_names import system_field
from scanbench.symbols.instances import owner_of
from scanbench.symbols.leaves import WHOLE, Leaf, leaves
from scanbench.symbols.sites import Sites
from scanbench.symbols.symbols import RAW_TYPES, Symbol, UnknownPath, resolve

_GLOBAL = " (global)"
"""After the name of what the POU has a variable of its own for."""
_KEPT = 4
_MADE: "list[Names]" = []


@dataclass(frozen=True, slots=True)
class Inside:
    """Where a pass runs: what names depend on there."""

    pou: Pou | None
    """None: the whole scan."""
    instance: int = 0
    slots: tuple[int, ...] = ()
    """What its in-outs are bound to."""


ANYWHERE = Inside(None)


class Names:
    """Of one program. What was asked for once is known."""

    def __init__(self, program: Program, sites: Sites | None = None) -> None:
        """`sites`: only the temporaries of POUs that have any are named."""
        self.program = program
        self.descent = Descent(program)
        self._mine = None if sites is None else sites.bodies
        self._known: dict[Inside, dict[tuple[int, int, int], tuple[Leaf, ...]]] = {}

    # ---- single values --------------------------------------------------------------------------------------------

    def at(self, offset: int, size: int = 1, bits: int = WHOLE) -> tuple[Leaf, ...]:
        """What these bytes are, by paths and addresses; nothing for what the compiler keeps there. `bits`: of one byte."""
        if offset >= self.program.layout.frames:
            pou = self.descent.frame(offset)
            found = self._of_frame(pou, offset, size, bits) if pou is not None else ()
            return tuple(each._replace(passing=True) for each in found)
        if self.program.layout.area_at(offset) is not None:
            return self._in_area(offset, size, bits)
        root = self.descent.root(offset)
        if root is not None:
            return tuple(leaves(self.descent, root, offset, size, bits))
        if offset < Layout.HEADER_SIZE or size not in (1, 2, 4, 8):
            return ()
        return (Leaf(self.path(offset), RAW_TYPES[8 * size], offset, None),)

    def whole(self, offset: int, bits: int) -> Leaf:
        """The whole variable that has these bits of a byte of the state, else the address."""
        area = self.program.layout.area_at(offset)
        if area is None:
            root = self.descent.root(offset)
            found = leaves(self.descent, root, offset, 1, whole=True) if root is not None else []
            name, begin, size = system_field(self.program.layout, offset) or (self.path(offset), offset, 1)
            return found[0] if found else Leaf(name, RAW_TYPES[8 * size], begin, None)
        for part in self._best(offset, 1, bits):
            if part.bit is not None and bits == 1 << part.bit:
                return Leaf(part.name, BOOL, offset, part.bit)
            found = leaves(self.descent, part, offset, 1, whole=True) if part.bit is None else []
            if found:
                return found[0]
        even = offset - area[1] % 2
        return self._raw(even, 2, WHOLE)[0] if area[0].unit == "word" else self._raw(offset, 1, bits)[0]

    def temporaries(self, pou: Pou) -> tuple[Leaf, ...]:
        """All temporaries of a POU, by their paths."""
        return self._of_frame(pou, pou.frame_offset, pou.frame.size, WHOLE) if pou.frame.size else ()

    def _of_frame(self, pou: Pou, offset: int, size: int, bits: int) -> tuple[Leaf, ...]:
        if self._mine is not None and pou not in self._mine:
            return ()
        return tuple(leaves(self.descent, Part(pou.name, pou.frame, pou.frame_offset), offset, size, bits))

    def _in_area(self, offset: int, size: int, bits: int) -> tuple[Leaf, ...]:
        for part in self._best(offset, size, bits):
            if part.offset + part.type.size < offset + size:
                continue
            if part.bit is not None:
                if bits == 1 << part.bit:
                    return (Leaf(part.name, BOOL, offset, part.bit),)
                continue
            found = leaves(self.descent, part, offset, size, bits)
            if found:
                return tuple(found)
        return self._raw(offset, size, bits)

    def _best(self, offset: int, size: int, bits: int) -> list[Part]:
        """The variables at addresses that hold a byte. The one that was probably meant, as it is there as a whole, comes first."""

        def fit(part: Part) -> tuple[bool, bool, int]:
            return (part.bit is not None) != (bits != WHOLE), part.offset != offset, abs(part.type.size - size)

        return sorted(self.descent.located(offset), key=fit)

    def _raw(self, offset: int, size: int, bits: int) -> tuple[Leaf, ...]:
        """Addresses of the model."""
        model, area = self.program.layout.model, self.program.layout.area_at(offset)
        assert area is not None
        if bits != WHOLE:
            bit = bits.bit_length() - 1
            return (Leaf(model.format(area[0], area[1], bit, 1), BOOL, offset, bit, raw=True),)
        step = size if size in (1, 2, 4, 8) else 2
        return tuple(
            Leaf(model.format(area[0], area[1] + at, None, 8 * step), RAW_TYPES[8 * step], offset + at, None, raw=True)
            for at in range(0, size - size % step, step)
        )

    # ---- inside of a POU ------------------------------------------------------------------------------------------

    @staticmethod
    def inside(pou: Pou | None, instance: int, memory: Image) -> Inside:
        """Where a pass runs that begins now."""
        if pou is None:
            return ANYWHERE
        return Inside(pou, instance, tuple(_slot(memory, at) for _, at in _in_outs(pou, instance)))

    def within(self, inside: Inside) -> "NamesInside":
        """The names of a pass."""
        return NamesInside(self, inside, self._known.setdefault(inside, {}))

    # ---- symbols, blocks, text ------------------------------------------------------------------------------------

    def variable(self, place: Spot, type: Type) -> Symbol | None:
        """The variable, or part of one, or address; None if there is nothing of this type, as for a stray pointer."""
        for path in self._paths(place, type):
            try:
                symbol = resolve(self.program, path)
            except UnknownPath:
                continue
            if not symbol.slots and same_place((symbol.offset, symbol.bit), place) and _fits(symbol.type, type):
                return symbol
        return None

    def _paths(self, place: Spot, type: Type) -> Iterator[str]:
        offset, bit = place
        area = self.program.layout.area_at(offset)
        if area is None:
            root = self.descent.root(offset)
            if root is not None:
                yield from self._down(root, place, type)
            return
        for each in self.descent.located(offset):
            if each.bit is None or each.bit == bit:
                yield from self._down(each, place, type)
        bits = 1 if type == BOOL else 8 * type.size
        if bits in RAW_TYPES:
            yield self.program.layout.model.format(*area, (bit or 0) if bits == 1 else None, bits)

    def _down(self, part: Part, place: Spot, type: Type) -> Iterator[str]:
        """Down to what begins there, from the outermost of the type."""
        offset, bit = place
        if part.offset == offset and _fits(part.type, type):
            yield part.name
        if isinstance(part.type, Elementary):
            at, within = offset - part.offset, bit or 0
            if type == BOOL:
                yield f"{part.name}.{8 * at + within}"
            elif type.size < part.type.size:
                letter = {1: "B", 2: "W", 4: "D"}.get(type.size, "B")
                yield f"{part.name}.%{letter}{at // max(1, type.size)}"
            return
        for inner in self._within(part, offset):
            yield from self._down(inner, place, type)

    def _within(self, part: Part, offset: int) -> list[Part]:
        return [each for each in self.descent.inner(part, offset, offset + 1) if not each.elsewhere]

    def holding(self, offset: int) -> Iterator[Part]:
        """Everything that holds a byte, from the outermost; what has an address of its own is left out."""
        part = self.descent.root(offset)
        while part is not None:
            yield part
            part = next(iter(self._within(part, offset)), None)

    def starting(self, offset: int) -> Iterator[Part]:
        """Everything that begins at a byte: an instance, its first member, that member's first element, ..."""
        root = self.descent.root(offset)
        ahead = [] if root is None else [root]
        while ahead:
            part = ahead.pop(0)
            if part.offset == offset:
                yield part
            ahead += self._within(part, offset)

    def instance(self, offset: int, pou: str) -> str:
        """The path of the instance of this POU (or of a block derived from it) that begins at a byte.

        `pou` may be a method, too: `Tank.Fill`, `Tank.Level.get`."""
        blocks = [each for each in self.starting(offset) if each.type.kind is Kind.BLOCK]
        name = pou.upper()
        while name:
            for each in blocks:
                if name in _ancestry(each.type):
                    return each.name
            name = name.rpartition(".")[0]
        return blocks[0].name if blocks else f"image+{offset}"

    def temporary(self, offset: int) -> tuple[Pou, str] | None:
        """The POU whose temporary this is, and its name there; empty for what the compiler keeps."""
        pou = self.descent.frame(offset)
        if pou is None:
            return None
        inner = self.descent.inner(Part("", pou.frame, pou.frame_offset), offset, offset + 1)
        return pou, next((each.name for each in inner if each.member is not None and not each.member.hidden), "")

    def path(self, offset: int) -> str:
        """What lives at a byte, whatever it is: `Main.fb.count`, `D100`, `mode (system)`, `image+5000`."""
        field = system_field(self.program.layout, offset)
        if field is not None:
            return field[0]
        area = self.program.layout.area_at(offset)
        if area is not None:
            return self.program.layout.model.format(area[0], area[1] - area[1] % 2, None, 16)
        part = self.descent.root(offset) or self._common(offset)
        if part is None:
            return f"image+{offset}"
        while inner := self.descent.inner(part, offset, offset + 1):
            part = inner[0]
            if part.elsewhere:
                in_out = part.member is not None and part.member.section is Section.IN_OUT
                return f"{part.name} (in-out)" if in_out else part.name
        return part.name

    def _common(self, offset: int) -> Part | None:
        for each in (*self.program.common, *self.program.life):
            if each.offset <= offset < each.offset + each.pou.instance.size:
                return Part(each.name, each.pou.instance, each.offset)
        return None

    def text(self, offset: int, bit: int | None, type: Type) -> str:
        """`Main.tank[3].level (D120)`, `D100`, `temporary Mix.t`."""
        symbol, address = self.variable((offset, bit), type), self.address(offset, bit, type)
        if symbol is not None:
            return f"{symbol.path} ({address})" if address and address != symbol.path else symbol.path
        if address:
            return address
        temporary = self.temporary(offset)
        if temporary is not None:
            return f"temporary {'.'.join(filter(None, (temporary[0].name, temporary[1])))}"
        return self.path(offset)

    def address(self, offset: int, bit: int | None, type: Type) -> str:
        """In the vendor's notation, where it is in an area of the model."""
        area = self.program.layout.area_at(offset)
        if area is None:
            return ""
        bits = 1 if bit is not None else 8 * type.size
        if bits not in RAW_TYPES or (type == BOOL and bit is None):
            bits = 16
        return self.program.layout.model.format(*area, bit, bits)


class NamesInside:
    """The names of one pass: of a function block, function or method those inside of it, so that the passes of several
    instances share them."""

    __slots__ = ("_inside", "_known", "_names")

    def __init__(self, names: Names, inside: Inside, known: dict[tuple[int, int, int], tuple[Leaf, ...]]) -> None:
        self._names, self._inside, self._known = names, inside, known

    def at(self, offset: int, size: int, bits: int) -> tuple[Leaf, ...]:
        """What these bytes are."""
        key = offset, size, bits
        found = self._known.get(key)
        if found is None:
            found = self._known[key] = self._find(offset, size, bits)
        return found

    def _find(self, offset: int, size: int, bits: int) -> tuple[Leaf, ...]:
        names, (pou, instance) = self._names, (self._inside.pou, self._inside.instance)
        if pou is None:
            return names.at(offset, size, bits)
        record = owner_of(pou) if pou.kind != "program" else None
        if record is not None and instance <= offset < instance + record.size:
            return tuple(leaves(names.descent, Part("", record, instance), offset, size, bits))
        if pou.frame_offset <= offset < pou.frame_offset + pou.frame.size:
            return tuple(leaves(names.descent, Part("", pou.frame, pou.frame_offset), offset, size, bits))
        for (member, _), slot in zip(_in_outs(pou, instance), self._inside.slots, strict=True):
            place = referred(slot)
            if place is not None and place[0] <= offset < place[0] + member.type.size:
                if member.type != BOOL:
                    return tuple(leaves(names.descent, Part(member.name, member.type, place[0]), offset, size, bits))
                if bits in (WHOLE, 1 << place[1]):
                    return (Leaf(member.name, BOOL, offset, None if bits == WHOLE else place[1]),)
        found = names.at(offset, size, bits)
        return found if offset >= names.program.layout.frames else tuple(map(self._seen, found))

    def _seen(self, leaf: Leaf) -> Leaf:
        """A variable from outside, as it is named here: the POU may have one of this name, too."""
        pou = self._inside.pou
        if pou is None or pou.kind == "program":
            return leaf
        record = owner_of(pou)
        if record is not None:
            head = f"{self._names.instance(self._inside.instance, record.name)}."
            if leaf.name.startswith(head):  # at an address of its own
                return leaf._replace(name=leaf.name.removeprefix(head))
        first = leaf.name.partition(".")[0].partition("[")[0].upper()
        own = first in pou.frame.members or (record is not None and first in record.members)
        return leaf._replace(name=f"{leaf.name}{_GLOBAL}") if own else leaf


def names_of(program: Program) -> Names:
    """The same, again and again, as long as few other programs are asked about."""
    found = next((each for each in _MADE if each.program is program), None)
    if found is None:
        found = Names(program)
        _MADE.append(found)
        del _MADE[:-_KEPT]
    return found


def same_place(one: Spot, other: Spot) -> bool:
    """Whether two places are one; a BOOL that has its byte for itself is bit 0 of that."""
    return one[0] == other[0] and (one[1] or 0) == (other[1] or 0)


def _in_outs(pou: Pou, instance: int) -> Iterator[tuple[Member, int]]:
    """The in-outs of a POU, and where their slots are."""
    for record, start in ((pou.instance, instance), (pou.frame, pou.frame_offset)):
        for member in record.members.values():
            if member.section is Section.IN_OUT and member.bound and not member.hidden:
                yield member, start + member.offset


def _slot(memory: Image, at: int) -> int:
    return int.from_bytes(memory[at : at + SLOT_BYTES], "little")


def _ancestry(type: Type) -> Iterator[str]:
    """Names of a block and of what it extends, in upper case."""
    record = type if isinstance(type, Record) else None
    while record is not None:
        yield record.name.upper()
        record = record.base


def _fits(found: Type, wanted: Type) -> bool:
    """Whether this may be what was passed for one of the wanted type: a block may be of one that extends it."""
    known: Record | None = found if isinstance(found, Record) else None
    while known is not None:
        if known is wanted or known.name == wanted.name:
            return True
        known = known.base
    if found == wanted or found.name == wanted.name:
        return True
    return isinstance(found, ArrayType) and wanted.size == 0 and found.element.name in wanted.name
