"""The commands of SLMP that a CPU module answers here. (SH-080008, chapter 8.)"""

from collections.abc import Awaitable, Callable, Mapping
from types import MappingProxyType

from scanbench.comm.door import Away, Door
from scanbench.comm.slmp.devices import Device, read_device
from scanbench.comm.slmp.frame import Broken, Cursor, End, NoDigits, Refused, Request, answer, failure, number
from scanbench.faults.clear import ClearErrors
from scanbench.runtime.command import Command
from scanbench.runtime.modes import SetMode
from scanbench.runtime.restart import Restart
from scanbench.runtime.write_areas import AreaWrite, WriteAreas

_OWN = (0, 0xFF, 0x03FF, 0)
"""The route to the CPU module that is connected."""
_MOST_WORDS, _MOST_BITS, _MOST_RANDOM = 960, 7168, 192
_MOST_RANDOM_BITS, _MOST_RANDOM_WRITTEN, _WORD, _DOUBLE = 188, 1920, 12, 14
"""Of 1402: at most so many bits; and 12 for a word and 14 for a double word are together at most 1920 (MELSEC Communication Protocol
Reference Manual SH(NA)-080008, random write)."""
_WORDS, _BITS = 0, 1
"""Subcommands."""
_MODEL_CODES = {"Q03UD": 0x0268}
_MODEL_NAME = 16

Handler = Callable[[Door, Request, Cursor], Awaitable[bytes]]


async def respond(request: Request, door: Door, read_only: bool) -> tuple[bytes, End]:
    """The frame that answers a request, and its end code."""
    try:
        return answer(request, await _handled(request, door, read_only)), End.OK
    except Refused as refused:
        end = refused.code
    except NoDigits:
        end = End.NOT_HEXADECIMAL
    except Broken:
        end = End.LENGTH
    except Away:
        end = End.AWAY
    return failure(request, end), end


async def _handled(request: Request, door: Door, read_only: bool) -> bytes:
    if request.route != _OWN:
        raise Refused(End.NO_STATION)
    handler = COMMANDS.get(request.command)
    if handler is None:
        raise Refused(End.COMMAND)
    if read_only and request.command in CHANGING:
        raise Refused(End.CANNOT)
    cursor = Cursor(request.data, request.ascii)
    return await handler(door, request, cursor)


async def _enter(door: Door, command: Command) -> None:
    done = await door.submit(command)
    if not done.ok:
        raise Refused(End.CANNOT)


def _finished(cursor: Cursor) -> None:
    if cursor.left:
        raise Refused(End.LENGTH)


# ---- devices ---------------------------------------------------------------------------------------------------------


