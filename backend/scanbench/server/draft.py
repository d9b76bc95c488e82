"""The text of a file as several people edit it at once: a CRDT (Yjs, whose other end is in the page), so that changes merge in whatever order
they come."""

import asyncio
from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from typing import NamedTuple

from pycrdt import Doc, Text, TransactionEvent, merge_updates

from scanbench.wire.refused import Refused

TEXT = "text"
"""The page knows the text by this name."""
MOST_BYTES = 2 << 20
"""A longer text does not grow: a page gets it in one message."""
MOST_LINES = 300
"""More that may have changed are not compared line by line, but replaced as a whole."""


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
        """Takes changes in that were made here; those that were new, or nothing."""
        self._doc.apply_update(update)
        return self._taken()

    def apply_foreign(self, update: bytes) -> bytes:
        """Takes changes in that a browser sent. `Refused` of what nobody can have typed: the draft may be broken then, and has to be made again."""
        before = len(self._text)
        try:
            self._doc.apply_update(update)
            length, real = len(self._text), len(self.text.encode())
        except (KeyboardInterrupt, SystemExit):
            raise
        except (
            BaseException
        ) as error:  # crafted ones make the library fail in many ways; a panic of Rust is no `Exception`
            raise Refused(f"these are no changes of a draft: {error}") from error
        if length != real:
            raise Refused("these are no changes of a draft: they insert what is no text")
        if length > max(before, MOST_BYTES):
            message = f"the text would have {length} bytes, {MOST_BYTES} are possible: make two files of it"
            raise Refused(message, final=True)
        return self._taken()

    def become(self, text: str) -> bytes:
        """Changes only what is different in this text; the changes."""
        return self.change(list(differences(self.text, text)))

    def change(self, all: Sequence["Difference"]) -> bytes:
        """Makes these differences; the changes."""
        before = self.text
        with self._doc.transaction():
            for found in reversed(all):
                at = len(before[: found.start].encode())  # pycrdt counts bytes
                if gone := len(before[found.start : found.end].encode()):
                    del self._text[at : at + gone]
                if found.text:
                    self._text.insert(at, found.text)
        return self._taken()

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
    head, tail = _alike(olds, news)
    starts = [0]
    for line in olds:
        starts.append(starts[-1] + len(line))
    old_end, new_end = len(olds) - tail, len(news) - tail
    for a, b, c, d in _changed(olds[head:old_end], news[head:new_end]):
        here, there = starts[head + a], starts[head + b]
        yield _trimmed(here, before[here:there], "".join(news[head + c : head + d]))


def _changed(olds: Sequence[str], news: Sequence[str]) -> Iterator[tuple[int, int, int, int]]:
    """Which lines have others in their place. To compare takes longer than their number says, so of many it is all of them."""
    if max(len(olds), len(news)) > MOST_LINES:
        yield 0, len(olds), 0, len(news)
        return
    for kind, a, b, c, d in SequenceMatcher(None, olds, news, autojunk=False).get_opcodes():
        if kind != "equal":
            yield a, b, c, d


def _alike(one: Sequence[str], other: Sequence[str]) -> tuple[int, int]:
    """How much of two sequences is the same at the beginning, and how much of the rest at the end."""
    shortest = min(len(one), len(other))
    head = next((at for at in range(shortest) if one[at] != other[at]), shortest)
    rest = shortest - head
    return head, next((at for at in range(rest) if one[-1 - at] != other[-1 - at]), rest)


def _trimmed(start: int, old: str, new: str) -> Difference:
    """Without what is the same at both ends."""
    head, tail = _alike(old, new)
    return Difference(start + head, start + len(old) - tail, new[head : len(new) - tail])


async def update_of(draft: Draft, base: str, text: str) -> bytes:
    """Somebody made `text` of `base` elsewhere: the same change of the draft, beside all others; the draft is not changed yet."""
    base, text, now = with_line_feeds(base), with_line_feeds(text), draft.text
    if text in (base, now):
        return b""
    copy = Draft(draft.key, [draft.lacking(None)])  # at once: people go on typing while the texts are compared
    if base != now:
        text = _both(base, *await asyncio.to_thread(_of_each, base, text, now))
    return copy.change(await asyncio.to_thread(_of, now, text))


def merged(base: str, one: str, other: str) -> str:
    """Both changes of a text."""
    if one == other or other == base:
        return one
    return other if one == base else _both(base, *_of_each(base, one, other))


def _of(before: str, after: str) -> list[Difference]:
    return list(differences(before, after))


def _of_each(base: str, one: str, other: str) -> tuple[list[Difference], list[Difference]]:
    return _of(base, one), _of(base, other)


def _both(base: str, one: Sequence[Difference], other: Sequence[Difference]) -> str:
    begun = Draft.begun(base)
    ends = [Draft(begun.key, [begun.lacking(None)]) for _ in range(2)]
    ends[0].change(one)
    ends[0].apply(ends[1].change(other))
    return ends[0].text
