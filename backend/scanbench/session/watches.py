"""Who watches what: one id for each path, shared by all subscribers of a PLC."""

from collections.abc import Iterable, Sequence


class Watches:
    """Counts, for every path, the subscribers that watch it."""

    def __init__(self) -> None:
        self._ids: dict[str, int] = {}
        self._paths: dict[int, str] = {}
        self._watchers: dict[int, set[int]] = {}
        self._next = 1

    def add(self, subscriber: int, paths: Sequence[str]) -> tuple[tuple[int, str], ...]:
        """(id, path) for each path, in order; the same path, as typed, has the same id for everybody."""
        pairs = []
        for path in paths:
            key = path.strip()
            id = self._ids.get(key)
            if id is None:
                id, self._next = self._next, self._next + 1
                self._ids[key], self._paths[id] = id, path
                self._watchers[id] = set()
            self._watchers[id].add(subscriber)
            pairs.append((id, path))
        return tuple(pairs)

    def forget(self, subscriber: int, ids: Iterable[int]) -> list[int]:
        """The subscriber does not watch these any more; those that nobody watches now."""
        free = []
        for id in ids:
            watchers = self._watchers.get(id)
            if watchers is None or subscriber not in watchers:
                continue
            watchers.discard(subscriber)
            if not watchers:
                del self._watchers[id], self._ids[self._paths.pop(id).strip()]
                free.append(id)
        return free

    def drop(self, subscriber: int) -> list[int]:
        """The subscriber is gone; the ids that nobody watches now."""
        return self.forget(subscriber, [id for id, watchers in self._watchers.items() if subscriber in watchers])

    def all(self) -> tuple[tuple[int, str], ...]:
        """Everything that is watched."""
        return tuple(self._paths.items())
