"""The text of a file as several people edit it at once: a CRDT (Yjs, whose other end is in the page), so that changes merge in whatever order
they come."""

from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from typing import NamedTuple

from pycrdt import Doc, Text, TransactionEvent, merge_updates

from scanbench.wire.refused import Refused

TEXT = "text"
"""The page knows the text by this name."""


class Draft:
    """Made and used in one thread: pycrdt wants it so."""

    def __init__(self, key: str, parts: Sequence[bytes]) -> None:
        self.key = key
        self._doc: Doc[Text] = Doc()
        self._text = self._doc.get(TEXT, type=Text)
        for part in parts:
            self._doc.apply_update(part)
        self._fresh: list[bytes] = []
        self._watching = self._doc.observe(self._on_change)

    @classmethod
    def begun(cls, text: str) -> "Draft":
        """A new draft, whose lines end as those of the page's editor do."""
        draft = cls(Doc().guid, ())
        draft.become(with_line_feeds(text))
        return draft

    @property
    def text(self) -> str:
        """The text now."""
        return str(self._text)

    @property
    def vector(self) -> bytes:
        """What this end has, by author, for the other end to find out what is missing here."""
        return self._doc.get_state()

    def lacking(self, vector: bytes | None) -> bytes:
        """The changes that an end with this vector has not; all there are where it has none yet."""
        try:
            return self._doc.get_update(vector)
        except ValueError as error:
            raise Refused(f"this is no vector of a draft: {error}") from error

    def apply(self, update: bytes) -> bytes:
        """Takes changes in; those that were new, or nothing."""
        try:
            self._doc.apply_update(update)
        except ValueError as error:
            raise Refused(f"these are no changes of a draft: {error}") from error
        return self._taken()

    def become(self, text: str) -> bytes:
        """Changes only what is different in this text; the changes."""
        before = self.text
        with self._doc.transaction():
            for found in reversed(list(differences(before, text))):
                at = len(before[: found.start].encode())  # pycrdt counts bytes
                if gone := len(before[found.start : found.end].encode()):
                    del self._text[at : at + gone]
                if found.text:
                    self._text.insert(at, found.text)
        return self._taken()

    def take(self, base: str, text: str) -> bytes:
        """Somebody made `text` of `base` elsewhere: that change is made here as well, beside all others; the changes."""
        base, text = with_line_feeds(base), with_line_feeds(text)
        now = self.text
        return b"" if text == now else self.become(merged(base, text, now))

    def _on_change(self, event: TransactionEvent) -> None:
        self._fresh.append(event.update)

    def _taken(self) -> bytes:
        fresh, self._fresh = self._fresh, []
        return merge_updates(*fresh) if len(fresh) > 1 else b"".join(fresh)


def with_line_feeds(text: str) -> str:
    """The text with the line ends of a draft."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


class Difference(NamedTuple):
    """From `start` to `end` there is `text` instead, in characters."""

    start: int
    end: int
    text: str


def differences(before: str, after: str) -> Iterator[Difference]:
    """What of a text is different in the other, line by line; within changed lines the stretch that is."""
    olds, news = before.splitlines(keepends=True), after.splitlines(keepends=True)
    starts = [0]
    for line in olds:
        starts.append(starts[-1] + len(line))
    for kind, a, b, c, d in SequenceMatcher(None, olds, news, autojunk=False).get_opcodes():
        if kind != "equal":
            yield _trimmed(starts[a], before[starts[a] : starts[b]], "".join(news[c:d]))


def _trimmed(start: int, old: str, new: str) -> Difference:
    """Without what is the same at both ends."""
    shortest = min(len(old), len(new))
    head = next((at for at in range(shortest) if old[at] != new[at]), shortest)
    rest = shortest - head
    tail = next((at for at in range(rest) if old[-1 - at] != new[-1 - at]), rest)
    return Difference(start + head, start + len(old) - tail, new[head : len(new) - tail])


def merged(base: str, one: str, other: str) -> str:
    """Both changes of a text."""
    if one == other or other == base:
        return one
    if one == base:
        return other
    begun = Draft.begun(base)
    ends = [Draft(begun.key, [begun.lacking(None)]) for _ in range(2)]
    ends[0].become(one)
    ends[0].apply(ends[1].become(other))
    return ends[0].text
