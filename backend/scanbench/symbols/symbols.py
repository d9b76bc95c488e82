"""Variables by instance path, for tools: `Main.fb1.level`, `Main.a[3]`, and raw addresses: `D100`, `A402.12`, `%MW3`."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from difflib import get_close_matches

from scanbench.plcmodel.model import Access
from scanbench.program.copies import NO_COPIES, Copies, Image, Spot, referred
from scanbench.program.layout import Layout
from scanbench.program.own_variables import SYSTEM
from scanbench.program.program import Program
from scanbench.program.types import (
    BOOL,
    ELEMENTARY,
    SLOT_BYTES,
    ArrayType,
    Elementary,
    Kind,
    Member,
    OpenArray,
    Record,
    Reference,
    Section,
    Type,
    actual_of,
)

PART = re.compile(r"\s*\.?\s*([^\W\d]\w*)|\s*\[\s*([-\d\s,]+)\]|\s*\^")
PIECE = re.compile(r"\s*\.\s*(?:%\s*([XBWDL]))?(\d{1,9})(?!\w)", re.IGNORECASE)
"""A bit, byte, word or double word of an integer or bit string: `.3`, `.%X3`, `.%W1`."""
RANGE = re.compile(r"(.*\S)\s*:\s*(\d{1,9})")
"""So many addresses from one on: `W10:8`."""
PARTED = (Kind.INT, Kind.UINT, Kind.BITS)
WIDTHS = {"X": 1, "B": 8, "W": 16, "D": 32, "L": 64}
RAW_TYPES = {1: BOOL, 8: ELEMENTARY["BYTE"], 16: ELEMENTARY["WORD"], 32: ELEMENTARY["DWORD"], 64: ELEMENTARY["LWORD"]}
MAX_MEMBERS = 10_000


class UnknownPath(Exception):
    """Nothing has this path; `near` lists what was perhaps meant."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.message = message
        self.near = near


@dataclass(frozen=True, slots=True)
class Symbol:
    """A variable and where it lives."""

    path: str
    name: str
    type: Type
    section: str
    offset: int
    """In the image; after the last of `slots`, relative to where that refers to."""
    bit: int | None = None
    slots: tuple[int, ...] = ()
    """Offsets of the in-out slots and references on the way: the first in the image, each further one relative to its
    forerunner."""
    address: str | None = None
    tool: Access = "write"
    constant: bool = False
    copies: Copies = NO_COPIES
    """For what is reached through slots: an in-out by value on the way is a copy, and the variable itself is wanted."""

    @property
    def writable(self) -> bool:
        return self.tool == "write" and not self.constant and not self.expandable

    @property
    def expandable(self) -> bool:
        return isinstance(self.type, ArrayType | Record)

    def locate(self, memory: Image) -> Spot | None:
        """Byte offset and bit of the value now; None while an in-out or reference on the way refers to nothing."""
        base = 0
        bit = self.bit
        last = len(self.slots) - 1
        for index, slot in enumerate(self.slots):
            found = referred(int.from_bytes(memory[base + slot : base + slot + SLOT_BYTES], "little"))
            if found is None or not Layout.HEADER_SIZE <= found[0] < len(memory):
                return None
            base = found[0]
            if self.type == BOOL and index == last and self.offset == 0 and self.bit is None:
                bit = found[1]
            if self.copies.all:
                real = self.copies.actual(memory, base, bit)
                if real is None:
                    return None
                base, bit = real
        if self.slots and base + self.offset + self.type.size > len(memory):
            return None
        return base + self.offset, bit


def resolve(program: Program, path: str) -> Symbol:
    """The variable or address of this path; case does not matter."""
    text = path.strip()
    first = PART.match(text)
    name = first.group(1) if first else ""
    root = _root(program, name) if name else None
    while root is None and name and first and (further := PART.match(text, first.end())) and further.group(1):
        # a program instance after the name of its resource, a global variable after its namespaces
        name, first = f"{name}.{further.group(1)}", further
        root = _root(program, name)
    if root is None or first is None:
        return _raw(program, text)
    symbol, at = root, first.end()
    while at < len(text):
        piece = PIECE.match(text, at)
        if piece is not None:
            symbol, at = _piece(symbol, piece.group(1), int(piece.group(2))), piece.end()
            continue
        part = PART.match(text, at)
        if part is None:
            raise UnknownPath(f"`{text[at:]}` cannot be read in `{path}`; write a path like Main.fb.a[3].")
        symbol = _step(program, symbol, part.group(1), part.group(2))
        at = part.end()
    return _checked(program, symbol)


