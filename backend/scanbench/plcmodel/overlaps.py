"""Bits that two parts of one error would both write: then what one says would depend on the other."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from scanbench.plcmodel.areas import Location
from scanbench.plcmodel.catalogue import ErrorAddress, ErrorDetail


class Stretch(NamedTuple):
    """Bits of an area, the end exclusive."""

    area: str
    first: int
    end: int

    def meets(self, other: "Stretch") -> bool:
        """Whether they share a bit."""
        return self.area == other.area and self.first < other.end and other.first < self.end

    def words(self) -> "Stretch":
        """The whole words that it lies in."""
        return Stretch(self.area, self.first // 16 * 16, -(-self.end // 16) * 16)


def overlaps(
    flag: Location | None, flag_text: str, details: Sequence[ErrorDetail], also: Sequence[ErrorAddress]
) -> Iterator[str]:
    """What is wrong; choices of one List may share bits, as only one of them is written."""
    parts: list[tuple[str, tuple[Stretch, ...], str]] = []
    if flag is not None:
        parts.append(("the flag", (stretch(flag),), flag_text))
    parts += [(f"detail {each.name}", tuple(stretches(each.addresses)), each.addresses[0].text) for each in details]
    parts += [(f"Also {each.text}", tuple(stretches((each,))), each.text) for each in also]
    for number, (name, written, text) in enumerate(parts):
        for earlier, others, _ in parts[:number]:
            if any(one.meets(other) for one in written for other in others):
                yield f"{name} writes bits of {text} that {earlier} writes too"
                break


def stretch(place: Location, words: int = 1) -> Stretch:
    """The bits of a place, or of so many words from there on."""
    first = place.byte * 8 + (place.bit or 0)
    return Stretch(place.area.name, first, first + (place.bits if words == 1 else 16 * words))


def stretches(addresses: Sequence[ErrorAddress]) -> Iterator[Stretch]:
    """The bits that these addresses may write."""
    for each in addresses:
        place = each.location
        if place is None:
            continue
        first = place.byte * 8 + (place.bit or 0)
        if each.kind == "Bit":
            yield stretch(place)
        elif each.kind == "BitArray":
            low, high = (each.minimum or 0, each.maximum or 0) if each.value is None else (each.value, each.value)
            yield Stretch(place.area.name, first + low, first + high + 1)
        elif each.is_text:
            yield Stretch(place.area.name, first, first + 8 * (each.maximum or 0))
        else:
            yield Stretch(place.area.name, first + each.shift, first + each.shift + each.width)
