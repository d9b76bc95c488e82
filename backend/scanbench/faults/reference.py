"""An error as text: `battery-error`, `memory-error:io-table-checksum`, `io-bus-error:rack=1,slot=3`."""

import re
from dataclasses import dataclass
from difflib import get_close_matches

from scanbench.plcmodel.model import ErrorEntry, Model
from scanbench.problems import perhaps
from scanbench.runtime.command import Refusal


@dataclass(frozen=True, slots=True)
class ErrorRef:
    """An error of the catalogue with the details that were given."""

    id: str
    details: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        """In the notation of `parse_reference`."""
        return self.id + "".join(
            f"{',' if number else ':'}{name}={value}" for number, (name, value) in enumerate(self.details)
        )


def error_of(text: str) -> str:
    """The id in the notation of the command line: what comes before the details."""
    return text.partition(":")[0]


def named_reference(text: str) -> ErrorRef:
    """What `str` of a reference was, without looking into a catalogue."""
    id, _, rest = text.partition(":")
    pairs = (part.partition("=") for part in rest.split(",") if part)
    return ErrorRef(id, tuple((name, value) for name, _, value in pairs))


def covers(text: str, ref: ErrorRef) -> bool:
    """Whether this text, in which details have names, means this error: all details that it gives are so."""
    given = named_reference(text)
    return given.id == ref.id and set(given.details) <= set(ref.details)


def natural(text: str) -> tuple[tuple[bool, int, str], ...]:
    """A key by which `unit=3` comes before `unit=20`."""
    parts = re.split(r"(\d+)", text)
    return tuple((part.isdigit(), int(part) if part.isdigit() else 0, part) for part in parts)


def find_error(model: Model, id: str) -> ErrorEntry | Refusal:
    """The catalogue's entry, or a refusal with near matches."""
    entry = model.error(id)
    if entry is not None:
        return entry
    ids = [error.id for error in model.errors()]
    near = tuple(get_close_matches(id.lower(), ids, n=4, cutoff=0.4))
    return Refusal(f"{model.name} knows no error {id!r}{'.' if near else ''}{perhaps(near)}", near)


def parse_reference(model: Model, text: str) -> ErrorRef | Refusal:
    """Reads the notation of the command line. A choice of a List may be given without the name of its detail."""
    id, _, rest = text.strip().partition(":")
    entry = find_error(model, id.strip())
    if isinstance(entry, Refusal):
        return entry
    details: list[tuple[str, str]] = []
    for part in filter(None, (part.strip() for part in rest.split(","))):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals:
            name, value = _unnamed(entry, [done for done, _ in details]), part
        if not name:
            return Refusal(f"{entry.id}: say which detail {part!r} is for, as in {entry.id}:NAME={part}")
        details.append((name, value))
    return ErrorRef(entry.id, tuple(details))


def _unnamed(entry: ErrorEntry, done: list[str]) -> str:
    """The detail that a value without a name is for: the only List, else the only detail there is."""
    open_ = [detail for detail in entry.details if detail.name not in done]
    lists = [detail for detail in open_ if detail.control == "List"]
    for candidates in (lists, open_):
        if len(candidates) == 1:
            return candidates[0].name
    return ""