def members(program: Program, path: str) -> list[Symbol]:
    """The parts of the variable at a path, in order of declaration; for '': program instances and globals."""
    if not path.strip():
        return list(roots(program))
    symbol = resolve(program, path)
    return [_checked(program, each) for each in _children(program, symbol)]


def complete(program: Program, text: str, limit: int) -> list[Symbol]:
    """Symbols whose path goes on from `text`."""
    text = text.strip()
    cut = max(text.rfind("."), text.rfind("[")) + 1
    owner, start = text[:cut].rstrip(".["), text.upper()
    found: list[Symbol] = []
    try:
        for symbol in members(program, owner) if owner else roots(program):
            if symbol.path.upper().startswith(start):
                found.append(symbol)
                if len(found) >= limit:
                    break
        if not owner and start:
            given = (_root(program, name) for name in _given(program) if name.startswith(start))
            known = {symbol.path.upper() for symbol in found}
            found += [each for each in given if each is not None and each.path.upper() not in known][
                : limit - len(found)
            ]
    except UnknownPath:  # the name of a resource, perhaps
        found += [symbol for symbol in roots(program) if symbol.path.upper().startswith(start)][:limit]
    if len(found) < limit and text:
        try:
            raw = _raw(program, text)
            found.append(raw)
        except UnknownPath:
            pass
    return found


def roots(program: Program) -> Iterator[Symbol]:
    """Program instances and globals."""
    for instance in program.shown:
        yield Symbol(instance.name, instance.name, instance.pou.instance, "PROGRAM", instance.offset)
    owner = program.layout.globals
    for member in owner.members.values() if owner else ():
        if member.hidden:
            continue
        yield _global(program, member)


def _global(program: Program, member: Member) -> Symbol:
    return _checked(program, member_of(Symbol("", "", BOOL, "", 0), member, member.name))


def _root(program: Program, name: str) -> Symbol | None:
    owner, upper = program.layout.globals, name.upper()
    upper = program.layout.lists.get(upper, upper).upper()
    instance = next((each for each in program.shown if each.name.upper() == upper), None)
    member = owner.members.get(upper) if owner is not None else None
    found = None
    if instance is not None:
        found = Symbol(instance.name, instance.name, instance.pou.instance, "PROGRAM", instance.offset)
    elif member is not None and not member.hidden:
        found = _global(program, member)
    access = next((each for each in program.accesses if each.name.upper() == upper), None)
    if found is None and access is None:
        given = _given(program).get(upper)
        return None if given is None else _checked(program, member_of(Symbol("", "", BOOL, "", 0), given, given.name))
    if found is not None or access is None:
        return found
    symbol = resolve(program, access.path)
    return replace(symbol, path=access.name, name=access.name, constant=symbol.constant or not access.writable)


def _given(program: Program) -> dict[str, Member]:
    """Variables that every program has, by upper-case name; its own of that name come first."""
    named = program.layout.symbols
    return {**(named.members if named is not None else {}), **SYSTEM.members}


def member_of(owner: Symbol, member: Member, path: str) -> Symbol:
    """The variable of an instance, structure, frame or of the globals, which begins where `owner` does."""
    made = Symbol(
        path, member.name, member.type, member.section.value, member.offset, member.bit, (),
        member.address or None, constant=member.constant or owner.constant,
    )  # fmt: skip
    if member.located:
        return made
    if member.section is Section.IN_OUT:
        record = owner.type
        slot = actual_of(record, member) if member.copied and isinstance(record, Record) else member
        return replace(made, offset=0, slots=(*owner.slots, owner.offset + slot.offset))
    if member.incomplete and isinstance(member.type, Reference) and member.type.target is not None:
        return replace(made, type=member.type.target, offset=0, slots=(*owner.slots, owner.offset + member.offset))
    return replace(made, offset=owner.offset + member.offset, slots=owner.slots)


