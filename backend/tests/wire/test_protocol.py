"""The language between parent and hosts, and what both keep."""

import ast
import dataclasses
import socket
from datetime import UTC, datetime
from pathlib import Path

import msgpack  # type: ignore[import-untyped]
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.host.link import Link
from scanbench.runtime.command import Command, Entry, Patch, Plan, Restarted
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.restart import Restart
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.trap import TrapInfo, Trapped
from scanbench.runtime.write import Write
from scanbench.session.instance import Remembered
from scanbench.session.watches import Watches
from scanbench.store.records import Limits
from scanbench.wire import codec
from scanbench.wire import host as protocol
from scanbench.wire.codec import ENTRIES, LENGTH, BadMessage, Splitter, pack, pack_body, unpack

AT = datetime(2026, 11, 21, 12, 0, 0, 123456, UTC)
COMMANDS = (
    Write("Ada", "Main.n", "7"),
    Force("Ada", "Main.n", "7"),
    Release("Ada", None),
    SetMode("Ada", "RUN"),
    Generate("Ada", (ErrorRef("battery-error"), ErrorRef("io-bus-error", (("rack", "1"), ("slot", "3"))))),
    Recover("Ada", ("battery-error",)),
    Recover("Ada", None),
    Restart("Ada", "warm"),
    SetClock("Ada", AT),
    ProgramChange("Ada", 4),
    Trapped("PLC", TrapInfo("division", "division by zero", "main.st", 3, 8, 4711)),
)
SOURCES = protocol.Sources("CJ1M-CPU63", {"main.st": "PROGRAM é"}, 10_000_000, 3)


def entry(command: object, scan: int = 5) -> Entry:
    assert isinstance(command, Command)
    effect = Restarted("warm") if isinstance(command, Restart) else None
    return Entry(scan, AT, command, Plan((Patch(48, b"\xff\x0f", b"\1\2"),), "a text", effect))


@pytest.mark.parametrize("command", COMMANDS, ids=lambda each: type(each).__name__)
def test_entries_come_back_equal(command: object) -> None:
    for message in (protocol.Entered((entry(command),)), protocol.Submit(9, entry(command).command)):
        assert unpack(pack(message)[LENGTH.size :]) == message


def test_a_start_comes_back_equal_in_whatever_pieces() -> None:
    memory = Remembered("line-1", SOURCES, Path("/data/1.run"), Limits(memory_mib=128), protocol.Driven(0.5, True), 99)
    entered = [protocol.Entered(tuple(map(entry, COMMANDS)))]
    messages = [memory.start(), *entered, protocol.Quit(), protocol.Frame(b"x", 3)]
    stream = b"".join(map(pack, messages))
    for size in (1, 3, 1000, len(stream)):
        splitter, found = Splitter(), []
        for start in range(0, len(stream), size):
            found += list(splitter.feed(stream[start : start + size]))
        assert found == messages


@pytest.mark.parametrize(
    "body",
    [
        b"\xc1",
        msgpack.packb(msgpack.ExtType(1, msgpack.packb(["Popen", "rm"]))),
        msgpack.packb(msgpack.ExtType(7, b"")),
        msgpack.packb(msgpack.ExtType(1, msgpack.packb(["Quit", 1, 2]))),
    ],
)
def test_bytes_that_are_no_message(body: bytes) -> None:
    with pytest.raises(BadMessage):
        unpack(body)


def test_objects_within_objects_have_a_bound() -> None:
    """A file from elsewhere may hold any number of them in a few bytes, and each takes its part of the stack."""
    packed = b"\x01"
    for _ in range(5_000):
        packed = msgpack.packb(["Write", msgpack.ExtType(_kind(), packed)])
    with pytest.raises(BadMessage, match="deep"):
        ENTRIES.unpack(packed)
    with pytest.raises(BadMessage, match="deep"):
        unpack(packed)


def _kind() -> int:
    """The number that objects have among the kinds of values."""
    found = msgpack.unpackb(pack_body(Release("Ann", "D100")))
    assert isinstance(found, msgpack.ExtType)
    return int(found.code)


