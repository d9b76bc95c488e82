"""What a CPU Unit says of itself, over FINS: 0501 unit data, 0502 connection data, 0601 status, 0201 to 0307 parameters and
program, 0801 loop back. (W342; layouts from libfins, and from answers of real devices in nmap's `omron-info`.)"""

from scanbench.comm.door import Door
from scanbench.comm.fins.codes import End, Refused
from scanbench.comm.fins.flags import FLAGS, has_flags
from scanbench.faults.device_shapes import DeviceErrors
from scanbench.wire.memory import AreaSpan

_MODEL, _VERSION = 20, b"04.10"
_FIRST, _REST = 92, 66
"""Bytes of the two parts of unit data."""
_RUNS = 0x01
_MODE_NUMBER = {"PROGRAM": 0, "MONITOR": 2, "RUN": 4}
_LAST = 0x8000
_TEXT = 16
"""Bytes of the text of FAL and FALS."""


async def on_unit_data(door: Door, body: bytes) -> bytes:
    """Both parts, or one of them."""
    data = _unit_data(door)
    if not body:
        return data
    if body[0] > 1:
        raise Refused(End.PARAMETER)
    return data[_FIRST:] if body[0] else data[:_FIRST]


def _unit_data(door: Door) -> bytes:
    """158 bytes: model, version, what is for the system, the sizes of memory, CPU Bus Units, racks."""
    model = door.model
    words = {area.name: area.words for area in model.areas}
    banks = sum(name.startswith("E") for name in words)
    system = bytes((8, banks - 1 if banks else 0)) + bytes(38)
    sizes = bytes((0, 20, 23)) + words.get("D", 0).to_bytes(2, "big") + bytes((8, banks)) + bytes(5)
    return _name(door) + _VERSION.ljust(_MODEL, b"\0") + system + sizes + bytes(_REST)


def _name(door: Door) -> bytes:
    """CJ1M_CPU13: CS1, CJ1 and CP1 write it so, CJ2 with a hyphen."""
    name = door.model.name
    return (
        (name if name.startswith("CJ2") else name.replace("-", "_")).encode("ascii", "replace")[:_MODEL].ljust(_MODEL)
    )


async def on_connection_data(door: Door, body: bytes) -> bytes:
    """The units with their models from a number on: there is the CPU Unit alone."""
    if not body:
        raise Refused(End.TOO_SHORT)
    if body[0]:
        return bytes((0x80,))
    return bytes((0x81, 0)) + _name(door)


async def on_status(door: Door, _body: bytes) -> bytes:
    """26 bytes: whether it runs, its mode, the flags of its errors, its messages, the most serious error with its text."""
    if not has_flags(door.model):
        raise Refused(End.UNDEFINED)
    read = await door.read([*FLAGS, AreaSpan("A", 800, 2)])
    device = await door.device()
    flags, code = read.data
    fatal, nonfatal = flags[1::-1], flags[3:1:-1]
    runs = read.mode != "PROGRAM" and not read.stopped
    shown = bytes((runs * _RUNS, _MODE_NUMBER[read.mode]))
    return shown + fatal + nonfatal + messages(device).to_bytes(2, "big") + code[::-1] + text_of_top(device)


def messages(device: DeviceErrors) -> int:
    """A bit for each of the eight messages that the program shows."""
    return sum(1 << each.number for each in device.messages if 0 <= each.number < 8)


def text_of_top(device: DeviceErrors) -> bytes:
    """The text of the error whose code is shown, where the program gave it one."""
    return padded(next((each.text for each in device.errors if each.top), ""), _TEXT)


def padded(text: str, size: int) -> bytes:
    """Characters of a frame, with spaces to their end."""
    return text.encode("ascii", "replace")[:size].ljust(size)


async def on_parameter_read(_door: Door, body: bytes) -> bytes:
    """Words of the PLC Setup and its like: all of them are 0, as the device is delivered."""
    if len(body) != 6:  # area, first, count
        raise Refused(End.TOO_SHORT)
    count = int.from_bytes(body[4:6], "big") & ~_LAST
    if count > 266:  # W342, section 5-3-7
        raise Refused(End.ANSWER_TOO_LONG)
    return body[:4] + (count | _LAST).to_bytes(2, "big") + bytes(2 * count)


async def on_parameter_write(_door: Door, _body: bytes) -> bytes:
    """Nothing here has parameters that could be written."""
    raise Refused(End.PROTECTED)


async def on_program_read(_door: Door, body: bytes) -> bytes:
    """There is no object code of the device: nothing, and that it is all."""
    if len(body) != 8:  # number, first, count
        raise Refused(End.TOO_SHORT)
    return body[:6] + _LAST.to_bytes(2, "big")


async def on_program_write(_door: Door, _body: bytes) -> bytes:
    """Programs come by a build."""
    raise Refused(End.CANNOT_CHANGE)


async def on_loop_back(_door: Door, body: bytes) -> bytes:
    """The same data."""
    return body