def _step(program: Program, symbol: Symbol, name: str | None, index: str | None) -> Symbol:
    if index is None and name is None:
        return target_of(symbol)
    if isinstance(symbol.type, Reference) and symbol.type.automatic:
        symbol = replace(target_of(symbol), path=symbol.path)
    if index is not None:
        return _element(symbol, index)
    record = symbol.type
    if isinstance(record, Reference):
        raise UnknownPath(f"`{symbol.path}` is a reference; write `{symbol.path}^.{name}`.")
    if not isinstance(record, Record) or name is None:
        raise UnknownPath(f"`{symbol.path}` is {symbol.type} and has no member `{name}`.")
    member = record.members.get(name.upper())
    if member is None or member.hidden:
        names = {each.name.upper(): each.name for each in record.members.values() if not each.hidden}
        near = tuple(f"{symbol.path}.{names[each]}" for each in get_close_matches(name.upper(), names, 3, 0.5))
        raise UnknownPath(f"`{symbol.path}` has no member `{name}`.", near)
    return member_of(symbol, member, f"{symbol.path}.{member.name}")


def target_of(symbol: Symbol) -> Symbol:
    """The symbol to which a reference refers at the moment."""
    type = symbol.type
    if not isinstance(type, Reference) or type.target is None:
        raise UnknownPath(f"`{symbol.path}` is {type}, not a reference.")
    slots = (*symbol.slots, symbol.offset)
    return replace(symbol, path=f"{symbol.path}^", name="^", type=type.target, offset=0, slots=slots, address=None)


def _element(symbol: Symbol, index: str) -> Symbol:
    array = symbol.type
    if isinstance(array, OpenArray):
        raise UnknownPath(f"The bounds of `{symbol.path}` come with each call; look at the array that is passed.")
    if not isinstance(array, ArrayType):
        raise UnknownPath(f"`{symbol.path}` is {symbol.type}, not an array.")
    try:
        numbers = [int(part) for part in index.split(",")]
    except ValueError:
        raise UnknownPath(f"`[{index}]` is not an index; write a number.") from None
    if len(numbers) != len(array.bounds):
        raise UnknownPath(f"`{symbol.path}` has {len(array.bounds)} dimensions, not {len(numbers)}.")
    offset = symbol.offset
    for dimension, (number, (low, high)) in enumerate(zip(numbers, array.bounds, strict=True)):
        if not low <= number <= high:
            raise UnknownPath(f"Index {number} of `{symbol.path}` is outside of {low}..{high}.")
        offset += (number - low) * array.stride(dimension)
    shown = ",".join(map(str, numbers))
    return replace(
        symbol, path=f"{symbol.path}[{shown}]", name=f"[{shown}]", type=array.element, offset=offset, section="member",
        address=None,
    )  # fmt: skip


def _piece(symbol: Symbol, size: str | None, index: int) -> Symbol:
    """A bit or a larger part of a number."""
    whole = symbol.type
    bits = WIDTHS[(size or "X").upper()]
    shown = f".{index}" if size is None else f".%{size.upper()}{index}"
    if not isinstance(whole, Elementary) or whole.kind not in PARTED:
        raise UnknownPath(f"`{symbol.path}` is {whole} and has no part `{shown}`; only integers and bit strings have.")
    count = 8 * whole.size // bits if bits < 8 * whole.size else 0
    if index >= count:
        which = f"it has {count} of that size" if count else "it is no larger than that"
        raise UnknownPath(f"`{symbol.path}` is {whole} and has no part `{shown}`: {which}.")
    return replace(
        symbol, path=f"{symbol.path}{shown}", name=shown, type=RAW_TYPES[bits], section="member", address=None,
        offset=symbol.offset + index * bits // 8, bit=index % 8 if bits == 1 else None,
    )  # fmt: skip


def _children(program: Program, symbol: Symbol) -> list[Symbol]:
    type = symbol.type
    if symbol.section == "range" and isinstance(type, ArrayType):
        return _addresses(program, symbol, type)
    if isinstance(type, Record):
        return [
            member_of(symbol, member, f"{symbol.path}.{member.name}")
            for member in type.members.values()
            if not member.hidden
        ]
    if isinstance(type, ArrayType):
        found = [""]
        for low, high in type.bounds:
            found = [f"{head},{number}" for head in found for number in range(low, high + 1)][:MAX_MEMBERS]
        return [_element(symbol, each.lstrip(",")) for each in found]
    return []


