"""Sentences inside of messages: they are said where whoever sends them lists their fields; and which language is wanted."""

import re
from collections.abc import Iterable, Mapping

from scanbench.translation.catalogue import LANGUAGES
from scanbench.translation.said import say

Path = tuple[str, ...]
"""Where a sentence is: keys from the outside inwards, `*` for each of a list."""
Shapes = Mapping[frozenset[str], frozenset[str]]
"""By all the keys of an object: those of its fields that hold a sentence, or a list of them."""
_RANGE = re.compile(r"\s*([A-Za-z]{1,8})(?:-[\w-]*)?\s*(?:;\s*q\s*=\s*([0-9.]+))?\s*")


def wanted(asked: str) -> str:
    """The language of who asks like this: a tag such as `ja-JP`, or the list of a browser (`Accept-Language`). English where none is known."""
    best, rank = "en", 0.0
    for part in asked.split(","):
        match = _RANGE.fullmatch(part)
        if match is None:
            continue
        weight = float(match[2]) if match[2] and match[2].count(".") < 2 and match[2] != "." else 1.0
        name = match[1].lower()
        if weight > rank and (name in LANGUAGES or name == "en"):
            best, rank = name, weight
    return best


def in_shapes(value: object, shapes: Shapes, language: str) -> object:
    """The same data, with the sentences of the objects that have a shape of these said in this language."""
    if isinstance(value, list):
        return [in_shapes(each, shapes, language) for each in value]
    if not isinstance(value, dict):
        return value
    spoken = shapes.get(frozenset(value), frozenset())
    return {
        key: _sentences(each, language) if key in spoken else in_shapes(each, shapes, language)
        for key, each in value.items()
    }


def at_paths(value: object, paths: Iterable[Path], language: str) -> object:
    """The same data, with the sentences at these places of it said in this language."""
    for path in paths:
        value = _at(value, path, language)
    return value


def paragraphs(text: str, language: str) -> str:
    """The lines of a text, each of which is a sentence of its own."""
    whole = say(text, language)
    return whole if whole != text else "\n".join(say(line, language) for line in text.split("\n"))


def _at(value: object, path: Path, language: str) -> object:
    if not path:
        return _sentences(value, language)
    if path[0] == "*" and isinstance(value, list):
        return [_at(each, path[1:], language) for each in value]
    if isinstance(value, dict) and path[0] in value:
        return {**value, path[0]: _at(value[path[0]], path[1:], language)}
    return value


def _sentences(value: object, language: str) -> object:
    if isinstance(value, list):
        return [_sentences(each, language) for each in value]
    return say(value, language) if isinstance(value, str) else value
