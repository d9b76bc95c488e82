"""Values against the annotations of dataclasses: what came over a link, out of a file or from a client is what it says it is.

Clients give `plain` values: mappings and lists, of which dataclasses and tuples are made. The codec has made these already.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from functools import cache
from types import NoneType, UnionType
from typing import Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from scanbench.wire.refused import Refused

T = TypeVar("T")
Read = Callable[[object], object]


class BadValue(Refused):
    """It is not what the annotation says; the message names the field."""


def make(cls: type[T], given: Mapping[str, object]) -> T:
    """The dataclass of these fields: lists become tuples, mappings become dataclasses or pairs. `BadValue` names what is wrong."""
    readers = field_readers(cls, plain=True)
    made: dict[str, object] = {}
    for name, value in given.items():
        if name not in readers:
            raise BadValue(f"{name}: there is no such field; there are {', '.join(readers)}")
        try:
            made[name] = readers[name](value)
        except BadValue as error:
            raise BadValue(f"{name}: {error}") from None
    missing = [name for name in _required(cls) if name not in made]
    if missing:
        raise BadValue(f"{missing[0]}: it is missing")
    build: Callable[..., T] = cls
    return build(**made)


@cache
def field_readers(cls: type, plain: bool = False) -> dict[str, Read]:
    """What reads each field of a dataclass, in their order."""
    hints = get_type_hints(cls)
    return {each.name: reader(hints[each.name], plain) for each in fields(cls)}


def check(cls: type, values: Sequence[object]) -> None:
    """`BadValue` where a value is not what its field says; those at the end may be missing."""
    fields = _checks(cls)
    if len(values) > len(fields):
        raise BadValue(f"{cls.__name__} has {len(fields)} fields, not {len(values)}")
    for value, (types, read) in zip(values, fields, strict=False):
        if type(value) not in types:
            read(value)


@cache
def _checks(cls: type) -> tuple[tuple[frozenset[type], Read], ...]:
    """Of each field the types that need no other look, as there are many values, and what reads all others."""
    hints = get_type_hints(cls)
    return tuple((_settled(hints[name]), read) for name, read in field_readers(cls).items())


def _settled(hint: object) -> frozenset[type]:
    if get_origin(hint) in (Union, UnionType):
        return frozenset().union(*map(_settled, get_args(hint)))
    if not isinstance(hint, type) or get_origin(hint) is not None or issubclass(hint, Enum):
        return frozenset()
    return frozenset((float, int) if hint is float else (hint,))


@cache
def _required(cls: type) -> tuple[str, ...]:
    return tuple(
        each.name for each in fields(cls) if each.default is MISSING and each.default_factory is MISSING
    )  # fmt: skip


def reader(hint: object, plain: bool) -> Read:
    """What takes a value of this annotation, and refuses all others with `BadValue`."""
    origin, args = get_origin(hint), get_args(hint)
    if origin is Literal:
        return _one_of(args)
    if origin in (Union, UnionType):
        return _union(args, plain)
    if origin is tuple:
        return _tuple(args, plain)
    if origin in (Sequence, list):
        return _tuple((args[0], ...), plain)
    if origin in (Mapping, dict):
        return _mapping(reader(args[0], plain), reader(args[1], plain))
    if not isinstance(hint, type) or hint is object:
        return lambda value: value
    if issubclass(hint, Enum):
        return _one_of(tuple(each.value for each in hint))
    if is_dataclass(hint):
        return _dataclass(hint) if plain else _plain(hint)
    return _plain(hint)


def _plain(hint: type) -> Read:
    types = (int, float) if hint is float else hint

    def read(value: object) -> object:
        if not isinstance(value, types):
            raise BadValue(f"{_shown(value)} where {hint.__name__} should be")
        return value

    return read


def _dataclass(hint: type) -> Read:
    def read(value: object) -> object:
        if isinstance(value, hint):
            return value
        if isinstance(value, Mapping):
            return make(hint, value)
        raise BadValue(f"{_shown(value)} where {hint.__name__} should be")

    return read


def _one_of(allowed: tuple[object, ...]) -> Read:
    def read(value: object) -> object:
        if value not in allowed:
            raise BadValue(f"{_shown(value)} is none of {', '.join(map(str, allowed))}")
        return value

    return read


def _union(args: tuple[object, ...], plain: bool) -> Read:
    classes = tuple(each for each in args if isinstance(each, type) and get_origin(each) is None and each is not object)
    known = (*classes, int) if float in classes else classes
    readers = [reader(each, plain) for each in args if each is not NoneType]

    def read(value: object) -> object:
        if isinstance(value, known):
            return value
        refused: list[str] = []
        for each in readers:
            try:
                return each(value)
            except BadValue as error:
                refused.append(str(error))
        raise BadValue("; ".join(refused))

    return read


def _tuple(args: tuple[object, ...], plain: bool) -> Read:
    each = reader(args[0], plain) if args[1:] == (Ellipsis,) else None
    readers = [] if each is not None else [reader(arg, plain) for arg in args]

    def read(value: object) -> object:
        items = tuple(value.items()) if plain and isinstance(value, Mapping) else value
        if not isinstance(items, tuple | list):
            raise BadValue(f"{_shown(value)} where a list should be")
        if each is not None:
            return tuple(map(each, items))
        if len(items) != len(readers):
            raise BadValue(f"a list of {len(items)} where one of {len(readers)} should be")
        return tuple(one(item) for one, item in zip(readers, items, strict=True))

    return read


def _mapping(key: Read, each: Read) -> Read:
    def read(value: object) -> object:
        if not isinstance(value, Mapping):
            raise BadValue(f"{_shown(value)} where a mapping should be")
        return {key(name): each(item) for name, item in value.items()}

    return read


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:60] + "..."
