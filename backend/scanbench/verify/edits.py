"""Set data: inputs of single passes that somebody has edited."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches

from scanbench.problems import perhaps
from scanbench.program.types import StringType
from scanbench.runtime.command import Patch
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.values import parse_value


class BadEdit(Exception):
    """No such input, or no such value; the message says what there is."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.near = near


@dataclass(frozen=True, slots=True)
class Edit:
    """An input that was given a different value."""

    leaf: Leaf
    value: bytes

    @property
    def patch(self) -> Patch:
        """In the image."""
        leaf = self.leaf
        if leaf.bit is None:
            return Patch.whole(leaf.offset, self.value)
        return Patch.of_bit(leaf.offset, leaf.bit, self.value != b"\0")


@dataclass(slots=True)
class Edits:
    """All of them, by scan and call, then by column."""

    _all: dict[tuple[int, int], dict[str, Edit]] = field(default_factory=dict)

    def copy(self) -> "Edits":
        """A copy, which may be discarded."""
        return Edits({key: dict(each) for key, each in self._all.items()})

    def of(self, scan: int, call: int) -> Mapping[str, Edit]:
        """Those of a pass."""
        return self._all.get((scan, call), {})

    def set(self, inputs: Mapping[str, Leaf], scan: int, call: int, column: str, text: str) -> None:
        """One more, of a pass with these inputs; an empty text takes it back. `BadEdit`."""
        leaf = inputs.get(column)
        if leaf is None:
            near = tuple(get_close_matches(column, inputs, 3, 0.5))
            raise BadEdit(f"`{column}` is no input of scan {scan}, call {call}.{perhaps(near)}", near)
        mine = self._all.setdefault((scan, call), {})
        if not text.strip():
            mine.pop(column, None)
            return
        try:
            value = parse_value(leaf.type, text)
        except ValueError as error:
            raise BadEdit(f"{column}: {error}") from error
        mine[column] = Edit(leaf, value.ljust(leaf.type.size, b"\0") if isinstance(leaf.type, StringType) else value)
