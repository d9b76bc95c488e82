"""Sentences inside of messages: which fields are for people, and what their language is."""

import re

from scanbench.translation.catalogue import LANGUAGES
from scanbench.translation.said import say

FOR_PEOPLE = frozenset({
    "message", "text", "note", "notes", "reaction_note", "needless", "refusal", "refused", "damage", "now", "why", "title", "hint", "format",
    "output", "description", "detail", "documentation", "contents", "warnings", "reason",
})  # fmt: skip
"""Names of fields that hold a sentence, or a list of them."""
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


def in_language(value: object, language: str) -> object:
    """The same data, with the sentences in it said in this language."""
    if language == "en":
        return value
    if isinstance(value, dict):
        return {key: _field(key, each, language) for key, each in value.items()}
    if isinstance(value, list):
        return [in_language(each, language) for each in value]
    return value


def said_inside(message: dict[str, object], language: str) -> dict[str, object]:
    """A whole message, with the sentences in it said in this language."""
    return message if language == "en" else {key: _field(key, each, language) for key, each in message.items()}


def _field(key: object, value: object, language: str) -> object:
    if key not in FOR_PEOPLE:
        return in_language(value, language)
    if isinstance(value, str):
        return say(value, language)
    if isinstance(value, list):
        return [_field(key, each, language) for each in value]
    if isinstance(value, dict) and "kind" in value and isinstance(value.get("value"), str):  # text of an editor
        return {**value, "value": _paragraphs(value["value"], language)}
    return in_language(value, language)


def _paragraphs(text: str, language: str) -> str:
    """The lines of a text for an editor, each of which is a sentence of its own."""
    whole = say(text, language)
    return whole if whole != text else "\n".join(say(line, language) for line in text.split("\n"))
