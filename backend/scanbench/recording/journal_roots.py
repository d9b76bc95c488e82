"""Which entries have to stay when the beginning of a journal is dropped: those on which later entries still depend.

These are the changes of the program, and for each fold the entries that its state is made of. All that is known of a fold
is that its state is a mapping of which each entry changes some keys, or one value as a whole.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from scanbench.runtime.command import Entry, Swapped
from scanbench.runtime.journal import AnyFold


def journal_roots(entries: Sequence[Entry], folds: Iterable[AnyFold]) -> tuple[int, ...]:
    """Which of these entries have to stay: every fold comes to the same over them."""
    traces = [_Trace.of(fold, entries) for fold in folds]
    kept = {index for index, entry in enumerate(entries) if isinstance(entry.plan.effect, Swapped)}
    for trace in traces:
        kept |= {origin[-1] for origin in trace.origins.values()}  # mostly enough
    while missing := {index for trace in traces for index in trace.missing(entries, kept)}:
        kept |= missing
    return tuple(sorted(kept))


@dataclass(slots=True)
class _Trace:
    """Where the state of a fold comes from."""

    fold: AnyFold
    state: Mapping[str, object] = field(default_factory=dict)
    origins: dict[str, list[int]] = field(default_factory=dict)
    """Of each key: the entries that changed it since it came."""
    ends: dict[str, int] = field(default_factory=dict)
    """Of each key that is gone: the last entry that took it away."""
    all: list[int] = field(default_factory=list)
    """Every entry that changed anything."""

    @staticmethod
    def of(fold: AnyFold, entries: Sequence[Entry]) -> "_Trace":
        """Of these entries."""
        trace = _Trace(fold)
        before: object = fold.begin
        for index, state in enumerate(fold.states(entries)):
            if state is not before:
                trace._changed(index, trace._as_mapping(state))
                before = state
        return trace

    def _changed(self, index: int, now: Mapping[str, object]) -> None:
        before, self.state = self.state, now
        self.all.append(index)
        for key in before.keys() - now.keys():
            self.ends[key] = index
            del self.origins[key]
        for key, value in now.items():
            if key not in before:
                self.origins[key] = [index]
            elif value is not before[key]:
                self.origins[key].append(index)

    def missing(self, entries: Sequence[Entry], kept: set[int]) -> set[int]:
        """More entries that are needed, as over those that are kept the fold does not come to the same."""
        found = self._as_mapping(self.fold.over(entries[index] for index in sorted(kept)))
        if list(found.items()) == list(self.state.items()):
            return set()
        more = {self.ends[key] for key in found.keys() - self.state.keys() if key in self.ends}
        for key, value in self.state.items():
            if found.get(key) != value:
                origin = self.origins[key]
                # with where it came from and what came last most states are complete
                more.update(origin[:1] if origin[0] not in kept else origin)
        firsts = {origin[0] for origin in self.origins.values()}  # what came first is first
        return more - kept or firsts - kept or set(self.all)

    def _as_mapping(self, state: object) -> Mapping[str, object]:
        if isinstance(state, Mapping):
            return state
        return {} if state == self.fold.begin else {"": state}
