"""The fields of all that is kept, and their kinds: `python -m tests.wire.kept_shapes` writes `golden/kept.json`.

It is made again when fields were added. Where a format or the revision of the database was raised, `--format-raised` writes
also what could not be read before; without it such a change is refused.
"""

import argparse
import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from functools import cache
from inspect import isabstract
from pathlib import Path
from typing import get_args, get_type_hints

from scanbench.debug.breakpoint import Breakpoint
from scanbench.faults.reaction.reaction import Reaction
from scanbench.recording.blocks import About
from scanbench.runtime.command import Command, Effect, Entry
from scanbench.server.trace_records import TraceRecord
from scanbench.session.tracing import WantedTrace
from scanbench.store.records import KeptRow, SweptError, WatchEntry
from scanbench.verify.contract import Row
from scanbench.verify.trace.mapping import TraceMapping
from scanbench.wire.codec import pack_body  # noqa: F401 - imports all commands
from scanbench.wire.host import Driven, Sources
from scanbench.wire.verification import KeptRows
from scanbench.wire.verifying import VerificationStatus
from tests.store.said import missing

GOLDEN = Path(__file__).with_name("golden") / "kept.json"
BY_NAME: tuple[type, ...] = (About, Breakpoint, Reaction, SweptError, TraceMapping, TraceRecord, WantedTrace)
"""Kept as JSON objects, with all that is in them."""
BY_PLACE: tuple[type, ...] = (Driven, KeptRows, Row, Sources, VerificationStatus, WatchEntry)
"""Kept as lists of values: the order of fields counts."""
Shape = Mapping[str, str]
Shapes = Mapping[str, Mapping[str, Shape]]


def of(cls: type) -> Shape:
    """Its fields, in their order."""
    hints = get_type_hints(cls)
    return {each.name: _kind(hints[each.name]) for each in fields(cls)}


def optional(cls: type) -> frozenset[str]:
    """Fields with a default."""
    return frozenset(
        each.name for each in fields(cls) if each.default is not MISSING or each.default_factory is not MISSING
    )  # fmt: skip


def _kind(hint: object) -> str:
    return re.sub(
        r"\b(?:\w+\.)+(\w+)", r"\1", hint.__name__ if isinstance(hint, type) and not get_args(hint) else str(hint)
    )


@cache
def kept() -> tuple[dict[str, type], dict[str, type]]:
    """By the names of classes: those that are kept by names of fields, and by places."""
    by_name = {each.__name__: each for root in BY_NAME for each in _within(root)}
    by_name.pop(KeptRow.__name__, None)  # a row of the database, and no JSON
    roots = (*BY_PLACE, Entry, *get_args(Effect), *_commands())
    return by_name, {each.__name__: each for root in roots for each in _within(root)}


def _within(hint: object) -> Iterator[type]:
    """The dataclasses in an annotation."""
    if isinstance(hint, type) and is_dataclass(hint):
        yield hint
        for each in get_type_hints(hint).values():
            yield from _within(each)
    for each in get_args(hint):
        yield from _within(each)


def _commands(of: type[Command] = Command) -> Iterator[type]:
    """All that a journal may keep; what tests make besides is none of it."""
    for each in of.__subclasses__():
        yield from _commands(each)
        if each.__module__.startswith("scanbench.") and not isabstract(each):
            yield each


def shapes() -> dict[str, dict[str, Shape]]:
    """As they are now."""
    by_name, by_place = kept()
    return {
        "by name": {name: of(cls) for name, cls in sorted(by_name.items())},
        "by place": {name: of(cls) for name, cls in sorted(by_place.items())},
    }


def broken(then: Shapes) -> list[str]:
    """Why what was kept with fields as they were `then` could not be read now. Where the place counts, an enumeration may have
    more values: an older version refuses a value that it does not know."""
    now = shapes()
    found = missing(then["by name"], now["by name"])
    for name, was in then["by place"].items():
        fields_now = now["by place"].get(name, {})
        for field, kind in was.items():
            other = fields_now.get(field, "not there")
            if other != kind and not _grown(kind, other):
                found.append(f".{name}.{field}: {kind!r} is now {other!r}")
        if was.keys() <= fields_now.keys() and list(fields_now)[: len(was)] != list(was):
            found.append(f".{name}: the order was {', '.join(was)}, and new fields come last")
    return found + [line for group, classes in zip(("by name", "by place"), kept(), strict=True)
                    for line in _without_default(then[group], classes)]  # fmt: skip


def _without_default(then: Mapping[str, Shape], classes: Mapping[str, type]) -> Iterator[str]:
    for name, cls in classes.items():
        if name in then:
            for field in sorted(of(cls).keys() - then[name].keys() - optional(cls)):
                yield f".{name}.{field}: it is new, and needs a default"


def _grown(then: str, now: str) -> bool:
    """Whether there are more values of the same enumeration."""
    values = re.compile(r"Literal\[(.*?)\]")
    was, found = values.search(then), values.search(now)
    if was is None or found is None or values.sub("", then) != values.sub("", now):
        return False
    return set(was[1].split(", ")) <= set(found[1].split(", "))


def write(path: Path, raised: bool) -> None:
    """Writes them; without a format that was raised only where all that was kept can still be read."""
    why = [] if raised else broken(json.loads(path.read_text("utf-8")))
    if why:
        raise SystemExit(
            "\n".join(why)
            + "\nWhat was kept could not be read any more: see docs/formats.md. Where a format was raised, or a"
            " migration was written, run python -m tests.wire.kept_shapes --format-raised"
        )
    path.write_text(json.dumps(shapes(), indent=1, ensure_ascii=False) + "\n", "utf-8")


def main() -> None:
    """Writes them, if they may be so."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--format-raised", action="store_true", help="a format or the revision of the database was")
    write(GOLDEN, parser.parse_args().format_raised)


if __name__ == "__main__":
    main()
