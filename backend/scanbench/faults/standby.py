"""The standby CPU Unit: when it takes over, what that writes, and how it comes back.

Both CPU Units run the same program on the same data. So an error of the hardware, or one raised at the simulator, is one of the
active CPU Unit alone: the standby goes on with the program. What the program itself runs into (a division by zero, its FALS)
happens in both: that stops it, as without a standby.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Literal

from scanbench.faults.details import Bits, Chosen, field_bits
from scanbench.faults.errorlog import clock_bytes
from scanbench.plcmodel.model import Location, Model, Standby
from scanbench.program.layout import Layout
from scanbench.runtime.command import Patch, View

Side = Literal["left", "right"]


def takes_over(view: View, fatal: Sequence[Chosen]) -> bool:
    """Whether the standby goes on in place of the CPU Unit that has these errors: it does so for all of them, or not at all."""
    standby = view.model.standby
    return (
        standby is not None
        and bool(fatal)
        and is_duplex(view.memory, view.program.layout)
        and all(standby.takes_over_for(one.error.id) for one in fatal)
    )


def is_duplex(memory: bytes | bytearray | memoryview, layout: Layout) -> bool:
    """Whether both CPU Units run; false where the device has one only."""
    standby = layout.model.standby
    return standby is not None and _is_on(memory, layout, standby.duplex)


def active_side(memory: bytes | bytearray | memoryview, layout: Layout, standby: Standby) -> Side:
    """Which CPU Unit controls."""
    return "right" if _is_on(memory, layout, standby.side) else "left"


def taken_over(view: View, fatal: Sequence[Chosen]) -> tuple[list[Patch], str]:
    """What says that the standby controls now: simplex, the other side, cause and time; and that as a sentence."""
    standby, layout = view.model.standby, view.program.layout
    assert standby is not None
    failed = active_side(view.memory, layout, standby)
    other: Side = "left" if failed == "right" else "right"
    ids = {one.error.id for one in fatal}
    on = {id: id in ids for id, _ in standby.causes}
    bits = [
        *_bit(standby.duplex, False, layout),
        *_bit(standby.side, other == "right", layout),
        *(part for id, place in standby.causes for part in _bit(place, on[id], layout)),
    ]
    patches = [Patch(part.offset, bytes((part.mask,)), bytes((part.value,))) for part in bits]
    if standby.time is not None:
        patches.append(Patch.whole(_offset(standby.time, layout), clock_bytes(view, standby.fields)))
    return patches, f"the standby takes over: simplex, the {other} CPU Unit controls"


def restored(view: View) -> tuple[list[Patch], str]:
    """What says that the CPU Unit which failed is the standby now; nothing where both run, or there is one only."""
    standby, layout = view.model.standby, view.program.layout
    if standby is None or is_duplex(view.memory, layout):
        return [], ""
    patches = [
        Patch(part.offset, bytes((part.mask,)), bytes((part.value,))) for part in _bit(standby.duplex, True, layout)
    ]
    side = active_side(view.memory, layout, standby)
    return patches, f"duplex again, the {side} CPU Unit controls"


def is_repaired(model: Model, off: Iterable[Chosen], left: Iterable[Chosen]) -> bool:
    """Whether with these errors the last one goes for which the standby takes over."""
    standby = model.standby
    if standby is None:
        return False
    return any(standby.takes_over_for(one.error.id) for one in off) and not any(
        standby.takes_over_for(one.error.id) for one in left
    )


def standby_bits(layout: Layout) -> list[Bits]:
    """All that says which CPU Unit controls, and why; nothing where the device has one only."""
    standby = layout.model.standby
    places = () if standby is None else standby.places
    return [part for place in places for part in field_bits(place, 0, place.bits, 0, layout)]


def watched_bits(model: Model, error: str, layout: Layout) -> list[Bits]:
    """The bits in which a program sees that the standby took over for an error."""
    standby = model.standby
    if standby is None or not standby.takes_over_for(error):
        return []
    places = [standby.duplex, standby.side, *(place for id, place in standby.causes if id == error)]
    found = [part for place in places for part in field_bits(place, 0, 1, 1, layout)]
    if standby.time is not None:
        bits = 8 * len(standby.fields)
        found += field_bits(standby.time, 0, bits, (1 << bits) - 1, layout)
    return found


def causes_on(memory: bytes | bytearray | memoryview, layout: Layout, standby: Standby) -> Iterator[str]:
    """The ids of the errors for which the standby took over last."""
    return (id for id, place in standby.causes if _is_on(memory, layout, place))


def _is_on(memory: bytes | bytearray | memoryview, layout: Layout, place: Location) -> bool:
    return bool(memory[_offset(place, layout)] >> (place.bit or 0) & 1)


def _offset(place: Location, layout: Layout) -> int:
    return layout.areas[place.area.name] + place.byte


def _bit(place: Location, on: bool, layout: Layout) -> Iterable[Bits]:
    return field_bits(place, 0, 1, int(on), layout)
