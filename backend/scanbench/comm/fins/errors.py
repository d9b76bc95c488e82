"""Errors and messages over FINS: 0920 messages, 2101 error clear, 2102 error log read, 2103 error log clear, 2140 and 2141 the
access log."""

from scanbench.comm.door import Door
from scanbench.comm.fins.areas import swapped
from scanbench.comm.fins.codes import End, Refused
from scanbench.comm.fins.outcome import enter
from scanbench.comm.fins.unit import padded
from scanbench.faults.clear import ClearErrorLog, ClearErrors
from scanbench.wire.memory import AreaSpan

_MESSAGES, _MESSAGE_SIZE = 8, 32
_CLEAR, _FAL = 0x4000, 0x8000
_FAL_FIRST, _FALS_FIRST = 0x4100, 0xC100
_FAL_SIZE = 16
_CURRENT, _ALL = 0xFFFE, 0xFFFF
_LOG_MOST = 0x14


async def on_message(door: Door, body: bytes) -> bytes:
    """Texts of MSG by a mask of eight bits, or the text of a FAL or FALS."""
    wanted = _word(body)
    if wanted & _FAL:
        return await _fal_text(door, wanted)
    if wanted & _CLEAR:  # the program shows them: it alone takes them back
        return b""
    mask = wanted & 0xFF
    told = {each.number: each.text for each in (await door.device()).messages}
    shown = [number for number in range(_MESSAGES) if mask >> number & 1]
    return mask.to_bytes(2, "big") + b"".join(padded(told.get(number, ""), _MESSAGE_SIZE) for number in shown)


async def _fal_text(door: Door, wanted: int) -> bytes:
    number = wanted & 0x1FFF
    device = await door.device()
    codes = {f"{first + number:04X}" for first in (_FAL_FIRST, _FALS_FIRST)}
    text = next((each.text for each in device.errors if each.code in codes), "")
    return wanted.to_bytes(2, "big") + padded(text, _FAL_SIZE)


async def on_error_clear(door: Door, body: bytes) -> bytes:
    """The most serious one, all of them, or that of a code; no error of such a code is no failure."""
    code = _word(body)
    if _CURRENT <= code <= _ALL:
        await enter(door, ClearErrors(door.author, "all" if code == _ALL else "current"), End.NOT_CLEARED)
        return b""
    shown = door.model.show_code(code)
    if any(each.code == shown for each in (await door.device()).errors):
        await enter(door, ClearErrors(door.author, code), End.NOT_CLEARED)
    return b""


async def on_log_read(door: Door, body: bytes) -> bytes:
    """Records of the error log, the oldest first: ten bytes each, as the memory has them."""
    if len(body) != 4:  # first, count
        raise Refused(End.TOO_SHORT)
    first, count = int.from_bytes(body[:2], "big"), int.from_bytes(body[2:], "big")
    log = door.model.log
    if log is None:
        raise Refused(End.UNDEFINED)
    size = 2 * log.words
    area = log.first.area.name
    read = await door.read([AreaSpan(area, log.counter.byte, 2), AreaSpan(area, log.first.byte, size * log.records)])
    stored = min(int.from_bytes(read.data[0], "little"), log.records)
    if first >= stored and first:
        raise Refused(End.ENDS_OUTSIDE)
    told = range(first, min(first + count, stored))
    records = b"".join(swapped(read.data[1][at * size : (at + 1) * size]) for at in told)
    return b"".join(each.to_bytes(2, "big") for each in (_LOG_MOST, stored, len(told))) + records


async def on_log_clear(door: Door, _body: bytes) -> bytes:
    """The log is empty."""
    await enter(door, ClearErrorLog(door.author))
    return b""


async def on_access_log_read(_door: Door, body: bytes) -> bytes:
    """Nobody keeps it here: it is empty."""
    if len(body) != 4:  # first, count
        raise Refused(End.TOO_SHORT)
    return _LOG_MOST.to_bytes(2, "big") + bytes(4)


async def on_access_log_clear(_door: Door, _body: bytes) -> bytes:
    """It is empty anyway."""
    return b""


def _word(body: bytes) -> int:
    if len(body) != 2:  # one word
        raise Refused(End.TOO_SHORT if len(body) < 2 else End.TOO_LONG)
    return int.from_bytes(body, "big")
