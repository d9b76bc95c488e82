"""Bits that two parts of one error would both write: then what one says would depend on the other."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from scanbench.plcmodel.areas import Location
from scanbench.plcmodel.catalogue import ErrorAddress, ErrorDetail


class _Stretch(NamedTuple):
    """Bits of an area, the end exclusive."""

    area: str
    first: int
    end: int

    def meets(self, other: "_Stretch") -> bool:
        return self.area == other.area and self.first < other.end and other.first < self.end


def overlaps(
    flag: Location | None, flag_text: str, details: Sequence[ErrorDetail], also: Sequence[ErrorAddress]
) -> Iterator[str]:
    """What is wrong; choices of one List may share bits, as only one of them is written."""
    parts: list[tuple[str, tuple[_Stretch, ...], str]] = []
    if flag is not None:
        parts.append(("the flag", (_bit(flag),), flag_text))
    parts += [(f"detail {each.name}", tuple(_stretches(each.addresses)), each.addresses[0].text) for each in details]
    parts += [(f"Also {each.text}", tuple(_stretches((each,))), each.text) for each in also]
    for number, (name, stretches, text) in enumerate(parts):
        for earlier, others, _ in parts[:number]:
            if any(one.meets(other) for one in stretches for other in others):
                yield f"{name} writes bits of {text} that {earlier} writes too"
                break


def _bit(place: Location) -> _Stretch:
    first = place.byte * 8 + (place.bit or 0)
    return _Stretch(place.area.name, first, first + 1)


def _stretches(addresses: Sequence[ErrorAddress]) -> Iterator[_Stretch]:
    for each in addresses:
        place = each.location
        if place is None:
            continue
        first = place.byte * 8 + (place.bit or 0)
        if each.kind == "Bit":
            yield _bit(place)
        elif each.kind == "BitArray":
            low, high = (each.minimum or 0, each.maximum or 0) if each.value is None else (each.value, each.value)
            yield _Stretch(place.area.name, first + low, first + high + 1)
        elif each.is_text:
            yield _Stretch(place.area.name, first, first + 8 * (each.maximum or 0))
        else:
            yield _Stretch(place.area.name, first + each.shift, first + each.shift + each.width)
