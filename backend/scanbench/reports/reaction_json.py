"""A reaction as JSON and back: for the database, for records, for the command line."""

from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import TypeVar, cast, get_args

from scanbench.faults.reaction.reaction import Difference, Line, Reaction, Reader, Verdict, What

T = TypeVar("T")


def to_json(reaction: Reaction) -> dict[str, object]:
    """Numbers, texts, lists and objects, with the names of `reaction.py`."""
    told = asdict(reaction)
    return {name: list(value) if isinstance(value, tuple) else value for name, value in told.items()}


def from_json(told: Mapping[str, object]) -> Reaction:
    """The reaction that `to_json` wrote; ValueError says which field is missing or of another kind."""
    return Reaction(
        verdict=cast(Verdict, _one_of(told, "verdict", get_args(Verdict))),
        window=_number(told, "window"),
        first_read=_scan(told, "first_read"),
        first_effect=_scan(told, "first_effect"),
        readers=_each(told, "readers", _reader),
        differences=_each(told, "differences", _difference),
        difference_count=_number(told, "difference_count"),
        lines=_each(told, "lines", lambda one: Line(_text(one, "file"), _number(one, "line"))),
        note=_text(told, "note"),
    )


def _reader(told: Mapping[str, object]) -> Reader:
    what = cast(What, _one_of(told, "what", get_args(What)))
    return Reader(_text(told, "file"), _number(told, "line"), _text(told, "pou"), what, _number(told, "scan"))


def _difference(told: Mapping[str, object]) -> Difference:
    output = told.get("output")
    if not isinstance(output, bool):
        raise ValueError(f"output must be true or false, not {output!r}")
    return Difference(_text(told, "path"), _text(told, "without"), _text(told, "value"), output, _number(told, "scan"))


def _each(told: Mapping[str, object], name: str, make: Callable[[Mapping[str, object]], T]) -> tuple[T, ...]:
    items = told.get(name)
    if not isinstance(items, list) or not all(isinstance(item, Mapping) for item in items):
        raise ValueError(f"{name} must be a list of objects, not {items!r}")
    return tuple(make(item) for item in items)


def _one_of(told: Mapping[str, object], name: str, values: tuple[str, ...]) -> str:
    value = told.get(name)
    if value not in values:
        raise ValueError(f"{name} must be one of {', '.join(values)}, not {value!r}")
    return str(value)


def _text(told: Mapping[str, object], name: str) -> str:
    value = told.get(name)
    if not isinstance(value, str):
        raise ValueError(f"{name} must be a text, not {value!r}")
    return value


def _number(told: Mapping[str, object], name: str) -> int:
    value = told.get(name)
    if not isinstance(value, int) or isinstance(value, bool):
        raise ValueError(f"{name} must be a whole number, not {value!r}")
    return value


def _scan(told: Mapping[str, object], name: str) -> int | None:
    return None if told.get(name) is None else _number(told, name)
