"""Values against the annotations of dataclasses: what came over a link, out of a file or from a client is what it says it is.

Clients and databases give plain values: mappings and lists, of which dataclasses and tuples are made. The codec has made these
already. This module imports nothing of ours: every room may use it.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from functools import cache
from types import NoneType, UnionType
from typing import Literal, TypeVar, Union, get_args, get_origin, get_type_hints

T = TypeVar("T")
Read = Callable[[object], object]
Given = Literal["made", "typed", "kept"]
"""By the codec, which makes dataclasses; by a client as plain values; by a database or file, also as plain values, which a
newer version may have written."""
_NAMES: dict[type, str] = {bool: "true or false", int: "a whole number", float: "a number", str: "a text"}


class BadValue(ValueError):
    """It is not what the annotation says; the message names the field."""


class _Wrong(BadValue):
    """A value by itself: `must be a text, not 7`."""

    def __init__(self, wanted: str, value: object) -> None:
        text = repr(value)
        super().__init__(f"must be {wanted}, not {text if len(text) <= 60 else text[:60] + '...'}")


def make(cls: type[T], given: Mapping[str, object]) -> T:
    """The dataclass of these fields: lists become tuples, mappings become dataclasses or pairs. `BadValue` names what is wrong."""
    return _make(cls, given, "typed")


def make_kept(cls: type[T], given: Mapping[str, object]) -> T:
    """The same of what was kept: fields that are not known, at any depth, are those of a newer version, and are left alone."""
    return _make(cls, given, "kept")


def _make(cls: type[T], given: Mapping[str, object], how: Given) -> T:
    build: Callable[..., T] = cls
    known: type = cls
    readers = field_readers(known, how)
    made: dict[str, object] = {}
    for name, value in given.items():
        if name not in readers:
            if how == "kept":
                continue
            raise BadValue(f"{name} is unknown; there are {', '.join(readers)}")
        try:
            made[name] = readers[name](value)
        except _Wrong as error:
            raise BadValue(f"{name} {error}") from None
        except BadValue as error:
            raise BadValue(f"{name}: {error}") from None
    missing = [name for name in _required(known) if name not in made]
    if missing:
        raise BadValue(f"{missing[0]} is missing")
    return build(**made)


def check(cls: type, values: Sequence[object]) -> None:
    """`BadValue` where a value is not what its field says; those at the end may be missing."""
    fields = _checks(cls)
    if len(values) > len(fields):
        raise BadValue(f"{cls.__name__} has {len(fields)} fields, not {len(values)}")
    for value, (types, read) in zip(values, fields, strict=False):
        if type(value) not in types:
            read(value)


@cache
def field_readers(cls: type, how: Given = "made") -> dict[str, Read]:
    """What reads each field of a dataclass, in their order."""
    hints = get_type_hints(cls)
    return {each.name: _reader(hints[each.name], how) for each in fields(cls)}


@cache
def _checks(cls: type) -> tuple[tuple[frozenset[type], Read], ...]:
    """Of each field the types that need no other look, as there are many values, and what reads all others."""
    hints = get_type_hints(cls)
    return tuple((_settled(hints[name]), read) for name, read in field_readers(cls).items())


def _settled(hint: object) -> frozenset[type]:
    if get_origin(hint) in (Union, UnionType):
        return frozenset[type]().union(*map(_settled, get_args(hint)))
    if not isinstance(hint, type) or get_origin(hint) is not None or issubclass(hint, Enum):
        return frozenset()
    return frozenset((float, int) if hint is float else (hint,))


@cache
def _required(cls: type) -> tuple[str, ...]:
    return tuple(each.name for each in fields(cls) if each.default is MISSING and each.default_factory is MISSING)


def _reader(hint: object, how: Given) -> Read:
    """What takes a value of this annotation, and refuses all others."""
    origin, args = get_origin(hint), get_args(hint)
    if origin is Literal:
        return _one_of(args)
    if origin in (Union, UnionType):
        return _union(args, how)
    if origin is tuple:
        return _each(args[0], how) if args[1:] == (Ellipsis,) else _pair(args, how)
    if origin in (Sequence, list):
        return _each(args[0], how)
    if origin in (Mapping, dict):
        return _mapping(_reader(args[0], how), _reader(args[1], how))
    if not isinstance(hint, type) or hint is object:
        return lambda value: value
    if issubclass(hint, Enum):
        return _one_of(tuple(each.value for each in hint))
    return _dataclass(hint, how) if how != "made" and is_dataclass(hint) else _of(hint, how)


def _of(hint: type, how: Given) -> Read:
    types = (int, float) if hint is float else (hint,)
    no_bool = how != "made" and hint in (int, float)

    def read(value: object) -> object:
        if not isinstance(value, types) or (no_bool and isinstance(value, bool)):
            raise _Wrong(_NAMES.get(hint, hint.__name__), value)
        return value

    return read


def _dataclass(hint: type, how: Given) -> Read:
    def read(value: object) -> object:
        if isinstance(value, hint):
            return value
        if isinstance(value, Mapping):
            return _make(hint, value, how)
        raise _Wrong("an object", value)

    return read


def _one_of(allowed: tuple[object, ...]) -> Read:
    def read(value: object) -> object:
        if value not in allowed:
            raise _Wrong(f"one of {', '.join(map(str, allowed))}", value)
        return value

    return read


def _union(args: tuple[object, ...], how: Given) -> Read:
    readers = [_reader(each, how) for each in args if each is not NoneType]
    optional = NoneType in args

    def read(value: object) -> object:
        if value is None and optional:
            return value
        refused: list[BadValue] = []
        for each in readers:
            try:
                return each(value)
            except BadValue as error:
                refused.append(error)
        raise refused[0]

    return read


def _each(hint: object, how: Given) -> Read:
    each = _reader(hint, how)
    wanted = "a list of objects" if isinstance(hint, type) and is_dataclass(hint) else "a list"

    def read(value: object) -> object:
        items = tuple(value.items()) if how != "made" and isinstance(value, Mapping) else value
        if not isinstance(items, tuple | list):
            raise _Wrong(wanted, value)
        return tuple(map(each, items))

    return read


def _pair(args: tuple[object, ...], how: Given) -> Read:
    readers = [_reader(each, how) for each in args]

    def read(value: object) -> object:
        if not isinstance(value, tuple | list) or len(value) != len(readers):
            raise _Wrong(f"a list of {len(readers)}", value)
        return tuple(each(item) for each, item in zip(readers, value, strict=True))

    return read


def _mapping(key: Read, each: Read) -> Read:
    def read(value: object) -> object:
        if not isinstance(value, Mapping):
            raise _Wrong("an object", value)
        return {key(name): each(item) for name, item in value.items()}

    return read
