"""What the journal says of errors, for people: names for ids, details in the words of the catalogue, repeats folded."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from scanbench.plcmodel.catalogue import ErrorEntry, Wording
from scanbench.public import Moment, Public

Language = Literal["en", "ja"]
_REFERENCE = re.compile(r"(?<![\w-])([a-z][a-z0-9-]*)(?![\w-])(?: \(([^()]*=[^()]*)\))?")
_JAPANESE = (
    (re.compile(r"^generated "), "発生："),
    (re.compile(r"^recovered "), "復旧："),
    (re.compile(r"^cleared by the tool: "), "ツールによるクリア："),
    (re.compile(r"^cleared by the program: "), "プログラムによるクリア："),
    (re.compile(r", code ([0-9A-F]+)"), r"、コード \1"),
    (
        re.compile(r"; the program is stopped, outputs off; memory is held, that of the outputs too$"),
        "（プログラム停止、出力オフ。出力も含めメモリは保持）",
    ),
    (re.compile(r"; the program is stopped$"), "（プログラム停止）"),
)
_MOST_LINES = 8
"""Of one round of a fault: several errors, one after the other, and their recoveries."""
_FEWEST_ROUNDS = 3


@dataclass(frozen=True, slots=True)
class RecordLine(Public):
    """A line of the log about errors."""

    at: Moment
    scan: int
    by: str
    text: str


@dataclass(frozen=True, slots=True)
class FoldedLine:
    """A line, or several that came again and again."""

    first: RecordLine
    last: RecordLine
    texts: tuple[str, ...]
    times: int


def worded(name: str, wordings: Iterable[Wording], language: Language) -> str:
    """A name in a language, or as the model has it."""
    return next((each.name for each in wordings if each.language == language and each.name), name)


def described(description: str, wordings: Iterable[Wording], language: Language) -> str:
    """A description in a language, or as the model has it."""
    return next((each.description for each in wordings if each.language == language and each.description), description)


def details_in_words(error: ErrorEntry, details: str, language: Language) -> str:
    """`location=io-table-checksum, slot=3` in the words of the catalogue."""
    return ", ".join(_detail(error, part, language) for part in details.split(", ")) if details else ""


def _detail(error: ErrorEntry, part: str, language: Language) -> str:
    name, equals, value = part.partition("=")
    detail = error.detail(name)
    if detail is None or not equals:
        return part
    choice = detail.choice(value) if detail.control == "List" else None
    if choice is not None:
        return described(choice.description, choice.wordings, language) or part
    return f"{described(detail.description, detail.wordings, language) or name} {value}"


def in_names(errors: Mapping[str, ErrorEntry], text: str, language: Language) -> str:
    """A line of the log with the catalogue's names for ids (`basic-io-error (rack=2)`)."""

    def named(match: re.Match[str]) -> str:
        error = errors.get(match[1])
        if error is None:
            return match[0]
        name = worded(error.name, error.wordings, language)
        return name if match[2] is None else f"{name} ({details_in_words(error, match[2], language)})"

    if language == "ja":
        for pattern, words in _JAPANESE:
            text = pattern.sub(words, text)
    return _REFERENCE.sub(named, text)


def folded(lines: Sequence[RecordLine]) -> list[FoldedLine]:
    """Rounds of a fault that comes and goes, one after the other, as one line each: a log is read by people."""
    found: list[FoldedLine] = []
    at = 0
    while at < len(lines):
        length, rounds = max(
            ((length, _rounds(lines, at, length)) for length in range(1, _MOST_LINES + 1)),
            key=lambda each: (each[0] * each[1] if each[1] >= _FEWEST_ROUNDS else 0, -each[0]),
        )
        if rounds < _FEWEST_ROUNDS:
            length, rounds = 1, 1
        taken = lines[at : at + length * rounds]
        found.append(FoldedLine(taken[0], taken[-1], tuple(line.text for line in taken[:length]), rounds))
        at += len(taken)
    return found


def _rounds(lines: Sequence[RecordLine], at: int, length: int) -> int:
    """How often the next lines come, themselves counted."""
    told = [(line.by, line.text) for line in lines[at : at + length]]
    rounds = 1
    while [(line.by, line.text) for line in lines[at + rounds * length : at + (rounds + 1) * length]] == told:
        rounds += 1
    return rounds
