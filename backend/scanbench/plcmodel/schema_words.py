"""What a schema finds wrong, in words: libxml2 speaks of facets and key-sequences."""

import re
from collections.abc import Callable
from difflib import get_close_matches

from scanbench.problems import perhaps

_LOOKS = {
    "[a-z][a-z0-9]*(-[a-z0-9]+)*": "write small letters and digits, with hyphens between the words, as in `pump-too-hot`",
    r"[%A-Za-z0-9. _\-]{1,64}": "write an address of the model, as `W10.05`",
    "_?[A-Za-z](_?[A-Za-z0-9])*": "write a name as a variable has, as `P_Ready`",
    r"[0-9]{1,6}(\.[0-9]{1,6})?(us|ms|s|min)": "write a number with us, ms, s or min after it, as `0.1s`",
    "[0-9A-Fa-f]{1,8}": "write the code's digits, as `4F02`",
    "[0-9]{1,9}|16#[0-9A-Fa-f]{1,8}": "write a whole number, as `12` or `16#1F`",
    r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d{1,6})?(Z|[+\-]\d\d:\d\d)": "write a moment as 2026-11-21T12:00:00+00:00",
}
_TYPES = {
    "Count": "a whole number, 0 or more", "Moment": "a moment as 2026-11-21T12:00:00+00:00", "xs:boolean": "true or false",
    "xs:integer": "a whole number", "xs:nonNegativeInteger": "a whole number, 0 or more",
    "xs:positiveInteger": "a whole number, 1 or more", "xs:unsignedInt": "a whole number, 0 or more",
}  # fmt: skip
_MESSAGE = re.compile(r"Element '([^']+)'(?:, attribute '([^']+)')?: (?:\[facet '\w+'\] )?(.*)", re.DOTALL)
_NAMESPACE = re.compile(r"\{[^}]*\}")
_XML = "{http://www.w3.org/XML/1998/namespace}"

Say = Callable[[str, re.Match[str]], str]
"""From what is meant (`Severity of <Error>`, or `<Error>`) and what was found."""


def in_words(message: str) -> str:
    """What, and what to do; what is not known here stays as it is."""
    about = _MESSAGE.fullmatch(message.strip())
    if about is None:
        return message
    element, attribute, found = about[1], about[2], about[3]
    place = f"<{_plain(element)}>" if attribute is None else f"{_plain(attribute)} of <{_plain(element)}>"
    for pattern, say in _SAYINGS:
        match = re.fullmatch(pattern, found, re.DOTALL)
        if match is not None:
            return say(place, match)
    return f"{place}: {found.rstrip('.')}"


def _plain(name: str) -> str:
    return _NAMESPACE.sub("", name.replace(_XML, "xml:"))


def _one_of(place: str, found: re.Match[str]) -> str:
    allowed = re.findall(r"'([^']*)'", found[2])
    near = get_close_matches(found[1].lower(), allowed, 1, 0.5)
    hint = f".{perhaps(near)}" if near else ""
    return f"{place} is {found[1]!r}, it can be {_or(allowed)}{hint}"


def _looks(place: str, found: re.Match[str]) -> str:
    look = _LOOKS.get(found[2], f"write it as this pattern says: {found[2]}")
    return f"{place} is {found[1]!r}: {look}"


def _type(place: str, found: re.Match[str]) -> str:
    meant = _TYPES.get(found[2])
    return (
        f"{place} is {found[1]!r}: write {meant}" if meant else f"{place} is {found[1]!r}, which is not allowed there"
    )


def _misplaced(place: str, found: re.Match[str]) -> str:
    expected = [f"<{_plain(each.strip())}>" for each in (found[1] or "").split(",") if each.strip()]
    return f"{place} does not belong here: " + (f"only {_or(expected)} is allowed" if expected else "remove it")


def _lacks(place: str, found: re.Match[str]) -> str:
    return f"{place} lacks {_or([f'<{_plain(each.strip())}>' for each in found[1].split(',')])}: write one inside of it"


def _or(names: list[str]) -> str:
    return " or ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


_SAYINGS: tuple[tuple[str, Say], ...] = (
    (r"The value '(.*)' is not an element of the set \{(.*)\}\.", _one_of),
    (r"The value '(.*)' is not accepted by the pattern '(.*)'\.", _looks),
    (r"'(.*)' is not a valid value of the (?:\w+ )*type '(.*)'\.", _type),
    (r"The value '(.*)' is greater than the maximum value allowed \('(.*)'\)\.",
     lambda place, found: f"{place} is {found[1]}: write {found[2]} at most"),
    (r"The value '(.*)' is less than the minimum value allowed \('(.*)'\)\.",
     lambda place, found: f"{place} is {found[1]}: write {found[2]} at least"),
    (r"The value '.*' has a length of '(\d+)'; this exceeds the allowed maximum length of '(\d+)'\.",
     lambda place, found: f"{place} has {found[1]} characters: write {found[2]} at most"),
    (r"The value '.*' has a length of '(\d+)'; this underruns the allowed minimum length of '(\d+)'\.",
     lambda place, found: f"{place} has {found[1]} characters: write {found[2]} at least"),
    (r"The value '(.*)' does not match the fixed value constraint '(.*)'\.",
     lambda place, found: f"{place} is {found[1]!r}, and must be {found[2]!r}"),
    (r"The attribute '(.*)' is required but missing\.",
     lambda place, found: f"{place} has no {_plain(found[1])}: write {_plain(found[1])}=\"...\" into it"),
    (r"The attribute '(.*)' is not allowed\.",
     lambda place, found: f"{place.rpartition(' of ')[2]} takes no {_plain(found[1])}: remove it"),
    (r"This element is not expected\.(?: Expected is (?:one of )?\((.*)\)\.)?", _misplaced),
    (r"Missing child element\(s\)\. Expected is (?:one of )?\((.*)\)\.", _lacks),
    (r"Character content (?:other than whitespace )?is not allowed.*",
     lambda place, _: f"there is text in {place}, where none belongs: remove it"),
    (r"Duplicate key-sequence \[(.*)\] in .*constraint '(.*)'\.",
     lambda place, found: f"{found[1]} is there twice, in {place} again ({found[2]}): give one of them another"),
)  # fmt: skip
