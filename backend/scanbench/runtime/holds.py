"""What is held at its value by the PLC's surroundings, not by people: inputs that are stuck, or come late.

It is in the force table of the image, like people's forces, so that in both engines it takes precedence over the plant and over
whatever is written. People's forces neither see nor release it; a bit is never both.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from scanbench.runtime.command import Entry, Freed, Held, Patch, Restarted, Swapped
from scanbench.runtime.journal import Fold, Journal


@dataclass(frozen=True, slots=True)
class HeldByte:
    """Bits of one byte."""

    number: int
    offset: int
    mask: int
    value: int
    since: int
    """Before which scan that began."""
    came: int = 0
    """Bits that somebody wrote meanwhile ..."""
    real: int = 0
    """... so: they count when it is freed."""
    at: int = -1
    """Before which scan they were written last."""


Helds = Mapping[str, HeldByte]


def held(journal: Journal) -> dict[int, int]:
    """Offset -> the bits that are held now."""
    bits: dict[int, int] = {}
    for each in journal.derived(HELD).values():
        bits[each.offset] = bits.get(each.offset, 0) | each.mask
    return bits


def holder(journal: Journal, patch: Patch) -> int:
    """The number of what holds any bit of a patch; 0: nothing does."""
    for each in journal.derived(HELD).values():
        if each.mask & _mask(patch, each.offset):
            return each.number
    return 0


def _mask(patch: Patch, offset: int) -> int:
    at = offset - patch.offset
    return patch.mask[at] if 0 <= at < len(patch.mask) else 0


def _step(helds: Helds, entry: Entry) -> Helds:
    effect = entry.plan.effect
    match effect:
        case Held(number, spots):
            more = {
                f"{number}.{offset}": HeldByte(number, offset, mask, value, entry.scan) for offset, mask, value in spots
            }
            return {**helds, **more} if more else helds
        case Freed(numbers):
            left = {key: each for key, each in helds.items() if each.number not in numbers}
            return helds if len(left) == len(helds) else left
        case Swapped():
            return {} if helds else helds
        case Restarted() if effect.kind != "warm":
            return {} if helds else helds
    changed = dict(_written(helds, entry)) if helds else {}
    return {**helds, **changed} if changed else helds


def _written(helds: Helds, entry: Entry) -> Iterator[tuple[str, HeldByte]]:
    """Those to which an entry gives a new value, which is seen later."""
    for key, each in helds.items():
        now = each
        for patch in entry.plan.patches:
            mask = each.mask & _mask(patch, each.offset)
            if mask:
                data = patch.data[each.offset - patch.offset]
                now = replace(now, came=now.came | mask, real=now.real & ~mask | data & mask, at=entry.scan)
        if now is not each:
            yield key, now


HELD: Fold[Helds] = Fold({}, _step)
"""What is held, by number and offset: `3.1042`."""
