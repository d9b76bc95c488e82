"""The part of a model that a program uses: texts of instructions, and the memory for them, are there only where one is given.

The layout of a program is a promise (docs/formats.md): a program that uses none of this lies in memory as it did before there
was any. So it gets a model without.
"""

import re
from collections import OrderedDict
from collections.abc import Iterable, Iterator
from dataclasses import replace
from threading import Lock

from scanbench.plcmodel.model import ErrorGroup, Instruction, Model

_KEPT = 32
_COMMENT = re.compile(r"'(?:\$.|[^$'\n])*'|\"(?:\$.|[^$\"\n])*\"|//[^\n]*|\(\*.*?\*\)|/\*.*?\*/", re.DOTALL)
"""Strings too: what looks like a comment in one is none."""

_lock = Lock()
_made: OrderedDict[tuple[int, bool, bool], tuple[Model, Model]] = OrderedDict()


def as_used(model: Model, texts: Iterable[str]) -> Model:
    """The model of a program with these texts; the same object for the same use."""
    saying, coded = _saying(model), [each.name for each in model.resets if each.code]
    if not saying and not coded:
        return model
    known = list(texts)
    says = any(_calls(text, *each) for text in known for each in saying.items()) and not _declares(model, known)
    codes = any(_calls(text, name, None) for text in known for name in coded)
    return _without(model, says, codes)


def plain(model: Model) -> Model:
    """The model of a program that uses none of it, and nothing that only instructions ask for: what run files were kept with."""
    first = tuple(each for each in model.instructions if not each.part)
    made = _without(model, says=False, codes=False)
    return replace(made, instructions=tuple(_silent(first)), queries=(), catalogue=_coded(model.catalogue))


def _coded(groups: Iterable[ErrorGroup]) -> tuple[ErrorGroup, ...]:
    """Without the errors that have no code: they came later, and what is entered of them a run keeps."""
    made = (
        replace(each, groups=_coded(each.groups), errors=tuple(error for error in each.errors if error.coded))
        for each in groups
    )
    return tuple(each for each in made if each.groups or each.errors)


def _saying(model: Model) -> dict[str, str]:
    """Instructions that take a text, and the name of that parameter; '' where the call itself is enough."""
    return {each.name: each.text for each in model.instructions if each.texts is not None} | {
        each.name: "" for each in model.messages
    }


def _declares(model: Model, texts: list[str]) -> bool:
    """Whether the program has something of its own with the name of a message instruction."""
    names = "|".join(each.name for each in model.messages)
    if not names:
        return False
    own = re.compile(
        rf"\b(?:FUNCTION|FUNCTION_BLOCK|METHOD|PROGRAM)\s+(?:{names})\b|\b(?:{names})\b\s*[:,](?!=)", re.IGNORECASE
    )
    return any(own.search(text) for text in texts)


def _calls(text: str, name: str, parameter: str | None) -> bool:
    """Whether the text calls it: in any way (''), with this parameter, or with any (None)."""
    if name.lower() not in text.lower():
        return False
    plain = _COMMENT.sub(lambda found: "''" if found[0][0] in "'\"" else " ", text)
    for found in re.finditer(rf"(?<![\w.]){name}\s*\(", plain, re.IGNORECASE):
        inside = _inside(plain, found.end())
        if parameter == "" or (parameter is None and inside.strip()):
            return True
        if parameter and re.search(rf"(?:^|,)\s*{parameter}\s*:=", inside, re.IGNORECASE):
            return True
    return False


def _inside(text: str, start: int) -> str:
    """What is between the parentheses of a call, without that between others; strings are empty."""
    depth, at, kept = 1, start, []
    while at < len(text) and depth:
        character = text[at]
        depth += {"(": 1, ")": -1}.get(character, 0)
        if depth == 1 or (depth == 2 and character == "("):
            kept.append(character)
        at += 1
    return "".join(kept)


def _without(model: Model, says: bool, codes: bool) -> Model:
    if says and codes:
        return model
    key = id(model), says, codes
    with _lock:
        known = _made.get(key)
        if known is None or known[0] is not model:
            known = _made[key] = model, _made_of(model, says, codes)
        _made.move_to_end(key)
        while len(_made) > _KEPT:
            _made.popitem(last=False)
        return known[1]


def _made_of(model: Model, says: bool, codes: bool) -> Model:
    made = model
    if not says:
        areas = tuple(each for each in made.areas if not each.texts)
        made = replace(made, areas=areas, messages=(), instructions=tuple(_silent(made.instructions)))
    if not codes:
        made = replace(made, resets=tuple(replace(each, code="") if each.code else each for each in made.resets))
    return made


def _silent(instructions: Iterable[Instruction]) -> Iterator[Instruction]:
    return (each if each.texts is None else replace(each, text="", texts=None) for each in instructions)
