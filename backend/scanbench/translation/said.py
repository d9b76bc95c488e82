"""A sentence in the language of who reads it.

A sentence goes through Scanbench in English: in processes, run files and databases, also in those of years ago. Where it leaves for a reader, its template is
found in the catalogue, its arguments are taken out of it, and both are said in the reader's language. What no template fits stays as it is.
"""

import logging
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache

from scanbench.translation.catalogue import PLACE, catalogue

_log = logging.getLogger(__name__)
_LONGEST = 400
"""A text that is longer is none of our sentences, nor is one of several lines."""
_MOST_HEADS = 3
MOST_TRIED = 2000
"""Templates that one text is compared with, its parts included. A sentence of ours takes some dozens."""
_SHORT = 4
"""Letters that a template has at least, for an argument of it to be more than one word."""
QUOTES = ("`", '"')
_MARKS = tuple(":;.,(){[")
_NO_SENTENCE = r"(?:(?![:;.] ).)*?"
"""What an argument is that no mark sets apart: no sentence, else an inner sentence would be taken for the outer one."""
_REST = "(?:(?!, found `|, but the file).)*?"
_AFTER = r"(?:, (?:found `|but the file|raised at|written at|as different|at ?most|once |and with|outputs off)|[;:.] | Did you | ?\(| in | at | varied ).*?"
"""How an argument begins that follows another at once: as a sentence or a part of one, that is not always there."""
_ITEMS = re.compile(r",? (?:and|or) |, ")
_PARTS = (re.compile(r"((?<=[.?])[ \n](?=[A-Z`]))"), re.compile("(; )"), re.compile("(, )"))
"""Where a text is cut when no template fits the whole: after sentences, then between parts, then between items."""
_MARK = {" ": "", "; ": "。", ", ": "、"}
_HEAD = re.compile(r"((?:`[^`]*`|'[^']*'|[^\s:]+(?: -> [^\s:]+)?): )(.+)", re.DOTALL)
"""What something is said about."""
_ENDING = re.compile(r"(?:\{\d+\})+$")
_NAME = re.compile("`[^`]*`")
_JAPANESE = re.compile("[\u3001-\u30ff\u4e00-\u9fff\uff00-\uff60]")
_PROBLEM = re.compile(r"([^\s:]+:\d+:\d+: (?:[A-Z]\d{3} )?)(.+)", re.DOTALL)
"""A place in a file, and what is wrong there."""
_LONG = 12
"""Letters of a template that is not mistaken for a part of a sentence."""
_LETTERS = re.compile(r"[A-Za-z]")
_WORD = re.compile(r"[A-Za-z]+")


@dataclass(frozen=True, slots=True)
class Template:
    """One sentence of the catalogue, as it is recognised."""

    pattern: re.Pattern[str]
    anchor: str
    """The longest stretch of it that is always the same."""
    places: tuple[int, ...]
    quoted: frozenset[int]
    """Arguments between quotes are names of the program, which no language changes."""
    said: str
    stop: bool
    """Whether it ends with a full stop, and perhaps a hint."""
    word: str
    """The longest word that is always in it, by which it is looked up; empty: there is none."""


class _TooMuch(Exception):
    """A text that takes more work than any sentence of ours."""


class Work:
    """How much was tried for one text."""

    def __init__(self) -> None:
        self.tried = 0

    def try_one(self) -> None:
        """`_TooMuch` where it was enough."""
        self.tried += 1
        if self.tried > MOST_TRIED:
            raise _TooMuch