def _range(program: Program, first: str, count: int) -> Symbol:
    """So many addresses from one on, to be unfolded."""
    start = _raw(program, first)
    area, byte = program.layout.area_at(start.offset) or (None, 0)
    assert area is not None
    at, step = _position(start, byte)
    room = (16 * area.words - at) // step
    if not 1 <= count <= min(room, MAX_MEMBERS):
        most = f"there are {room} from there on" if room < MAX_MEMBERS else f"at most {MAX_MEMBERS:,} can be watched"
        raise UnknownPath(
            f"`{first}:{count}` is not a range of {area.name}: {most}.", (f"{start.path}:{min(room, 8)}",)
        )
    path = f"{start.path}:{count}"
    return replace(
        start, path=path, name=path, type=ArrayType(((0, count - 1),), start.type), section="range", bit=None
    )


def _position(symbol: Symbol, byte: int) -> tuple[int, int]:
    """The bit of its area at which an address begins, and how many bits it has."""
    return 8 * byte + (symbol.bit or 0), 1 if symbol.bit is not None else 8 * symbol.type.size


def _addresses(program: Program, symbol: Symbol, array: ArrayType) -> list[Symbol]:
    """What a range consists of."""
    model = program.layout.model
    start = _raw(program, symbol.path.rpartition(":")[0])
    area, byte = program.layout.area_at(start.offset) or (None, 0)
    assert area is not None
    at, step = _position(start, byte)
    found = []
    for position in range(at, at + array.count * step, step):
        bit = position % 8 if start.bit is not None else None
        name = model.format(area, position // 8, bit, step)
        offset = start.offset - byte + position // 8
        found.append(_checked(program, replace(start, path=name, name=name, offset=offset, bit=bit, address=name)))
    return found


def children(program: Program, symbol: Symbol, start: int = 0, count: int = MAX_MEMBERS) -> list[Symbol]:
    """The parts of a variable, from number `start` on."""
    type = symbol.type
    if not isinstance(type, ArrayType):
        return _children(program, symbol)[start : start + count]
    found = []
    for number in range(start, min(start + count, type.count)):
        rest, index = number, ""
        for low, high in reversed(type.bounds):
            rest, here = divmod(rest, high - low + 1)
            index = f",{low + here}{index}"
        found.append(_element(symbol, index[1:]))
    return found


def _raw(program: Program, text: str) -> Symbol:
    """An address of the model, or a range of them."""
    ranged = RANGE.fullmatch(text)
    if ranged is not None:
        return _range(program, ranged.group(1), int(ranged.group(2)))
    model = program.layout.model
    location = model.locate(text)
    if location is None:
        raise UnknownPath(
            f"There is no variable and no address `{text}`.{_reason(program, text)}", _near(program, text)
        )
    offset = program.layout.areas[location.area.name] + location.byte
    name = model.format(location.area, location.byte, location.bit, location.bits)
    made = Symbol(name, name, RAW_TYPES[location.bits], "address", offset, location.bit, (), name)
    return _checked(program, made)


def _reason(program: Program, text: str) -> str:
    return "" if re.fullmatch(r"[^\W\d]\w*", text) and not any(c.isdigit() for c in text) else (
        f" {program.layout.model.why_not(text)}"
    )  # fmt: skip


def _near(program: Program, text: str) -> tuple[str, ...]:
    """Near matches among the roots, and among the members of programs for a bare name."""
    paths = {symbol.path.upper(): symbol.path for symbol in roots(program)}
    for instance in program.shown:
        for member in instance.pou.instance.members.values():
            if not member.hidden:
                paths[member.name.upper()] = f"{instance.name}.{member.name}"
    return tuple(paths[each] for each in get_close_matches(text.upper(), paths, 3, 0.5))


def _checked(program: Program, symbol: Symbol) -> Symbol:
    """Adds the model's word on who may write there, and the address, for what lives in an area."""
    layout: Layout = program.layout
    if symbol.slots:
        return replace(symbol, copies=layout.copies) if layout.copies.all else symbol
    found = layout.area_at(symbol.offset)
    if found is None:
        return symbol
    area, byte = found
    bits = 1 if symbol.bit is not None else 8 * symbol.type.size
    address = layout.model.format(area, byte, symbol.bit, bits if bits in RAW_TYPES else 16)
    free = area.protected(byte, bits // 8, "tool") is None
    return replace(symbol, address=address, tool="write" if free else "read")
