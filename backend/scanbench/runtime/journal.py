"""The journal: every entry of a run, in order. In memory; with image and program it determines every later byte."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeVar, cast, overload

from scanbench.runtime.command import Entry

T = TypeVar("T")


class Journal(Sequence[Entry]):
    """Append-only. Scans never go backwards."""

    def __init__(self, entries: Iterable[Entry] = ()) -> None:
        self._entries: list[Entry] = []
        self._derived: dict[object, tuple[int, object]] = {}
        for entry in entries:
            self.append(entry)

    def append(self, entry: Entry) -> None:
        """Adds an entry behind all others."""
        if self._entries and entry.scan < self._entries[-1].scan:
            raise ValueError(f"scan {entry.scan} is before the journal's last, {self._entries[-1].scan}")
        self._entries.append(entry)

    def __len__(self) -> int:
        return len(self._entries)

    def __iter__(self) -> Iterator[Entry]:
        return iter(self._entries)

    @overload
    def __getitem__(self, index: int) -> Entry: ...
    @overload
    def __getitem__(self, index: slice) -> list[Entry]: ...
    def __getitem__(self, index: int | slice) -> Entry | list[Entry]:
        return self._entries[index]

    def derived(self, fold: Callable[[Sequence[Entry]], T]) -> T:
        """What `fold` makes of the entries; remembered until there are more of them."""
        length, value = self._derived.get(fold, (-1, None))
        if length != len(self._entries):
            value = fold(self._entries)
            self._derived[fold] = (len(self._entries), value)
        return cast(T, value)
