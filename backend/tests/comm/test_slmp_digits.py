"""Numbers of SLMP in ASCII code: what is no digit is refused, whatever Python would take as a number; and how much a frame may ask for."""

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


def written(words: int = 0, doubles: int = 0, bits: int = 0, value: str = "01") -> End:
    """The end code of a random write of so many."""
    if bits:
        sub, data = 1, f"{bits:02X}" + "".join(f"M*{at:06d}{value}" for at in range(bits))
    else:
        devices = [f"D*{at:06d}0005" for at in range(words)] + [f"D*{at:06d}00000005" for at in range(doubles)]
        sub, data = 0, f"{words:02X}{doubles:02X}" + "".join(devices)
    return ask(LocalDoor(machine("Q03UD")), RANDOM_WRITE, sub, data)[1]


def test_a_random_write_has_at_most_as_many_devices_as_the_device_takes() -> None:
    assert [written(words=160), written(words=161), written(words=192)] == [End.OK, End.TOO_MANY, End.TOO_MANY]
    assert [written(doubles=137), written(doubles=138)] == [End.OK, End.TOO_MANY]
    assert [written(words=6, doubles=132), written(words=7, doubles=132)] == [End.OK, End.TOO_MANY]
    assert [written(bits=188), written(bits=189)] == [End.OK, End.TOO_MANY]


def test_a_bit_is_0_or_1() -> None:
    assert written(bits=1, value="02") is End.DATA
