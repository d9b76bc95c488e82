"""How the PLC runs, over FINS: 0401 run, 0402 stop, 0620 cycle time, 0701 and 0702 the clock, 0C01 to 0C03 the access right."""

from datetime import UTC, datetime

from scanbench.comm.door import Door
from scanbench.comm.fins.codes import End, Refused
from scanbench.comm.fins.outcome import enter
from scanbench.plcmodel.model import Special
from scanbench.runtime.modes import SetMode
from scanbench.runtime.set_clock import SetClock
from scanbench.wire.memory import AreaSpan

_MODES = {2: "MONITOR", 4: "RUN"}
_CYCLE_READ = 1
_CENTURY = 98
"""Years from here on are of the twentieth century. (W342, section 5-3-19.)"""


async def on_run(door: Door, body: bytes) -> bytes:
    """MONITOR or RUN; MONITOR where it is not said."""
    mode = _MODES.get(body[2], "") if len(body) > 2 else "MONITOR"  # after two bytes of program number
    if not mode:
        raise Refused(End.PARAMETER)
    await enter(door, SetMode(door.author, mode), End.NOT_NOW)
    return b""


async def on_stop(door: Door, _body: bytes) -> bytes:
    """PROGRAM."""
    await enter(door, SetMode(door.author, "PROGRAM"), End.NOT_NOW)
    return b""


async def on_cycle_time(door: Door, body: bytes) -> bytes:
    """Average, longest and shortest cycle time, in 0.1 ms: as the PLC's own memory has them. It has no average and no shortest,
    so the present one is told for both. A reset is taken, and the longest stays what the memory says."""
    if len(body) != 1:
        raise Refused(End.TOO_SHORT if not body else End.TOO_LONG)
    if body[0] != _CYCLE_READ:
        if body[0]:
            raise Refused(End.PARAMETER)
        return b""
    present, longest = (_special(door, role) for role in ("cycle-time", "longest-cycle-time"))
    read = await door.read([_span(present), _span(longest)])
    if read.mode == "PROGRAM":
        raise Refused(End.NOT_IN_PROGRAM)
    now, most = (int.from_bytes(data, "little").to_bytes(4, "big") for data in read.data)
    return now + most + now


def _special(door: Door, role: str) -> Special:
    found = next((each for each in door.model.specials if each.role == role), None)
    if found is None:
        raise Refused(End.UNDEFINED)
    return found


def _span(special: Special) -> AreaSpan:
    place = special.location
    return AreaSpan(place.area.name, place.byte, 4)


async def on_clock_read(door: Door, _body: bytes) -> bytes:
    """Year, month, day, hour, minute, second and weekday as BCD; 0 is Sunday."""
    now = (await door.read(())).clock
    values = (now.year % 100, now.month, now.day, now.hour, now.minute, now.second, (now.weekday() + 1) % 7)
    return bytes(_bcd(value) for value in values)


async def on_clock_write(door: Door, body: bytes) -> bytes:
    """The same; seconds and weekday may be left out, and nobody asks whether the weekday is right."""
    least, most = 5, 7
    if not least <= len(body) <= most:
        raise Refused(End.TOO_SHORT if len(body) < least else End.TOO_LONG)
    values = [_decimal(byte) for byte in body]
    year, month, day, hour, minute = values[:least]
    second = values[least] if len(values) > least else 0
    try:
        at = datetime(year + (1900 if year >= _CENTURY else 2000), month, day, hour, minute, second, tzinfo=UTC)
    except ValueError:
        raise Refused(End.PARAMETER) from None
    await enter(door, SetClock(door.author, at))
    return b""


def _bcd(value: int) -> int:
    return value // 10 << 4 | value % 10


def _decimal(byte: int) -> int:
    high, low = byte >> 4, byte & 15
    if max(high, low) > 9:  # digits
        raise Refused(End.PARAMETER)
    return 10 * high + low


async def on_access_right(_door: Door, _body: bytes) -> bytes:
    """Taken, forced or released: every client has all rights here, as no request needs it."""
    return b""
