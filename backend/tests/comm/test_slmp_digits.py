"""Numbers of SLMP in ASCII code: what is no digit is refused, whatever Python would take as a number."""

import asyncio

import pytest

from scanbench.comm.slmp.commands import described, respond
from scanbench.comm.slmp.frame import End, Request
from tests.comm.bench import LocalDoor, machine

READ, WRITE, RANDOM_READ, RANDOM_WRITE, SELF_TEST = 0x0401, 0x1401, 0x0403, 0x1402, 0x0619


def ask(door: LocalDoor, command: int, sub: int, data: str) -> tuple[bytes, End]:
    request = Request(True, (0, 0xFF, 0x03FF, 0), command, sub, data.encode("latin-1"))
    described(request, door)
    frame, end = asyncio.run(respond(request, door, False))
    return frame[22:], end


@pytest.mark.parametrize(
    ("command", "sub", "data"),
    [
        (WRITE, 0, "D*0001000001-001"), (WRITE, 0, "D*0001000001+00F"), (WRITE, 0, "D*0001000001 0xF"),
        (WRITE, 0, "D*00010000011__0"), (WRITE, 0, "D*000100000100 F"), (WRITE, 0, "D*0001000001\u00b2\u00b20F"),
        (WRITE, 0, "D*-0000100010005"), (WRITE, 0, "D*000100-0010005"), (READ, 0, "D*-000010001"),
        (READ, 0, "D*1_0_000001"), (READ, 0, "D* 000100001"), (READ, 0, "D*00001A0001"), (READ, 0, "W*0x00010001"),
        (READ, 1, "M*-000160002"), (RANDOM_READ, 0, "-102D*000100"), (RANDOM_WRITE, 0, "0001D*000100-0000001"),
        (RANDOM_WRITE, 1, "01M*000100-1"), (SELF_TEST, 0, "-001ABCD"),
    ],
)  # fmt: skip
def test_what_is_no_digit_is_refused_and_changes_nothing(command: int, sub: int, data: str) -> None:
    door = LocalDoor(machine("Q03UD"))
    before = bytes(door.resource.memory)
    assert ask(door, command, sub, data)[1] is End.NOT_HEXADECIMAL
    assert bytes(door.resource.memory) == before


def test_digits_are_read_in_the_base_of_the_device() -> None:
    door = LocalDoor(machine("Q03UD"))
    assert ask(door, WRITE, 0, "D*0001000001001F") == (b"", End.OK)
    assert ask(door, READ, 0, "D*0001000001") == (b"001F", End.OK)
    assert ask(door, WRITE, 0, "W*00001a00010020")[1] is End.OK
    assert ask(door, READ, 0, "W*00001A0001") == (b"0020", End.OK)


def test_a_number_that_is_cut_off_is_a_wrong_length() -> None:
    assert ask(LocalDoor(machine("Q03UD")), READ, 0, "D*00010000")[1] is End.LENGTH