class Language:
    """Says sentences in one language."""

    def __init__(self, pairs: Mapping[str, str]) -> None:
        self._whole = {_plain(english): _plain(said) for english, said in pairs.items() if not PLACE.search(english)}
        templates = [(english, said) for english, said in pairs.items() if PLACE.search(english)]
        templates.sort(key=lambda pair: _rank(pair[0]))
        self._by_word: dict[str, list[tuple[int, Template]]] = defaultdict(list)
        for rank, each in enumerate(template(*pair) for pair in templates):
            self._by_word[each.word].append((rank, each))

    def say(self, text: str, work: Work | None = None) -> str:
        """The sentence in this language, with the spaces around it."""
        try:
            return self._whole_text(text, work or Work(), _MOST_HEADS)
        except _TooMuch:
            return text

    def _whole_text(self, text: str, work: Work, heads: int) -> str:
        bare = text.strip()
        if len(bare) > _LONGEST or "\n" in bare or not _LETTERS.search(bare):
            return text
        said = self._said(bare, work, heads)
        return text if said is None else text.replace(bare, said, 1)

    def _said(self, text: str, work: Work, heads: int) -> str | None:
        """Said as a sentence, as what becomes one with a full stop, or part by part."""
        said = self._as_it_is(text, work, heads)
        if said is not None:
            return said
        if text.endswith("."):
            bare = self._as_it_is(text[:-1], work, heads)
            return self._parts(text, work, heads) if bare is None else f"{bare}。"
        whole = self._as_it_is(f"{text}.", work, heads)
        return self._parts(text, work, heads) if whole is None else whole.removesuffix("。")

    def _as_it_is(self, text: str, work: Work, heads: int) -> str | None:
        """`heads`: so many things that something is said about may still be taken off."""
        if heads and (problem := _PROBLEM.fullmatch(text)):
            return problem[1] + self._whole_text(problem[2], work, heads - 1)
        known = self._whole.get(text)
        if known is not None:
            return known
        items = _ITEMS.split(text)
        if len(items) > 1 and all(item in self._whole or " " not in item or _NAME.fullmatch(item) for item in items):
            return "、".join(self._whole_text(item, work, heads) for item in items)
        stop = text.endswith(".")
        for each in self._candidates(text):
            work.try_one()
            if each.stop >= stop and each.anchor in text and (match := each.pattern.fullmatch(text)):
                return self._fill(each, match, work, heads)
        if heads and (head := _HEAD.fullmatch(text)):
            rest = self._as_it_is(head[2], work, heads - 1)
            return None if rest is None else head[1] + rest
        return None

    def _candidates(self, text: str) -> Iterator[Template]:
        """Templates whose word is in the text, those that say most first."""
        words = {"", *_WORD.findall(text)}
        found = [each for word in words for each in self._by_word.get(word, ())]
        return (each for _, each in sorted(found, key=lambda ranked: ranked[0]))

    def _fill(self, found: Template, match: re.Match[str], work: Work, heads: int) -> str:
        values = dict(zip(found.places, match.groups(), strict=True))
        made, end = "", 0
        for place in PLACE.finditer(found.said):
            made = _joined(made, found.said[end : place.start()])
            end = place.end()
            if not place[2]:
                number = int(place[1])
                value = values[number]
                made = _joined(made, value if number in found.quoted else self._whole_text(value, work, heads))
        return _joined(made, found.said[end:])

    def _parts(self, text: str, work: Work, heads: int) -> str | None:
        """Sentences, or items of a list, one after the other: those that are known are said."""
        for marks in _PARTS:
            parts = marks.split(text)
            if len(parts) == 1:
                continue
            said = [part if number % 2 else self._said(part, work, heads) or part for number, part in enumerate(parts)]
            if said != parts:
                return "".join(_MARK.get(part, part) if number % 2 else part for number, part in enumerate(said))
        return None


def template(english: str, said: str) -> Template:
    """How the sentence is recognised."""
    short = _weight(english) < _SHORT
    pattern, end = "", 0
    places: list[int] = []
    quoted: set[int] = set()
    fixed: list[str] = []
    for place in PLACE.finditer(english):
        between = english[end : place.start()]
        follows = bool(places) and not between
        end = place.end()
        quote = between[-1:]
        within = quote in QUOTES and english[end : end + 1] == quote
        apart = between.rstrip()[-1:] in _MARKS or (english[end : end + 1] in _MARKS and len(english) > end + 1)
        last = end == len(english) and english[0] != "{" and _weight(english) >= _LONG
        place_in_file = english[end : end + 2] == ":{"
        any_text = (
            "[^:]*?" if place_in_file else r"\S*?" if short else ".*?" if apart else _REST if last else _NO_SENTENCE
        )
        inside = f"[^{quote}]*" if within else f"(?:{_AFTER})?" if follows else any_text
        pattern += f"{re.escape(_plain(between))}({inside})"
        fixed.append(between)
        places.append(int(place[1]))
        if within:
            quoted.add(places[-1])
    fixed.append(english[end:])
    pattern += re.escape(_plain(english[end:]))
    anchor = max(map(_plain, fixed), key=len)
    return Template(
        re.compile(pattern, re.DOTALL),
        anchor,
        tuple(places),
        frozenset(quoted),
        _plain(said),
        _ENDING.sub("", english).endswith("."),
        _word(english),
    )


def _word(english: str) -> str:
    """The longest word that no argument of the template touches: in a sentence it is a word of its own, too."""
    marked = PLACE.sub("\0", english)
    words = (each for each in _WORD.finditer(marked) if "\0" not in marked[max(0, each.start() - 1) : each.end() + 1])
    return max((each[0] for each in words), key=len, default="")


def _joined(before: str, after: str) -> str:
    """Japanese has no spaces between its words, and none after a full stop."""
    if before.endswith("。"):
        return before + after.lstrip(" ")
    if _JAPANESE.search(before[-1:]) and after.startswith(" ") and _JAPANESE.search(after[1:2]):
        return before + after[1:]
    if before.endswith(" ") and _JAPANESE.search(before[-2:-1]) and _JAPANESE.search(after[:1]):
        return before[:-1] + after
    return before + after


def _weight(english: str) -> int:
    """How much of a sentence its template says: letters, and the quotes around names."""
    fixed = PLACE.sub("", english)
    return len(_LETTERS.findall(fixed)) + 3 * fixed.count("`")


def _rank(english: str) -> tuple[bool, int, int, str]:
    """What says most fits best; what only goes on after a sentence comes last."""
    return (
        english.startswith(("{0}, found", "{0}, but the file")),
        -_weight(english),
        -len(PLACE.sub("", english)),
        english,
    )


def _plain(text: str) -> str:
    return text.replace("{{", "{").replace("}}", "}")


@cache
def _language(name: str) -> Language:
    return Language(catalogue(name))


@lru_cache(maxsize=4096)
def say(text: str, language: str) -> str:
    """The sentence in this language; in English as it is. A text that cannot be said stays, whatever the fault is: it is better read than lost."""
    if language == "en":
        return text
    try:
        return _language(language).say(text)
    except Exception:
        _log.exception("a text of %d characters could not be said in %s", len(text), language)
        return text
