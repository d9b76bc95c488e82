"""The functions of Modbus. (Application Protocol V1.1b3, section 6.)"""

from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from scanbench import __version__
from scanbench.comm.door import Away, Door
from scanbench.comm.modbus.frame import Code, Refused, Request, answer, failure
from scanbench.comm.modbus.mapping import Group, Mapped, Part, parts, words_of
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.wire.memory import AreaSpan

_MOST_BITS, _MOST_WORDS, _MOST_BITS_WRITTEN, _MOST_WORDS_WRITTEN = 2000, 125, 1968, 123
_UNITS = (0, 1, 255)
"""By which this PLC is meant; there is nothing else on the line."""
_ON = b"\xff\x00"


@dataclass(frozen=True, slots=True)
class Target:
    """The PLC that is asked, and what its registers mean."""

    door: Door
    table: tuple[Mapped, ...]


Handler = Callable[[Target, bytes], Awaitable[bytes]]


async def respond(request: Request, target: Target, read_only: bool) -> tuple[bytes, Code | None]:
    """The frame that answers a request, and the exception that it tells of, if one."""
    try:
        return answer(request, await _handled(request, target, read_only)), None
    except Refused as refused:
        return failure(request, refused.code), refused.code
    except Away:
        return failure(request, Code.FAILURE), Code.FAILURE


async def _handled(request: Request, target: Target, read_only: bool) -> bytes:
    if request.unit not in _UNITS:
        raise Refused(Code.NO_TARGET)
    handler = FUNCTIONS.get(request.function)
    if handler is None:
        raise Refused(Code.FUNCTION)
    if read_only and request.function in CHANGING:
        raise Refused(Code.FUNCTION)
    return await handler(target, request.data)


# ---- bits and words of memory ----------------------------------------------------------------------------------------


