"""The journal: every entry of a run, in order. In memory; with image and program it determines every later byte."""

from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar, cast, overload

if TYPE_CHECKING:
    from scanbench.runtime.command import Entry

T = TypeVar("T")
_STRIDE = 512
"""Entries from one state of a fold that is kept to the next."""


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
        """The state after these entries."""
        state = self.begin
        for entry in entries:
            state = self.step(state, entry)
        return state

    def states(self, entries: "Iterable[Entry]") -> Iterator[T]:
        """The state after each of these entries."""
        state = self.begin
        for entry in entries:
            state = self.step(state, entry)
            yield state


class AnyFold(Protocol):
    """A fold, whatever its states are."""

    @property
    def begin(self) -> object:
        """See `Fold`."""

    def over(self, entries: "Iterable[Entry]") -> object:
        """See `Fold`."""

    def states(self, entries: "Iterable[Entry]") -> Iterator[object]:
        """See `Fold`."""


class Journal(Sequence["Entry"]):
    """Append-only. Scans never go backwards."""

    def __init__(self, entries: "Iterable[Entry]" = ()) -> None:
        self._entries: list[Entry] = []
        self._derived: dict[object, list[tuple[int, object]]] = {}
        """Of each fold that was asked for: how many entries were after it and its state, now and then, and at last."""
        for entry in entries:
            self.append(entry)

    def append(self, entry: "Entry") -> None:
        """Adds an entry after all others."""
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
        """The state of `fold` after the last entry: only entries that came since it was last asked for are stepped."""
        known = self._derived.setdefault(fold, [(0, fold.begin)])
        done, last = known[-1]
        if done == len(self._entries):
            return cast(T, last)
        state = cast(T, last)
        if len(known) > 1 and done - known[-2][0] < _STRIDE:
            known.pop()
        for index in range(done, len(self._entries)):
            state = fold.step(state, self._entries[index])
            if index + 1 - known[-1][0] >= _STRIDE:
                known.append((index + 1, state))
        if known[-1][0] != len(self._entries):
            known.append((len(self._entries), state))
        return state

    def prefix(self, count: int) -> "Journal":
        """A journal of the first `count` entries, which knows what this one knows of them."""
        made = Journal()
        made._entries = self._entries[:count]
        made._derived = {
            fold: known[: bisect_right(known, count, key=itemgetter(0))] for fold, known in self._derived.items()
        }
        return made

    def without_front(self, kept: "Sequence[int]", cut: int) -> "Journal":
        """A journal that has of the first `cut` entries only those at `kept`: the others mean nothing to any fold."""
        made = Journal()
        made._entries = [*(self._entries[index] for index in kept), *self._entries[cut:]]
        gone = cut - len(kept)
        for fold, known in self._derived.items():
            made._derived[fold] = [known[0], *((done - gone, state) for done, state in known if done >= cut and done)]
        return made
