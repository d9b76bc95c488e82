"""Wires between a plant that is a server of Modbus and the memory of a PLC: as somebody sets them, and what they mean."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.comm.modbus.ask import MOST_BITS, MOST_BITS_WRITTEN, MOST_WORDS, MOST_WORDS_WRITTEN, WRITES, is_bits
from scanbench.comm.modbus.mapping import Group
from scanbench.plcmodel.areas import Location
from scanbench.plcmodel.model import Model
from scanbench.public import Public
from scanbench.runtime.write_areas import AreaWrite
from scanbench.wire.memory import AreaSpan
from scanbench.wire.refused import Refused

MOST_RANGES, MOST_WIRES = 64, 4096
_ADDRESSES = 1 << 16
_WORD = 16
_EVERY_MS = range(10, 60_001)
_PORTS, _UNITS = range(1, 1 << 16), range(256)


@dataclass(frozen=True, slots=True)
class PlantRange(Public):
    """Coils or registers of the plant that follow each other, and the memory of the PLC that they are wired to."""

    PUBLIC: ClassVar = "PlantRange"
    GIVEN: ClassVar = True

    group: Group
    first: int
    """Counted from 0."""
    count: int
    address: str
    """Of the first one, in the PLC: a bit for coils and discrete inputs, else a word."""
    to: Literal["plc", "plant"] = "plc"
    """Who gets the value. Discrete inputs and input registers can only go to the PLC."""


@dataclass(frozen=True, slots=True)
class PlantWanted(Public):
    """A plant that is a server of Modbus TCP, as somebody sets it."""

    PUBLIC: ClassVar = "PlantSettings"
    GIVEN: ClassVar = True

    on: bool = False
    host: str = "127.0.0.1"
    """Where the plant is: an address, or the name of a machine."""
    port: int = 502
    unit: int = 1
    every_ms: int = 50
    """How often values are exchanged."""
    lost: Literal["keep", "clear"] = "keep"
    """What inputs do while the plant does not answer: they keep the last value, or are 0."""
    answers: str = ""
    """A bit of the PLC that is on while the plant answers; empty: none."""
    ranges: tuple[PlantRange, ...] = ()


@dataclass(frozen=True, slots=True)
class Wires:
    """A range, as the PLC has it."""

    group: Group
    first: int
    count: int
    area: str
    bit: int
    """The first one's, counted in the area from bit 0 of its first byte on."""
    to_plant: bool

    @property
    def bits(self) -> bool:
        """Whether these are bits; else they are words."""
        return is_bits(self.group)

    @property
    def span(self) -> AreaSpan:
        """The bytes in which they lie."""
        return AreaSpan(self.area, self.bit // 8, _bytes(self.bit % 8, self.count) if self.bits else 2 * self.count)

    def pieces(self) -> Iterator["Wires"]:
        """As many of them as a request can have."""
        most = (
            (MOST_BITS_WRITTEN if self.bits else MOST_WORDS_WRITTEN)
            if self.to_plant
            else (MOST_BITS if self.bits else MOST_WORDS)
        )
        size = 1 if self.bits else _WORD
        for at in range(0, self.count, most):
            count = min(most, self.count - at)
            yield Wires(self.group, self.first + at, count, self.area, self.bit + at * size, self.to_plant)

    def writes(self, data: bytes) -> Iterator[AreaWrite]:
        """What writes the values of an answer into the PLC. Whole bytes of bits are written at once."""
        if not self.bits:
            yield AreaWrite(self.area, self.bit // 8, _turned(data))
            return
        at, whole = 0, int.from_bytes(data, "little")
        while at < self.count:
            byte, bit = divmod(self.bit + at, 8)
            size = (self.count - at) // 8 if bit == 0 else 0
            if size:
                yield AreaWrite(self.area, byte, (whole >> at).to_bytes(len(data) + 1, "little")[:size])
                at += 8 * size
            else:
                yield AreaWrite(self.area, byte, bytes((whole >> at & 1,)), bit)
                at += 1

    def values(self, data: bytes) -> bytes:
        """What a request has of the bytes of `span`."""
        if not self.bits:
            return _turned(data)
        bits = int.from_bytes(data, "little") >> self.bit % 8 & (1 << self.count) - 1
        return bits.to_bytes(_bytes(0, self.count), "little")


def _bytes(bit: int, count: int) -> int:
    return (bit + count + 7) // 8


def _turned(data: bytes) -> bytes:
    """Words with the low byte first of those with the high byte first, and the other way round."""
    turned = bytearray(len(data))
    turned[0::2], turned[1::2] = data[1::2], data[0::2]
    return bytes(turned)


def wires(model: Model, wanted: PlantWanted) -> tuple[Wires, ...]:
    """What the settings of a plant mean on a model. `Refused`."""
    if not wanted.host.strip():
        raise Refused("the plant needs an address: 127.0.0.1 is this machine")
    if wanted.port not in _PORTS:
        raise Refused(f"port {wanted.port} of the plant is outside of {_PORTS[0]} to {_PORTS[-1]}")
    if wanted.unit not in _UNITS:
        raise Refused(f"unit {wanted.unit} of the plant is outside of {_UNITS[0]} to {_UNITS[-1]}")
    if wanted.every_ms not in _EVERY_MS:
        raise Refused(f"an interval of {wanted.every_ms} ms is outside of {_EVERY_MS[0]} to {_EVERY_MS[-1]} ms")
    if len(wanted.ranges) > MOST_RANGES:
        raise Refused(f"{len(wanted.ranges)} ranges are more than {MOST_RANGES}")
    if sum(each.count for each in wanted.ranges) > MOST_WIRES:
        raise Refused(f"a plant can have up to {MOST_WIRES} coils and registers in all")
    return tuple(_wires(model, number, each) for number, each in enumerate(wanted.ranges, 1))


def answers_bit(model: Model, wanted: PlantWanted) -> AreaWrite | None:
    """What says that the plant answers; None: nothing is to. `Refused`."""
    if not wanted.answers.strip():
        return None
    place = _place(model, "plant answers", wanted.answers, 1)
    assert place.bit is not None
    _refuse_read_only(model, "plant answers", place, 1)
    return AreaWrite(place.area.name, place.byte, b"\1", place.bit)


def _wires(model: Model, number: int, wanted: PlantRange) -> Wires:
    where, bits = f"range {number}", is_bits(wanted.group)
    last = wanted.first + wanted.count - 1
    if wanted.first < 0 or wanted.count < 1 or last >= _ADDRESSES:
        raise Refused(f"{where}: {wanted.group} {wanted.first} to {last} is outside of 0 to {_ADDRESSES - 1}")
    to_plant = wanted.to == "plant"
    if to_plant and wanted.group not in WRITES:
        raise Refused(f"{where}: a {wanted.group} of a plant can only be read")
    place = _place(model, where, wanted.address, 1 if bits else _WORD)
    bit = 8 * place.byte + (place.bit or 0)
    end = bit + wanted.count * place.bits
    if end > 8 * place.area.size:
        raise Refused(f"{where}: {wanted.count} from {wanted.address} on do not fit into {place.area.name}")
    if not to_plant:
        _refuse_read_only(model, where, place, end // 8 - place.byte)
    return Wires(wanted.group, wanted.first, wanted.count, place.area.name, bit, to_plant)


def _place(model: Model, where: str, address: str, bits: int) -> Location:
    place = model.locate(address)
    if place is None:
        raise Refused(f"{where}: {model.why_not(address)}")
    if place.bits != bits or (bits == _WORD and (place.bit or place.byte % 2)):
        needed = "a bit" if bits == 1 else "a word"
        raise Refused(f"{where}: {address} has {place.bits} bits, and {needed} is needed")
    return place


def _refuse_read_only(model: Model, where: str, place: Location, size: int) -> None:
    word = place.area.protected(place.byte, size, "tool")
    if word is not None:
        raise Refused(f"{where}: {model.word_text(place.area, 2 * word)} is read-only for tools on {model.name}")


def cleared(found: Sequence[Wires]) -> list[AreaWrite]:
    """What sets every input to 0."""
    return [
        write for each in found if not each.to_plant for write in each.writes(bytes(2 * each.count))
    ]  # fmt: skip
