"""Forces over FINS: 2301 forced set and reset, 2302 forced cancel."""

from scanbench.comm.door import Door
from scanbench.comm.fins.areas import Element, Form, element
from scanbench.comm.fins.codes import End, Refused
from scanbench.comm.fins.outcome import enter
from scanbench.runtime.forces import Force, ForceSeveral, Release

_ENTRY = 6
_HELD = {0x0000: "FALSE", 0x0001: "TRUE"}
_RELEASED = {0x8000: "FALSE", 0x8001: "TRUE", 0xFFFF: None}
"""What the bit is then; None: as it was."""


async def on_force(door: Door, body: bytes) -> bytes:
    """Bits that are set, reset or released, in one seam: all of them, or none."""
    count = int.from_bytes(body[:2], "big")
    if len(body) != 2 + count * _ENTRY:
        raise Refused(End.NOT_AS_MANY)
    changes = tuple(each for at in range(2, len(body), _ENTRY) for each in _changes(door, body[at : at + _ENTRY]))
    await _permitted(door)
    await enter(door, ForceSeveral(door.author, changes))
    return b""


async def on_force_cancel(door: Door, _body: bytes) -> bytes:
    """All forces are released, whoever made them, as at the device."""
    await _permitted(door)
    await enter(door, Release(door.author, None))
    return b""


async def _permitted(door: Door) -> None:
    if (await door.read(())).mode == "RUN":
        raise Refused(End.NOT_IN_RUN)


def _changes(door: Door, entry: bytes) -> tuple[Force | Release, ...]:
    what = int.from_bytes(entry[:2], "big")
    place = element(door.model, entry[2], int.from_bytes(entry[3:5], "big"), entry[5])
    path = _path(door, place)
    if what in _HELD:
        return (Force(door.author, path, _HELD[what]),)
    if what not in _RELEASED:
        raise Refused(End.PARAMETER)
    release, value = Release(door.author, path), _RELEASED[what]
    # A force gives its value at once, and that stays when it is released again in the same seam.
    return (release,) if value is None else (release, Force(door.author, path, value), release)


def _path(door: Door, place: Element) -> str:
    """The address of a bit of CIO, W or H; there are no flags of timers that could be forced."""
    if place.form is Form.UNUSED:
        raise Refused(End.CANNOT_CHANGE)
    if place.form is not Form.BIT or place.area is None or place.area.name not in ("CIO", "W", "H"):
        raise Refused(End.NO_AREA)
    place.spans(1)
    return door.model.format(place.area, 2 * place.word + place.bit // 8, place.bit % 8, 1)
