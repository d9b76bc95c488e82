"""Modbus 22, mask write register: the bits of the mask, and no others, whatever the program did to these meanwhile."""

import asyncio
from collections.abc import Sequence

import pytest

from scanbench.comm.door import Read
from scanbench.comm.modbus.frame import Code, Request
from scanbench.comm.modbus.functions import Target, respond
from scanbench.comm.modbus.mapping import default
from scanbench.wire.memory import AreaSpan
from tests.comm.bench import LocalDoor, machine


class ChangingDoor(LocalDoor):
    """The program sets bit 7 of D0 in the scan after each read."""

    async def read(self, spans: Sequence[AreaSpan], also: Sequence[AreaSpan] = ()) -> Read:
        read = await super().read(spans, also)
        self.resource.memory[place(self)] |= 0x80
        return read


def place(door: LocalDoor) -> int:
    return door.resource.program.layout.areas["D"]


def mask(door: LocalDoor, register: int, both: int, either: int) -> Code | None:
    data = b"".join(each.to_bytes(2, "big") for each in (register, both, either))
    target = Target(door, default(door.model))
    answered, code = asyncio.run(respond(Request(1, 1, 22, data), target, False))
    assert code is not None or answered[8:] == data
    return code


@pytest.mark.parametrize(
    ("before", "both", "either", "after"),
    [
        (0x0000, 0xFFFE, 0x0001, 0x0001), (0x0012, 0x00F2, 0x0025, 0x0017), (0xFFFF, 0x7FFE, 0, 0x7FFE),
        (0x1234, 0xFFFF, 0xFFFF, 0x1234), (0x1234, 0, 0xABCD, 0xABCD),
    ],
)  # fmt: skip
def test_bits_of_the_mask_are_written(before: int, both: int, either: int, after: int) -> None:
    door = LocalDoor(machine())
    at = place(door)
    door.resource.memory[at : at + 2] = before.to_bytes(2, "little")
    assert mask(door, 0, both, either) is None
    assert int.from_bytes(door.resource.memory[at : at + 2], "little") == after


def test_what_the_program_does_to_other_bits_stays() -> None:
    door = ChangingDoor(machine())
    assert mask(door, 0, 0xFFFF, 0) is None  # reads, and the program sets bit 7
    assert mask(door, 0, 0xFFFE, 0x0001) is None
    assert door.resource.memory[place(door)] == 0x81


def test_a_register_that_is_not_there_is_refused() -> None:
    assert mask(LocalDoor(machine()), 0xFFFF, 0xFFFF, 0) is Code.ADDRESS
