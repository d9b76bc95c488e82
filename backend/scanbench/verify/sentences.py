"""Differences as sentences: what differs, where, in which scan."""

from dataclasses import dataclass

from scanbench.engines.debug import Frame
from scanbench.program.types import Reference
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.names import Names, NamesInside
from scanbench.symbols.references import slot_text
from scanbench.symbols.values import format_value
from scanbench.verify.contract import Cause, Mismatch, Place
from scanbench.verify.places import Places
from scanbench.verify.uses import Access

_TEMPORARY = "a temporary"


@dataclass(frozen=True, slots=True)
class Teller:
    """Of one pass."""

    names: Names
    places: Places
    here: NamesInside
    """Those of the pass; `names`: by whole paths."""
    scan: int
    path: str
    """Of the instance."""
    inside: bool
    """Names are those inside of it."""

    def differs(
        self, cause: Cause, leaf: Leaf, control: bytes, monitor: bytes, site: int, frames: tuple[Frame, ...]
    ) -> Mismatch:  # fmt: skip
        """A value differs."""
        place = self.places.of(site, frames)
        was, right = values(self.names, leaf, control, monitor)
        text = f"{self._subject(leaf)} is {was}, the reference gives {right}, at {_at(place)} in scan {self.scan}"
        return mismatch(cause, leaf, control, monitor, place, text)

    def input(self, leaf: Leaf, recorded: bytes, expected: bytes) -> Mismatch:
        """Something was read that nobody had written."""
        was, right = values(self.names, leaf, recorded, expected)
        text = f"{self._subject(leaf)} was {was} when it was read, and should have been {right}, in scan {self.scan}"
        return mismatch("input", leaf, recorded, expected, None, text)

    def order(self, one: Access, other: Access, here: tuple[Frame, ...], there: tuple[Frame, ...]) -> Mismatch:
        """A different statement ran, or a different variable was used."""
        place, meant = self.places.of(one.site, here), self.places.of(other.site, there)
        if one.site != other.site:
            text = f"{_at(place)} ran, and {_at(meant)} in the reference, in scan {self.scan}"
        else:
            used, right = self._use(one), self._use(other)
            text = f"{_at(place)} {used}, and {right} in the reference, in scan {self.scan}"
        return Mismatch("order", self._name(one), one.value, other.value, place, text)

    def only_one(self, access: Access, control: bool, frames: tuple[Frame, ...]) -> Mismatch:
        """One of them went on, and the other did not."""
        place = self.places.of(access.site, frames)
        who, other = ("the control device", "the reference") if control else ("the reference", "the control device")
        text = f"{who} went on at {_at(place)}, where it {self._use(access)}, and {other} did not, in scan {self.scan}"
        mine, none = access.value, b""
        return Mismatch("order", self._name(access), mine if control else none, none if control else mine, place, text)

    def _use(self, access: Access) -> str:
        return f"{'wrote' if access.written else 'read'} {self._name(access)}"

    def _name(self, access: Access) -> str:
        found = self.here.at(access.offset, access.size, access.bits)
        return self._subject(found[0]) if found else _TEMPORARY

    def _subject(self, leaf: Leaf) -> str:
        """Its whole path."""
        if leaf.offset < self.names.program.layout.frames:
            found = self.names.at(leaf.offset, leaf.type.size, leaf.bits)
            if found:
                return found[0].name
        return f"{self.path}.{leaf.name}" if self.inside and not leaf.passing else leaf.name


def values(names: Names, leaf: Leaf, control: bytes, monitor: bytes) -> tuple[str, str]:
    """Both as text, so that they can be told apart: of a string the bytes where they differ after its end."""
    one, other = (_text(names, leaf, each) for each in (control, monitor))
    if one != other:
        return one, other
    return f"{one} (bytes {control.hex(' ')})", f"{other} (bytes {monitor.hex(' ')})"


def _text(names: Names, leaf: Leaf, value: bytes) -> str:
    return slot_text(names, leaf.type, value) if isinstance(leaf.type, Reference) else format_value(leaf.type, value)


def mismatch(cause: Cause, leaf: Leaf, control: bytes, monitor: bytes, place: Place | None, text: str) -> Mismatch:
    """With the type of the value."""
    type = leaf.type
    return Mismatch(cause, leaf.name, control, monitor, place, text, type.name, type.kind.value, type.size)


def _at(place: Place) -> str:
    return f"{place.file}:{place.line}"