def test_the_longest_message(monkeypatch: pytest.MonkeyPatch) -> None:
    message = protocol.Frame(b"x" * 100, 3)
    packed = pack(message)
    monkeypatch.setattr(codec, "LARGEST", len(packed) - LENGTH.size)
    assert list(Splitter().feed(packed)) == [message]
    with pytest.raises(BadMessage, match=f"{len(packed) - LENGTH.size + 1} bytes"):
        list(Splitter().feed(pack(protocol.Frame(b"x" * 101, 3))))


def test_a_message_that_says_to_be_longer_is_refused_before_its_bytes_are_waited_for() -> None:
    assert list(Splitter().feed(LENGTH.pack(codec.LARGEST))) == []
    assert codec.body_length(LENGTH.pack(codec.LARGEST)) == codec.LARGEST
    for longer in (codec.LARGEST + 1, (1 << 32) - 1):
        with pytest.raises(BadMessage, match=f"{longer} bytes"):
            codec.body_length(LENGTH.pack(longer))


def test_the_link_of_a_host_ends_there() -> None:
    ours, theirs = socket.socketpair()
    with ours, theirs:
        ours.sendall(pack(protocol.Quit()) + LENGTH.pack(codec.LARGEST + 1))
        seen: list[object] = []
        with pytest.raises(BadMessage):
            Link(theirs).serve(seen.append, lambda: None, lambda: 1 << 40)
        assert seen == [protocol.Quit()]


def test_what_is_not_in_the_protocol_cannot_be_sent() -> None:
    with pytest.raises(TypeError, match="Stranger"):
        pack(dataclasses.make_dataclass("Stranger", [])())


@pytest.mark.parametrize("command", COMMANDS, ids=lambda each: type(each).__name__)
def test_a_run_file_gives_entries_back(command: object) -> None:
    assert ENTRIES.unpack(ENTRIES.pack(entry(command))) == entry(command)
    with pytest.raises(BadMessage):
        ENTRIES.unpack(pack_body(protocol.Quit()))


def test_paths_are_shared_as_they_are_typed() -> None:
    """A different spelling is a separate row of somebody's list, and has a value of its own."""
    watches = Watches()
    first = watches.add(1, ["Main.n", "D100"])
    assert watches.add(1, ["main.N"])[0][0] != first[0][0]
    watches.forget(1, [watches.add(1, ["main.N"])[0][0]])
    assert watches.add(2, ["Main.n ", "D200"])[0][0] == first[0][0]
    assert watches.forget(1, [id for id, _ in first]) == [first[1][0]]
    assert watches.forget(1, [first[0][0]]) == []  # it does not watch that any more
    assert len(watches.drop(2)) == 2
    assert watches.all() == ()


@given(st.lists(st.tuples(st.integers(1, 3), st.booleans(), st.sampled_from("abcd")), max_size=40))
def test_watched_is_what_somebody_watches(steps: list[tuple[int, bool, str]]) -> None:
    watches, expected, ids = Watches(), set[tuple[int, str]](), dict[str, int]()
    for who, adds, path in steps:
        if adds:
            ids[path] = watches.add(who, [path])[0][0]
            expected.add((who, path))
        elif path in ids:
            watches.forget(who, [ids[path]])
            expected.discard((who, path))
        assert {path for _, path in watches.all()} == {path for _, path in expected}


def test_no_two_classes_have_one_name() -> None:
    """The second one would take the place of the first, which nobody could send any more."""
    tree = ast.parse(Path(codec.__file__).read_text("utf-8"))
    (listed,) = (
        each.iter for each in ast.walk(tree) if isinstance(each, ast.comprehension) and isinstance(each.iter, ast.Tuple)
    )
    assert isinstance(listed, ast.Tuple)
    classes = [eval(ast.unparse(each), vars(codec)) for each in listed.elts]  # names of the module itself
    assert len(classes) > 100
    assert [each for each in classes if each not in codec._NAMES] == []