async def _read_bits(target: Target, group: Group, first: int, count: int) -> list[int]:
    found = list(_parts(target, group, first, count))
    spans = [AreaSpan(each.range.area, 2 * each.range.word + each.first // 8, _bytes(each)) for each in found]
    read = await target.door.read(spans)
    return [
        data[at // 8] >> at % 8 & 1
        for part, data in zip(found, read.data, strict=True)
        for at in range(part.first % 8, part.first % 8 + part.count)
    ]


def _bytes(part: Part) -> int:
    return (part.first + part.count - 1) // 8 - part.first // 8 + 1


async def _read_words(target: Target, group: Group, first: int, count: int) -> bytes:
    """As a frame has them, the high byte first."""
    found = list(_parts(target, group, first, count))
    spans: list[AreaSpan] = []
    for part in found:
        words = words_of(part)
        low = min(words)
        spans.append(AreaSpan(part.range.area, 2 * low, 2 * (max(words) - low + 1)))
    read = await target.door.read(spans)
    told = bytearray()
    for part, span, data in zip(found, spans, read.data, strict=True):
        for word in words_of(part):
            at = 2 * word - span.byte
            told += bytes((data[at + 1], data[at]))
    return bytes(told)


async def _write_bits(target: Target, first: int, values: list[int]) -> None:
    writes: list[AreaWrite] = []
    at = 0
    for part in _parts(target, "coil", first, len(values)):
        for bit in range(part.first, part.first + part.count):
            writes.append(AreaWrite(part.range.area, 2 * part.range.word + bit // 8, bytes((values[at],)), bit % 8))
            at += 1
    await _enter(target, writes)


async def _write_words(target: Target, first: int, data: bytes) -> None:
    """Registers that follow each other in memory are one write."""
    writes: list[AreaWrite] = []
    at = 0
    for part in _parts(target, "holding register", first, len(data) // 2):
        for word in words_of(part):
            value = data[at + 1 : at + 2] + data[at : at + 1]
            last = writes[-1] if writes else None
            if last is not None and last.area == part.range.area and last.byte + len(last.data) == 2 * word:
                writes[-1] = AreaWrite(last.area, last.byte, last.data + value)
            else:
                writes.append(AreaWrite(part.range.area, 2 * word, value))
            at += 2
    await _enter(target, writes)


async def _enter(target: Target, writes: list[AreaWrite]) -> None:
    done = await target.door.submit(WriteAreas(target.door.author, tuple(writes)))
    if not done.ok:
        raise Refused(Code.ADDRESS)


def _parts(target: Target, group: Group, first: int, count: int) -> list[Part]:
    found = parts(target.table, group, first, count)
    if found is None:
        raise Refused(Code.ADDRESS)
    return list(found)


def _two(data: bytes, most: int, exact: bool = True) -> tuple[int, int]:
    """An address and a count."""
    if len(data) < 4 or (exact and len(data) != 4):  # two words
        raise Refused(Code.VALUE)
    first, count = int.from_bytes(data[:2], "big"), int.from_bytes(data[2:4], "big")
    if not 1 <= count <= most:
        raise Refused(Code.VALUE)
    return first, count


def _packed(bits: list[int]) -> bytes:
    data = bytearray((len(bits) + 7) // 8)
    for at, bit in enumerate(bits):
        data[at // 8] |= bit << at % 8
    return bytes((len(data),)) + bytes(data)


# ---- functions -------------------------------------------------------------------------------------------------------


async def on_read_coils(target: Target, data: bytes) -> bytes:
    """01."""
    return _packed(await _read_bits(target, "coil", *_two(data, _MOST_BITS)))


async def on_read_discrete_inputs(target: Target, data: bytes) -> bytes:
    """02."""
    return _packed(await _read_bits(target, "discrete input", *_two(data, _MOST_BITS)))


async def on_read_holding_registers(target: Target, data: bytes) -> bytes:
    """03."""
    words = await _read_words(target, "holding register", *_two(data, _MOST_WORDS))
    return bytes((len(words),)) + words


async def on_read_input_registers(target: Target, data: bytes) -> bytes:
    """04."""
    words = await _read_words(target, "input register", *_two(data, _MOST_WORDS))
    return bytes((len(words),)) + words


async def on_write_coil(target: Target, data: bytes) -> bytes:
    """05: FF00 is on, 0000 is off."""
    if len(data) != 4 or data[2:] not in (_ON, b"\0\0"):  # two words
        raise Refused(Code.VALUE)
    await _write_bits(target, int.from_bytes(data[:2], "big"), [int(data[2:] == _ON)])
    return data


async def on_write_register(target: Target, data: bytes) -> bytes:
    """06."""
    if len(data) != 4:  # two words
        raise Refused(Code.VALUE)
    await _write_words(target, int.from_bytes(data[:2], "big"), data[2:])
    return data


async def on_write_coils(target: Target, data: bytes) -> bytes:
    """15."""
    first, count = _two(data, _MOST_BITS_WRITTEN, exact=False)
    packed = data[5:]
    if len(packed) != (count + 7) // 8 or data[4] != len(packed):
        raise Refused(Code.VALUE)
    await _write_bits(target, first, [packed[at // 8] >> at % 8 & 1 for at in range(count)])
    return data[:4]


async def on_write_registers(target: Target, data: bytes) -> bytes:
    """16."""
    first, count = _two(data, _MOST_WORDS_WRITTEN, exact=False)
    if len(data) != 5 + 2 * count or data[4] != 2 * count:
        raise Refused(Code.VALUE)
    await _write_words(target, first, data[5:])
    return data[:4]


async def on_mask_register(target: Target, data: bytes) -> bytes:
    """22: what is there AND the first mask, OR the second one where the first is 0.

    Only the bits whose first mask is 0 are written: the others are the program's, which may change them in any scan.
    """
    if len(data) != 6:  # three words
        raise Refused(Code.VALUE)
    first, both, either = (int.from_bytes(data[at : at + 2], "big") for at in (0, 2, 4))
    (part,) = _parts(target, "holding register", first, 1)
    (word,) = words_of(part)
    writes = [
        AreaWrite(part.range.area, 2 * word + bit // 8, bytes((either >> bit & 1,)), bit % 8)
        for bit in range(16)
        if not both >> bit & 1
    ]
    if writes:
        await _enter(target, writes)
    else:
        await _read_words(target, "holding register", first, 1)  # whether the PLC answers
    return data


async def on_read_and_write_registers(target: Target, data: bytes) -> bytes:
    """23: the write comes first."""
    first, count = _two(data, _MOST_WORDS, exact=False)
    to, written = _two(data[4:], 121, exact=False)
    if len(data) != 9 + 2 * written or data[8] != 2 * written:
        raise Refused(Code.VALUE)
    _parts(target, "holding register", first, count)
    await _write_words(target, to, data[9:])
    words = await _read_words(target, "holding register", first, count)
    return bytes((len(words),)) + words


async def on_identification(target: Target, data: bytes) -> bytes:
    """43/14: vendor, product, revision."""
    if len(data) != 3 or data[0] != 14 or not 1 <= data[1] <= 4:
        raise Refused(Code.FUNCTION if not data or data[0] != 14 else Code.VALUE)
    objects = {0: "Scanbench", 1: target.door.model.name, 2: __version__}
    single = data[1] == 4  # one object
    if single and data[2] not in objects:
        raise Refused(Code.ADDRESS)
    told = {data[2]: objects[data[2]]} if single else {id: text for id, text in objects.items() if id >= data[2]}
    packed = b"".join(
        bytes((id, len(text))) + text.encode("ascii", "replace") for id, text in (told or objects).items()
    )
    return bytes((14, data[1], 0x81, 0, 0, len(told or objects))) + packed


FUNCTIONS: Mapping[int, Handler] = MappingProxyType({
    1: on_read_coils, 2: on_read_discrete_inputs, 3: on_read_holding_registers, 4: on_read_input_registers,
    5: on_write_coil, 6: on_write_register, 15: on_write_coils, 16: on_write_registers, 22: on_mask_register,
    23: on_read_and_write_registers, 43: on_identification,
})  # fmt: skip
CHANGING = frozenset({5, 6, 15, 16, 22, 23})
NAMES: Mapping[int, str] = MappingProxyType({
    1: "read coils", 2: "read discrete inputs", 3: "read holding registers", 4: "read input registers", 5: "write coil",
    6: "write register", 15: "write coils", 16: "write registers", 22: "mask write register",
    23: "read and write registers", 43: "read device identification",
})  # fmt: skip
OUTCOMES: Mapping[Code, str] = MappingProxyType({
    Code.FUNCTION: "this function is not there, or this server lets clients read only",
    Code.ADDRESS: "an address means nothing, or cannot be written",
    Code.VALUE: "a count or a length is wrong",
    Code.FAILURE: "the PLC does not answer now",
    Code.NO_TARGET: "no such unit: it is 0, 1 or 255",
})  # fmt: skip


def described(request: Request) -> str:
    """`read holding registers 100, 2`."""
    name = NAMES.get(request.function, f"function {request.function}")
    data = request.data
    if request.function not in NAMES or request.function == 43 or len(data) < 4:
        return name
    first, second = int.from_bytes(data[:2], "big"), int.from_bytes(data[2:4], "big")
    return f"{name} {first}" if request.function in (5, 6, 22) else f"{name} {first}, {second}"


def outcome(code: Code | None) -> str:
    """Empty where it was done."""
    return "" if code is None else f"{code:02X} {OUTCOMES[code]}"
