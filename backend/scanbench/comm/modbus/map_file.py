"""The map of Modbus that a project has of its own: `modbus.csv`, as the page exports the map of a model.

    group,first,last,from,to,registers of a value
    coil,0,15,CIO0.00,CIO0.15,1
    holding register,0,99,D1000,,1

`to` and the last column may be left out. Lines that begin with # are comments. It takes the place of the model's map as a whole.
"""

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Final

from scanbench.comm.modbus.ask import is_bits
from scanbench.comm.modbus.mapping import GROUPS, Group, Mapped, begins_and_ends
from scanbench.plcmodel.areas import Location
from scanbench.plcmodel.model import Model
from scanbench.wire.refused import Refused

MAP_FILE: Final = "modbus.csv"
"""The name of the file, at the top of a project."""
_NEEDED, _OTHER = ("group", "first", "last", "from"), ("to", "registers of a value")
_WIDTHS = (1, 2, 4)
_ADDRESSES, _WORD, _MOST_RANGES = 1 << 16, 16, 1000
_NAMED: Mapping[str, Group] = {each: each for each in GROUPS}


class _Wrong(Exception):
    """What is wrong with a line."""


def read_map(model: Model, text: str) -> tuple[Mapped, ...]:
    """The table of a file. `Refused` names the line that is wrong."""
    found: list[tuple[int, Mapped]] = []
    head: dict[str, int] | None = None
    for line, cells in _lines(text):
        try:
            if head is None:
                head = _head(cells)
                continue
            _add(found, line, _range(model, head, cells))
        except _Wrong as wrong:
            raise Refused(f"{MAP_FILE}, line {line}: {wrong}") from None
    if not found:
        raise Refused(f"{MAP_FILE} has no range: a map without any is no use; delete the file for that of {model.name}")
    return tuple(each for _, each in found)


def _lines(text: str) -> Iterator[tuple[int, list[str]]]:
    plain = text.removeprefix("\ufeff")
    first = next((each for each in plain.splitlines() if each.strip() and not each.startswith("#")), "")
    reader = csv.reader(plain.splitlines(), delimiter=";" if ";" in first else ",")
    while True:
        try:
            cells = next(reader, None)
        except csv.Error:  # a cell longer than csv takes
            wrong = _Wrong("this is no line of a table")
            raise Refused(f"{MAP_FILE}, line {reader.line_num}: {wrong}") from None
        if cells is None:
            return
        told = [each.strip() for each in cells]
        if any(told) and not told[0].startswith("#"):
            yield reader.line_num, told


def _head(cells: Sequence[str]) -> dict[str, int]:
    names = [each.lower() for each in cells]
    for each in names:
        if each and each not in (*_NEEDED, *_OTHER):
            raise _Wrong(f"there is no column {each!r}: the columns are {', '.join((*_NEEDED, *_OTHER))}")
    for each in _NEEDED:
        if each not in names:
            raise _Wrong(f"the column {each!r} is missing: the first line names the columns")
    return {name: at for at, name in enumerate(names) if name}


def _range(model: Model, head: Mapping[str, int], cells: Sequence[str]) -> Mapped:
    told = {name: cells[at] if at < len(cells) else "" for name, at in head.items()}
    group = _NAMED.get(told["group"].lower())
    if group is None:
        raise _Wrong(f"{told['group']!r} is no group: they are {', '.join(GROUPS)}")
    first, last = _number(told, "first"), _number(told, "last")
    if not first <= last < _ADDRESSES:
        raise _Wrong(f"{first} to {last} is no range: it is within 0 to {_ADDRESSES - 1}, the first one first")
    count, bits = last - first + 1, is_bits(group)
    width = _number(told, _OTHER[1]) if told.get(_OTHER[1]) else 1
    if width not in _WIDTHS or (bits and width != 1) or count % width:
        raise _Wrong(
            f"{count} of {width} registers a value: a value has 1, 2 or 4 registers, all in the range, and a bit has 1"
        )
    place = _place(model, told["from"], bits)
    words = -(-count // _WORD) if bits else count
    if place.word + words > place.area.words:
        raise _Wrong(f"{count} from {told['from']} on do not fit into {place.area.name}")
    made = Mapped(group, first, count, place.area.name, place.word, width)
    begins, ends = begins_and_ends(model, made)
    if told.get("to") and not _same(model, told["to"], ends):
        raise _Wrong(f"it ends at {ends}, not at {told['to']}")
    return replace(made, begins=begins, ends=ends)


def _number(told: Mapping[str, str], name: str) -> int:
    text = told[name]
    if not text.isascii() or not text.isdigit():
        raise _Wrong(f"{name} is a whole number, not {text!r}")
    return int(text[:9])


def _place(model: Model, address: str, bits: bool) -> Location:
    place = model.locate(address)
    if place is None:
        raise _Wrong(model.why_not(address))
    of_points = place.area.unit == "bit"
    if place.byte % 2 or (place.bit or 0) or place.bits != (1 if bits or (of_points and place.bits == 1) else _WORD):
        needed = "bit 0 of a word" if bits else "a word"
        raise _Wrong(f"a range begins at {needed}, and {address} is none")
    return place


def _same(model: Model, address: str, other: str) -> bool:
    return address.upper() == other.upper() or model.locate(address) == model.locate(other)


def _add(found: list[tuple[int, Mapped]], line: int, made: Mapped) -> None:
    for other, each in found:
        if each.group == made.group and each.first < made.first + made.count and made.first < each.first + each.count:
            raise _Wrong(f"line {other} has some of these already")
    if len(found) >= _MOST_RANGES:
        raise _Wrong(f"a map has up to {_MOST_RANGES} ranges")
    found.append((line, made))
