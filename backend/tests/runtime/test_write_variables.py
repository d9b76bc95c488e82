"""What a protocol client writes by paths, or has copied: all of it or nothing, and only what tools may write."""

import pytest

from scanbench.host.variables import Variables
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.copy_areas import CopyAreas
from scanbench.runtime.forces import Force
from scanbench.runtime.modes import SetMode
from scanbench.runtime.resource import Resource
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.runtime.write_variables import VariableWrite, WriteVariables
from scanbench.wire.variables import ReadVariables
from tests.runtime.bench import plc, value

SOURCE = """
TYPE Colour : (RED, GREEN := 5); END_TYPE
FUNCTION_BLOCK Twice
VAR_IN_OUT x : INT; END_VAR
  x := 2 * x;
END_FUNCTION_BLOCK
PROGRAM Main
VAR level AT D100 : INT; lamp AT CIO 100.03 : BOOL; errors AT A400 : WORD; colour : Colour; name : STRING[4];
  numbers : ARRAY[0..2] OF INT; go : BOOL; twice : Twice; start : INT := 1; END_VAR
VAR CONSTANT most : INT := 42; END_VAR
  IF go THEN twice(x := start); go := FALSE; END_IF;
END_PROGRAM
"""


def write(resource: Resource, *writes: tuple[str, str, bytes]) -> str:
    """Empty where it was done, else why not."""
    done = resource.submit(WriteVariables("OPC UA Ada", tuple(VariableWrite(*each) for each in writes)))
    return done.message if isinstance(done, Refusal) else ""


def read(resource: Resource, *paths: str) -> tuple[bytes, bytes]:
    found = Variables().are(ReadVariables(1, paths), resource.loaded, resource.memory)
    assert (found.version, found.scan, found.mode) == (
        resource.version,
        resource.header.scan,
        resource.header.mode.name,
    )
    return found.there, found.data


def test_what_tools_may_write_in_every_mode() -> None:
    resource = plc(SOURCE)
    resource.submit(SetMode("Ada", "RUN"))
    assert write(resource, ("Main.level", "INT", b"\x05\0"), ("Main.lamp", "BOOL", b"\x07")) == ""
    assert (value(resource, "Main.level"), value(resource, "Main.lamp")) == (5, True)
    assert write(resource, ("Main.numbers", "ARRAY[0..2] OF INT", b"\1\0\2\0\3\0"), ("Main.go", "BOOL", b"\x80")) == ""
    assert write(resource, ("Main.name", "STRING[4]", b"\2\0ab"), ("D200", "WORD", b"\x34\x12")) == ""
    assert read(resource, "Main.numbers[1]", "Main.go", "Main.name", "D200")[1] == b"\2\0\1\2\0ab\0\0\x34\x12"


@pytest.mark.parametrize(
    ("path", "type", "data", "why"),
    [
        ("A400", "WORD", b"\1\0", "read-only for tools"),
        ("Main.errors", "WORD", b"\1\0", "read-only for tools"),
        ("Main.most", "INT", b"\1\0", "is a constant"),
        ("Main.level", "DINT", b"\1\0\0\0", "is INT now, and no longer DINT"),
        ("Main.level", "INT", b"\1", "1 bytes are no INT"),
        ("Main.colour", "Colour", b"\2\0", "2 is not Colour; it has RED, GREEN"),
        ("Main.name", "STRING[4]", b"\5\0abcde", "are no STRING[4]"),
        ("Main.twice", "Twice", b"", "write one of its members"),
        ("Main.twice.x", "INT", b"\1\0", "not called yet"),
        ("Main.nothing", "INT", b"\1\0", "has no member"),
    ],
)
def test_what_is_refused_changes_nothing_not_even_what_comes_with_it(
    path: str, type: str, data: bytes, why: str
) -> None:
    resource = plc(SOURCE)
    assert why in write(resource, ("Main.level", "INT", b"\7\0"), (path, type, data))
    assert value(resource, "Main.level") == 0


def test_an_in_out_means_what_its_block_was_given_and_what_is_forced_stays() -> None:
    resource = plc(SOURCE)
    assert read(resource, "Main.twice.x", "Main.level", "Main.nothing") == (b"\0\1\0", b"\0\0")
    write(resource, ("Main.go", "BOOL", b"\1"))
    resource.run(2)
    assert read(resource, "Main.twice.x", "Main.level") == (b"\1\1", b"\2\0\0\0")
    assert write(resource, ("Main.twice.x", "INT", b"\7\0")) == ""
    assert value(resource, "Main.start") == 7
    assert isinstance(resource.submit(Force("Ada", "Main.lamp", "TRUE")), Entry)
    assert write(resource, ("Main.lamp", "BOOL", b"\0")) == ""
    assert value(resource, "Main.lamp") is True
    assert read(resource, "Main.lamp", "CIO100.03") == (b"\1\1", b"\1\1")


def test_a_copy_is_of_the_seam_in_which_it_is_written() -> None:
    resource = plc("PROGRAM Main VAR n AT D100 : INT; END_VAR n := n + 1; END_PROGRAM")
    resource.run(3)
    assert isinstance(resource.submit(CopyAreas("FINS 127.0.0.1, node 1", "D", 200, "D", 600, 2)), Entry)
    assert (value(resource, "D300"), value(resource, "D100")) == (3, 3)
    for source, size, target, why in (("D", 1 << 20, "D", "no such memory"), ("D", 2, "A", "read-only for tools")):
        refused = resource.submit(CopyAreas("FINS 127.0.0.1, node 1", source, 0, target, 800, size))
        assert isinstance(refused, Refusal)
        assert why in refused.message


def test_of_two_writes_to_the_same_bytes_the_last_one_stays() -> None:
    resource = plc(SOURCE)
    assert write(resource, ("Main.level", "INT", b"\x05\0"), ("D100", "WORD", b"\0\0")) == ""
    assert value(resource, "Main.level") == 0
    assert (
        write(resource, ("Main.numbers", "ARRAY[0..2] OF INT", b"\1\0\2\0\3\0"), ("Main.numbers[1]", "INT", b"\0\0"))
        == ""
    )
    assert [value(resource, f"Main.numbers[{each}]") for each in range(3)] == [1, 0, 3]
    area = (AreaWrite("D", 200, b"\x07\0"), AreaWrite("D", 200, b"\0\0"))
    assert not isinstance(resource.submit(WriteAreas("FINS client", area)), Refusal)
    assert read(resource, "D100")[1] == b"\0\0"
