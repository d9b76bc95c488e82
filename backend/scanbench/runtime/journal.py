"""The journal: every entry of a run, in order. In memory; with image and program it determines every later byte."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar, cast, overload

if TYPE_CHECKING:
    from scanbench.runtime.command import Entry

T = TypeVar("T")


@dataclass(frozen=True, slots=True, eq=False)
class Fold(Generic[T]):
    """What the entries of a journal add up to: the forces that hold, the errors that are present.

    `step` is pure: it returns the very state when the entry means nothing to it, else a new one. So a state may be kept
    and handed out.
    """

    begin: T
    """Before the first entry."""
    step: "Callable[[T, Entry], T]"

    def over(self, entries: "Iterable[Entry]") -> T:
        """The state behind these entries."""
        state = self.begin
        for entry in entries:
            state = self.step(state, entry)
        return state


class Journal(Sequence["Entry"]):
    """Append-only. Scans never go backwards."""

    def __init__(self, entries: "Iterable[Entry]" = ()) -> None:
        self._entries: list[Entry] = []
        self._derived: dict[object, tuple[int, object]] = {}
        for entry in entries:
            self.append(entry)

    def append(self, entry: "Entry") -> None:
        """Adds an entry behind all others."""
        if self._entries and entry.scan < self._entries[-1].scan:
            raise ValueError(f"scan {entry.scan} is before the journal's last, {self._entries[-1].scan}")
        self._entries.append(entry)

    def __len__(self) -> int:
        return len(self._entries)

    def __iter__(self) -> "Iterator[Entry]":
        return iter(self._entries)

    @overload
    def __getitem__(self, index: int) -> "Entry": ...
    @overload
    def __getitem__(self, index: slice) -> "list[Entry]": ...
    def __getitem__(self, index: int | slice) -> "Entry | list[Entry]":
        return self._entries[index]

    def derived(self, fold: Fold[T]) -> T:
        """The state of `fold` behind the last entry: only entries that came since it was last asked for are stepped."""
        done, known = self._derived.get(fold, (0, fold.begin))
        state = cast(T, known)
        if done != len(self._entries):
            for index in range(done, len(self._entries)):
                state = fold.step(state, self._entries[index])
            self._derived[fold] = (len(self._entries), state)
        return state