async def on_read(door: Door, request: Request, cursor: Cursor) -> bytes:
    """0401: words, or bits."""
    device, count = read_device(door.model, cursor), cursor.number(2)
    _finished(cursor)
    if request.sub == _WORDS:
        _at_most(count, _MOST_WORDS)
        (data,) = (await door.read([device.words(count)])).data
        return _words(_shifted(device, data, count), request.ascii)
    _sub(request)
    _at_most(count, _MOST_BITS)
    (data,) = (await door.read([device.bits(count)])).data
    start = device.number % 8
    return _packed([data[at // 8] >> at % 8 & 1 for at in range(start, start + count)], request.ascii)


def _shifted(device: Device, data: bytes, count: int) -> bytes:
    """So many words of what was read; bits may begin anywhere."""
    if not device.is_bit:
        return data
    value = int.from_bytes(data, "little") >> device.number % 8
    return (value & (1 << 16 * count) - 1).to_bytes(2 * count, "little")


def _words(data: bytes, ascii: bool) -> bytes:
    if not ascii:
        return data
    return b"".join(number(int.from_bytes(data[at : at + 2], "little"), 2, True) for at in range(0, len(data), 2))


def _packed(bits: list[int], ascii: bool) -> bytes:
    """In binary code two bits a byte, the first one high."""
    if ascii:
        return "".join(map(str, bits)).encode()
    padded = [*bits, 0] if len(bits) % 2 else bits
    return bytes(padded[at] << 4 | padded[at + 1] for at in range(0, len(padded), 2))


async def on_write(door: Door, request: Request, cursor: Cursor) -> bytes:
    """1401: words, or bits."""
    device, count = read_device(door.model, cursor), cursor.number(2)
    if request.sub == _WORDS:
        _at_most(count, _MOST_WORDS)
        data = b"".join(cursor.number(2).to_bytes(2, "little") for _ in range(count))
        writes = _word_writes(device, data)
    else:
        _sub(request)
        _at_most(count, _MOST_BITS)
        writes = _bit_writes(device, _bits(cursor, count))
    _finished(cursor)
    await _enter(door, WriteAreas(door.author, tuple(writes)))
    return b""


def _bits(cursor: Cursor, count: int) -> list[int]:
    if cursor.ascii:
        digits = cursor.take(count)
        if digits.strip(b"01"):
            raise Refused(End.DATA)
        return [each - ord("0") for each in digits]
    packed = cursor.take((count + 1) // 2)
    halves = [half for byte in packed for half in (byte >> 4, byte & 15)][:count]
    if any(half > 1 for half in halves):
        raise Refused(End.DATA)
    return halves


def _word_writes(device: Device, data: bytes) -> list[AreaWrite]:
    if device.is_bit and device.number % 8:
        return _bit_writes(device, [data[at // 8] >> at % 8 & 1 for at in range(8 * len(data))])
    span = device.words(len(data) // 2)
    return [AreaWrite(span.area, span.byte, data)]


def _bit_writes(device: Device, bits: list[int]) -> list[AreaWrite]:
    device.bits(len(bits))
    return [AreaWrite(device.area.name, at // 8, bytes((bit,)), at % 8) for at, bit in enumerate(bits, device.number)]


async def on_random_read(door: Door, request: Request, cursor: Cursor) -> bytes:
    """0403: words and double words from here and there, all of one scan."""
    if request.sub != _WORDS:
        raise Refused(End.COMMAND)
    words, doubles = cursor.number(1), cursor.number(1)
    _at_most(words + doubles, _MOST_RANDOM)
    sizes = [1] * words + [2] * doubles
    devices = [read_device(door.model, cursor) for _ in sizes]
    _finished(cursor)
    read = await door.read([device.words(size) for device, size in zip(devices, sizes, strict=True)])
    told = bytearray()
    for device, size, data in zip(devices, sizes, read.data, strict=True):
        value = int.from_bytes(_shifted(device, data, size), "little")
        told += number(value, 2 * size, request.ascii)
    return bytes(told)


async def on_random_write(door: Door, request: Request, cursor: Cursor) -> bytes:
    """1402: words and double words, or bits, here and there; all of them or none."""
    writes: list[AreaWrite] = []
    if request.sub == _WORDS:
        words, doubles = cursor.number(1), cursor.number(1)
        _at_most(_WORD * words + _DOUBLE * doubles, _MOST_RANDOM_WRITTEN)
        for size in [2] * words + [4] * doubles:
            device = read_device(door.model, cursor)
            writes += _word_writes(device, cursor.number(size).to_bytes(size, "little"))
    else:
        _sub(request)
        count = cursor.number(1)
        _at_most(count, _MOST_RANDOM_BITS)
        for _ in range(count):
            device, bit = read_device(door.model, cursor), cursor.number(1)
            if bit > 1:
                raise Refused(End.DATA)
            writes += _bit_writes(device, [bit])
    _finished(cursor)
    await _enter(door, WriteAreas(door.author, tuple(writes)))
    return b""


def _at_most(count: int, most: int) -> None:
    if not 1 <= count <= most:
        raise Refused(End.TOO_MANY)


def _sub(request: Request) -> None:
    if request.sub != _BITS:
        raise Refused(End.COMMAND)


# ---- the module ------------------------------------------------------------------------------------------------------


async def on_model(door: Door, request: Request, cursor: Cursor) -> bytes:
    """0101: the name of the CPU module, and its code."""
    _finished(cursor)
    name = door.model.name
    shown = (name if name.endswith("CPU") else f"{name}CPU").encode("ascii", "replace")[:_MODEL_NAME].ljust(_MODEL_NAME)
    return shown + number(_MODEL_CODES.get(name, 0), 2, request.ascii)


async def on_self_test(_door: Door, request: Request, cursor: Cursor) -> bytes:
    """0619: the same data."""
    count = cursor.number(2)
    data = cursor.rest()
    if count != len(data):
        raise Refused(End.LENGTH)
    return number(count, 2, request.ascii) + data


async def on_remote_run(door: Door, _request: Request, _cursor: Cursor) -> bytes:
    """1001: the program runs, and tools may write."""
    await _enter(door, SetMode(door.author, "MONITOR"))
    return b""


async def on_remote_stop(door: Door, _request: Request, _cursor: Cursor) -> bytes:
    """1002."""
    await _enter(door, SetMode(door.author, "PROGRAM"))
    return b""


async def on_remote_reset(door: Door, _request: Request, _cursor: Cursor) -> bytes:
    """1006: only while it is stopped."""
    if (await door.read(())).mode != "PROGRAM":
        raise Refused(End.CANNOT)
    await _enter(door, Restart(door.author, "power"))
    return b""


async def on_clear_error(door: Door, _request: Request, _cursor: Cursor) -> bytes:
    """1617: all errors whose cause is gone."""
    await _enter(door, ClearErrors(door.author, "all"))
    return b""


COMMANDS: Mapping[int, Handler] = MappingProxyType({
    0x0401: on_read, 0x1401: on_write, 0x0403: on_random_read, 0x1402: on_random_write, 0x0101: on_model,
    0x0619: on_self_test, 0x1001: on_remote_run, 0x1002: on_remote_stop, 0x1006: on_remote_reset, 0x1617: on_clear_error,
})  # fmt: skip
CHANGING = frozenset({0x1401, 0x1402, 0x1001, 0x1002, 0x1006, 0x1617})
NAMES: Mapping[int, str] = MappingProxyType({
    0x0401: "batch read", 0x1401: "batch write", 0x0403: "random read", 0x1402: "random write", 0x0101: "read CPU model",
    0x0619: "self test", 0x1001: "remote run", 0x1002: "remote stop", 0x1006: "remote reset", 0x1617: "clear errors",
})  # fmt: skip
OUTCOMES: Mapping[End, str] = MappingProxyType({
    End.NO_STATION: "no such station: network 0, PC 255, module I/O 03FF, station 0 is this CPU module",
    End.NOT_HEXADECIMAL: "a number has characters that are no digits",
    End.TOO_MANY: "no device, or too many",
    End.OUTSIDE: "the last device is outside of the area",
    End.COMMAND: "the module does not know this command",
    End.CANNOT: "the device does not exist, or cannot be written now",
    End.DATA: "the data do not fit the device",
    End.LENGTH: "the request is too long or too short",
    End.AWAY: "the PLC does not answer now",
})  # fmt: skip


def described(request: Request, door: Door) -> str:
    """`batch read D100, 3`."""
    name = NAMES.get(request.command, f"command {request.command:04X}")
    if request.command not in (0x0401, 0x1401):
        return name
    cursor = Cursor(request.data, request.ascii)
    try:
        device, count = read_device(door.model, cursor), cursor.number(2)
        bit = device.is_bit
        byte = device.number // 8 if bit else 2 * device.number
        device.words(1)
        shown = door.model.format(device.area, byte, device.number % 8 if bit else None, 1 if bit else 16)
        return f"{name} {shown}, {count}"
    except (Refused, Broken):
        return name


def outcome(end: End) -> str:
    """Empty for a normal end."""
    return f"{end:04X} {OUTCOMES[end]}" if end else ""
