"""What one version keeps is read by another: fields that are missing have their defaults, those that are unknown are left alone."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path

import pytest

from scanbench.debug.breakpoint import Breakpoint
from scanbench.host.run_files import sources_in
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.format import RunFileError
from scanbench.store.records import WatchEntry
from scanbench.typed import BadValue, make, make_kept
from scanbench.verify.contract import Range
from scanbench.wire.codec import BadMessage, pack_body, unpack, unpack_kept
from scanbench.wire.host import Driven
from scanbench.wire.verifying import VerificationStatus, VerifyWish
from tests.wire.kept_shapes import GOLDEN, Shape, broken, of, shapes, write
from tests.wire.packed import cut_off, object_of, packed_with


@dataclass(frozen=True)
class Inner:
    text: str
    number: int = 7


@dataclass(frozen=True)
class Outer:
    inner: Inner
    more: tuple[Inner, ...] = ()
    by_name: Mapping[str, Inner] | None = None


NEWER = {"inner": {"text": "a", "unknown": 1}, "more": [{"text": "b", "number": 8, "unknown": []}], "unknown": {"x": 1}}


def test_unknown_fields_are_left_alone_at_any_depth() -> None:
    assert make_kept(Outer, NEWER) == Outer(Inner("a"), (Inner("b", 8),))
    by_name = {"inner": {"text": "a"}, "by_name": {"c": {"text": "c", "unknown": 1}}}
    assert make_kept(Outer, by_name) == Outer(Inner("a"), (), {"c": Inner("c")})


def test_of_a_client_they_are_refused() -> None:
    with pytest.raises(BadValue, match="inner: unknown is unknown; there are text, number"):
        make(Outer, NEWER)


@pytest.mark.parametrize(
    ("kept", "says"),
    [
        ({}, "inner is missing"),
        ({"inner": {}}, "inner: text is missing"),
        ({"inner": {"text": 1}}, "inner: text must be a text, not 1"),
        ({"inner": "a"}, "inner must be an object"),
    ],
)
def test_what_has_no_default_or_is_of_another_kind_is_named(kept: Mapping[str, object], says: str) -> None:
    with pytest.raises(BadValue, match=says):
        make_kept(Outer, kept)


STATUS = VerificationStatus(3, 1, "Ada", VerifyWish(Range(file="main.st"), "free", 0), "past", "free", note="all of it")


def values(message: VerificationStatus | Driven) -> list[object]:
    """Of its fields."""
    return [getattr(message, each.name) for each in fields(message)]


def test_packed_fields_that_an_older_version_did_not_know_have_their_defaults() -> None:
    assert unpack_kept(pack_body(STATUS)) == STATUS
    assert unpack_kept(packed_with("VerificationStatus", *values(STATUS)[:-5])) == replace(STATUS, note="")


def test_packed_fields_of_a_newer_version_are_left_alone() -> None:
    newer = packed_with("VerificationStatus", *values(STATUS), "more", [1, 2])
    assert unpack_kept(newer) == STATUS
    with pytest.raises(BadMessage, match="VerificationStatus has"):  # between processes both are one version
        unpack(newer)
    driven = Driven(paused=True)
    assert unpack_kept(packed_with("Driven", *values(driven), 1.5)) == driven


def test_of_packed_fields_of_a_newer_version_nobody_looks_at_the_classes() -> None:
    unknown, ill = object_of("OfANewerVersion", 1), object_of("Range", 7)
    assert unpack_kept(packed_with("VerificationStatus", *values(STATUS), unknown, [{"a": ill}], 1)) == STATUS
    newer = object_of("Range", *(getattr(STATUS.wanted.range, each.name) for each in fields(Range)), unknown)
    assert unpack_kept(packed_with("VerifyWish", newer, "free", 0)) == STATUS.wanted


@pytest.mark.parametrize("name", ["OfANewerVersion", "Ping"])
def test_in_a_field_that_is_known_a_wrong_class_is_refused(name: str) -> None:
    with pytest.raises(BadMessage):
        unpack_kept(packed_with("VerifyWish", object_of(name), "free", 0))


def test_packed_fields_that_are_cut_off_are_refused() -> None:
    """Also where they would be left alone."""
    for packed in (cut_off("VerifyWish", STATUS.wanted.range), cut_off("Driven", *values(Driven()), "more")):
        with pytest.raises(BadMessage, match="cut off"):
            unpack_kept(packed)


def test_sources_of_a_newer_version_are_refused() -> None:
    """What they do not say here may make another program of them."""
    packed = packed_with("Sources", "GENERIC-IEC", {"main.st": "PROGRAM Main END_PROGRAM"}, 1_000_000, 1, "more")
    with pytest.raises(
        RunFileError, match=r"program version 1 of the run file .* Open it with the version of scanbench"
    ):
        sources_in(KeptProgram(1, packed, ""))


# ---- the fields of all that is kept ---------------------------------------------------------------------------------

THEN: dict[str, dict[str, Shape]] = json.loads(GOLDEN.read_text("utf-8"))


def test_what_was_kept_can_be_read() -> None:
    """A field that goes, or is of another kind, or is new and has no default, needs another format, or a migration of the
    database: see docs/formats.md."""
    assert broken(THEN) == []


def test_the_fields_of_all_that_is_kept_are_written_down() -> None:
    assert shapes() == THEN, "run python -m tests.wire.kept_shapes"


def without(shape: Shape, field: str) -> Shape:
    return {name: kind for name, kind in shape.items() if name != field}


def changed(group: str, name: str, shape: Shape) -> dict[str, dict[str, Shape]]:
    """As they are now, but for one class."""
    now = shapes()
    now[group][name] = shape
    return now


BREAKPOINT, WATCH = of(Breakpoint), of(WatchEntry)


@pytest.mark.parametrize(
    ("then", "says"),
    [
        (changed("by name", "Breakpoint", {**BREAKPOINT, "old": "str"}), [".Breakpoint.old: 'str' is gone"]),
        (changed("by name", "Breakpoint", {**BREAKPOINT, "line": "str"}), [".Breakpoint.line: 'str' is now 'int'"]),
        (
            changed("by name", "Breakpoint", without(BREAKPOINT, "id")),
            [".Breakpoint.id: it is new, and needs a default"],
        ),
        (changed("by name", "Breakpoint", without(BREAKPOINT, "log")), []),
        (changed("by place", "WatchEntry", {**WATCH, "old": "str"}), [".WatchEntry.old: 'str' is now 'not there'"]),
        (
            changed("by place", "WatchEntry", without(WATCH, "group")),
            [".WatchEntry: the order was path, format, and new fields come last"],
        ),
    ],
)
def test_what_could_not_be_read_any_more_is_named_and_not_written(
    then: dict[str, dict[str, Shape]], says: list[str], tmp_path: Path
) -> None:
    golden = tmp_path / "kept.json"
    golden.write_text(json.dumps(then), "utf-8")
    assert broken(then) == says
    if says:
        with pytest.raises(SystemExit, match=r"(?s)could not be read any more.*--format-raised"):
            write(golden, raised=False)
        assert json.loads(golden.read_text("utf-8")) == then
    write(golden, raised=bool(says))
    assert json.loads(golden.read_text("utf-8")) == shapes()
