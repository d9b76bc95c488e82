"""Drafts -> the text of `errors.xml`, one element a line, and from a place in that text back to the field at this place.

The text is stable: the same drafts give the same text, and reading it gives the same drafts. Errors of a group are written
together, at the position of the first one.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from scanbench.plcmodel.document import xml_text
from scanbench.plcmodel.drafts import ADDRESS, ALSO, DETAIL, ERROR, DraftDetail, DraftError, Drafts, Texts

_CONTROLS = 16
"""The number of controls in one ErrorDetailPattern."""
_ENTITIES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "\t": "&#9;", "\n": "&#10;", "\r": "&#13;"}
_ATTRIBUTE = re.compile(r'(?<= )([\w:]+)="[^"]*"')
_ESCAPED = re.compile('[&<>"\t\n\r]')


@dataclass(slots=True)
class Written:
    """The text, and what each of its lines is about."""

    text: str = ""
    places: dict[int, tuple[str, Mapping[str, str]]] = field(default_factory=dict)
    """For each line: the draft that it contains (`errors.2.details.0`), and the attributes' names -> the fields'."""
    _attributes: dict[int, list[tuple[int, int, str]]] = field(default_factory=dict, compare=False, repr=False)
    """Of a line that was asked for: where its attributes are, and their names."""
    _lines: list[str] = field(default_factory=list, compare=False, repr=False)

    def field_at(self, line: int, column: int) -> str:
        """The field at this place, such as `errors.2.flag`; the element's where it is no attribute; '' in the frame."""
        path, names = self.places.get(line, ("", {}))
        if not names:
            return path
        if line not in self._attributes:
            self._lines = self._lines or self.text.split("\n")
            found = _ATTRIBUTE.finditer(self._lines[line - 1])
            self._attributes[line] = [(match.start(), match.end(), match[1]) for match in found]
        for start, end, name in self._attributes[line]:
            if start < column <= end and name in names:
                return f"{path}.{names[name]}"
        return path


@dataclass(slots=True)
class _Group:
    """A group while the errors are sorted into them."""

    errors: list[int] = field(default_factory=list)
    groups: dict[str, "_Group"] = field(default_factory=dict)


def write_catalogue(drafts: Drafts, root: str = "UserErrors") -> Written:
    """The whole file."""
    writer = _Writer()
    writer.line('<?xml version="1.0" encoding="UTF-8"?>')
    writer.line(f"<{root}>")
    names = {group.path: group.texts for group in drafts.groups}
    writer.depth = 1
    for name, group in _tree(drafts).groups.items():
        _write_group(writer, drafts, names, (name,), group)
    writer.close(root)
    return Written("\n".join((*writer.lines, "")), writer.places)


def _tree(drafts: Drafts) -> _Group:
    root = _Group()
    for index, error in enumerate(drafts.errors):
        group = root
        for name in error.group or ("",):
            group = group.groups.setdefault(name, _Group())
        group.errors.append(index)
    return root


class _Writer:
    """Lines, indented, and what they are about."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.places: dict[int, tuple[str, Mapping[str, str]]] = {}
        self.depth = 0

    def line(self, text: str, path: str = "", names: Mapping[str, str] | None = None) -> None:
        """One line; `names` as in `Written.places`."""
        self.lines.append("  " * self.depth + text)
        if path:
            self.places[len(self.lines)] = path, names or {}

    def element(self, tag: str, fields: object, names: Mapping[str, str], path: str, texts: Texts, empty: bool) -> None:
        """An element with its attributes and texts, closed only when `empty` says that nothing else comes in it."""
        attributes = "".join(
            f' {attribute}="{_escaped(value)}"'
            for name, attribute in names.items()
            if isinstance(value := getattr(fields, name), str) and (value or name in _ALWAYS)
        )
        closed = empty and not any(text.description for text in texts)
        self.line(f"<{tag}{attributes}{'/' * closed}>", path, {attribute: name for name, attribute in names.items()})
        if closed:
            return
        self.depth += 1
        if tag == "Error":
            self.texts("Name", [(text.language, text.name) for text in texts], path)
        self.texts("Description", [(text.language, text.description) for text in texts], path)
        if empty:
            self.close(tag)

    def texts(self, tag: str, texts: Iterable[tuple[str, str]], path: str) -> None:
        """A text in every language that has it."""
        for index, (language, text) in enumerate(texts):
            if text:
                attribute = "" if language == "en" else f' xml:lang="{_escaped(language)}"'
                place = f"{path}.texts.{index}.{tag.lower()}" if path else ""
                self.line(f"<{tag}{attribute}>{_escaped(text)}</{tag}>", place)

    def close(self, tag: str) -> None:
        """The end of an element."""
        self.depth -= 1
        self.line(f"</{tag}>")


_ALWAYS = frozenset({"id", "name", "code", "flag", "severity", "priority", "control", "type"})
"""Written even if empty, so that a problem has a place; but an Id that an address need not have."""


def _write_group(
    writer: _Writer, drafts: Drafts, names: Mapping[tuple[str, ...], Texts], path: tuple[str, ...], group: _Group
) -> None:
    tag = "ErrorGroup" if len(path) == 1 else "ErrorSubGroup"
    writer.line(f"<{tag}>")
    writer.depth += 1
    first = f"errors.{group.errors[0]}.group" if group.errors else ""
    writer.line(f"<Name>{_escaped(path[-1])}</Name>", first)
    writer.texts("Name", [(text.language, text.name) for text in names.get(path, ()) if text.language != "en"], "")
    for index in group.errors:
        _write_error(writer, drafts.errors[index], f"errors.{index}")
    for name, each in group.groups.items():
        _write_group(writer, drafts, names, (*path, name), each)
    writer.close(tag)


def _write_error(writer: _Writer, error: DraftError, path: str) -> None:
    writer.element("Error", error, ERROR, path, error.texts, empty=False)
    for index, also in enumerate(error.also):
        writer.element("Also", also, ALSO, f"{path}.also.{index}", (), empty=True)
    for first in range(0, len(error.details), _CONTROLS):
        writer.line("<ErrorDetailPattern>", path)
        writer.depth += 1
        for index, detail in enumerate(error.details[first : first + _CONTROLS], first):
            _write_detail(writer, detail, f"{path}.details.{index}")
        writer.close("ErrorDetailPattern")
    writer.close("Error")


def _write_detail(writer: _Writer, detail: DraftDetail, path: str) -> None:
    writer.element("ErrorControl", detail, DETAIL, path, detail.texts, empty=False)
    for index, address in enumerate(detail.addresses):
        names = ADDRESS if address.id else {name: each for name, each in ADDRESS.items() if name != "id"}
        writer.element("ErrorAddress", address, names, f"{path}.addresses.{index}", address.texts, empty=True)
    writer.close("ErrorControl")


def _escaped(text: str) -> str:
    """As content and as a value; what XML has no character for becomes the replacement character."""
    return _ESCAPED.sub(lambda match: _ENTITIES[match[0]], xml_text(text))
