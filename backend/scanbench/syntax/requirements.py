"""What a project requires of its program when an error comes and goes: `required.reactions`, text -> rules.

    battery-error in Running:
      motor = FALSE within 3 scans
      after recovery: motor = FALSE until reset

docs/error-sweep.md has the whole language. Expressions are not looked into here: whoever knows the program does that.
"""

import posixpath
import re
from dataclasses import dataclass, field
from typing import Literal

from scanbench.problems import Problem, Severity, Span

REQUIREMENTS = "required.reactions"
"""The name of the file, at the top of a project."""
CODE = "R001"
Form = Literal["grade", "end", "within", "always", "never", "may_restart"]
_COMMENTS = re.compile(r"'(?:\$.|[^$'\n])*'|\"(?:\$.|[^$\"\n])*\"|//[^\n]*|\(\*.*?\*\)", re.DOTALL)
_QUOTED = re.compile(r"'(?:\$.|[^$'\n])*'|\"(?:\$.|[^$\"\n])*\"")
_HEAD = re.compile(r"((?:\"[^\"]*\"|:(?=\S)|[^\":])+):(?=\s|$)")
_ABOUT = re.compile(r"\s*(\S+?)(?:\s+in\s+(.+?))?\s*")
_STATE = re.compile(r"\s*(?:\"([^\"]+)\"|([^\s\",][^\",]*?))\s*(?:,|$)")
_AFTER = re.compile(r"after\s+recovery\s*:\s*", re.IGNORECASE)
_GRADE = re.compile(r"at\s+least\s+(\S+)\s*", re.IGNORECASE)
_RESTART = re.compile(r"(.+?)\s+may\s+restart\s*", re.IGNORECASE)
_UNTIL = re.compile(r"\suntil\s+", re.IGNORECASE)
_WITHIN = re.compile(r"\s+within\s+(?:(\d{1,9})\s+scans?|(L?T(?:IME)?#\S+))\s*", re.IGNORECASE)
_STAYS = re.compile(r"(?<=\s)stays(?=\s)", re.IGNORECASE)
_WORD = re.compile(r"[^\s()+*/<>=&-]+")
"""One operand, without operators."""
_MODAL = re.compile(r"(always|never)\s+", re.IGNORECASE)
_HOW = "write e.g. `motor = FALSE within 3 scans`, `always lamp`, `never heater`, or `at least acted`"


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of a line, and where it is."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Requirement:
    """One line: what must happen."""

    text: str
    span: Span
    form: Form
    about: Piece
    """The expression; of a grade its name."""
    recovery: bool = False
    """It counts from the recovery on."""
    scans: int | None = None
    """within so many scans,"""
    time: Piece | None = None
    """or within a time."""
    until: Piece | None = None


@dataclass(frozen=True, slots=True)
class Rule:
    """What is required of some errors."""

    error: Piece
    """A reference to an error, `all`, `fatal` or `nonfatal`."""
    states: tuple[str, ...]
    """Where a sweep begins; empty: anywhere."""
    requirements: tuple[Requirement, ...]


@dataclass(frozen=True, slots=True)
class RequirementsText:
    """A file that was read, as far as it could be."""

    rules: tuple[Rule, ...] = ()
    problems: tuple[Problem, ...] = ()


def is_requirements(path: str) -> bool:
    """Whether a file of this path has the requirements of its project."""
    return posixpath.basename(path.replace("\\", "/")) == REQUIREMENTS


@dataclass(slots=True)
class _Reader:
    file: str
    problems: list[Problem] = field(default_factory=list)

    def piece(self, line: int, start: int, text: str) -> Piece:
        """A part of a line without the space around it; `start` counts from 0."""
        start += len(text) - len(text.lstrip())
        text = text.strip()
        return Piece(text, Span(self.file, line, start + 1, line, start + 1 + max(1, len(text))))

    def problem(self, piece: Piece, message: str) -> None:
        self.problems.append(Problem(CODE, message, piece.span, Severity.WARNING))


def read_requirements(text: str, file: str = REQUIREMENTS) -> RequirementsText:
    """The rules of a text, and what is wrong with its lines. A line that cannot be read is left out, and told."""
    reader = _Reader(file)
    rules: list[tuple[Piece, tuple[str, ...], list[Requirement]]] = []
    refused = False
    for number, line in enumerate(_COMMENTS.sub(_blank, text).split("\n"), 1):
        if not line.strip():
            continue
        begin = 0
        if not line[0].isspace():
            head = _HEAD.match(line)
            about = None if head is None else _about(reader, number, head[1])
            refused = about is None
            if head is None:
                reader.problem(reader.piece(number, 0, line), "a line that begins with an error needs `:` after it, as in `battery-error: lamp = TRUE`")  # fmt: skip
            if head is None or about is None:
                continue
            begin = head.end()
            rules.append((*about, []))
        if not line[begin:].strip() or refused:
            continue
        if not rules:
            reader.problem(reader.piece(number, 0, line), "say first which error it is about: a line such as `battery-error:` that begins in the first column")  # fmt: skip
            continue
        made = _requirement(reader, number, begin, line[begin:])
        if made is not None:
            rules[-1][2].append(made)
    return RequirementsText(
        tuple(Rule(error, states, tuple(made)) for error, states, made in rules), tuple(reader.problems)
    )


def _blank(match: re.Match[str]) -> str:
    """Comments become space, so that every column stays what it is; texts stay."""
    found = match[0]
    return found if found[0] in "'\"" else "".join("\n" if each == "\n" else " " for each in found)


def _about(reader: _Reader, line: int, text: str) -> tuple[Piece, tuple[str, ...]] | None:
    match = _ABOUT.fullmatch(text)
    if match is None:
        reader.problem(reader.piece(line, 0, text), "this names no error: write `battery-error:` or `battery-error in Running:`")  # fmt: skip
        return None
    states: list[str] = []
    at, told = 0, match[2] or ""
    while at < len(told):
        state = _STATE.match(told, at)
        if state is None:
            reader.problem(reader.piece(line, match.start(2), told), 'states are written as `Running, "Before the jam"`')  # fmt: skip
            return None
        states.append(state[1] or state[2])
        at = state.end()
    return reader.piece(line, match.start(1), match[1]), tuple(states)


def _compared(left: str, right: str) -> tuple[int, str]:
    """`left stays right` as a comparison, whatever operators the two have; and how much further left it begins: all columns
    stay what they are."""
    if _WORD.fullmatch(left.strip()) and _WORD.fullmatch(right.strip()):
        return 0, f"{left}=    {right}"
    if any(side.count("(") != side.count(")") for side in (_QUOTED.sub("", left), _QUOTED.sub("", right))):
        return 0, f"{left}=    {right}"  # it is inside of parentheses already
    before = len(left) - len(left.lstrip())
    value = right.strip()
    gap = right[: len(right) - len(right.lstrip()) - 1] if value else right
    closed = f"({value})" if value else ""
    return 1, f"{left[:before]}({left[before:]})=   {gap}{closed}"


def _requirement(reader: _Reader, line: int, begin: int, text: str) -> Requirement | None:
    whole = reader.piece(line, begin, text)
    text, begin = whole.text, whole.span.column - 1
    after = _AFTER.match(text)
    recovery = after is not None
    if after is not None:
        text, begin = text[after.end() :], begin + after.end()
    if grade := _GRADE.fullmatch(text):
        if recovery:
            reader.problem(whole, "a grade is about the whole reaction: leave out `after recovery:`")
            return None
        return Requirement(
            whole.text, whole.span, "grade", reader.piece(line, begin + grade.start(1), grade[1]), recovery
        )
    if restart := _RESTART.fullmatch(text):
        return Requirement(whole.text, whole.span, "may_restart", reader.piece(line, begin, restart[1]), True)
    made = _condition(reader, line, begin, text, whole, recovery)
    if made is not None and not made.about.text:
        reader.problem(whole, f"there is no condition here: {_HOW}")
        return None
    return made


def _condition(
    reader: _Reader, line: int, begin: int, text: str, whole: Piece, recovery: bool
) -> Requirement | None:  # fmt: skip
    shown = _QUOTED.sub(lambda match: "_" * len(match[0]), text)
    until, scans, time, form, start = None, None, None, "end", 0
    if ends := list(_UNTIL.finditer(shown)):
        last = ends[-1]
        until = reader.piece(line, begin + last.end(), text[last.end() :])
        text, shown, form = text[: last.start()], shown[: last.start()], "always"
    if within := _WITHIN.search(shown):
        if within[1] is not None and int(within[1]) == 0:
            reader.problem(
                reader.piece(line, begin + within.start(), within[0]),
                "nothing can happen within 0 scans: give it at least 1",
            )
            return None
        rest = text[within.end() :]
        if rest.strip():
            reader.problem(reader.piece(line, begin + within.end(), rest), "nothing but `until ...` comes after `within ...`")  # fmt: skip
            return None
        scans = None if within[1] is None else int(within[1])
        time = None if within[2] is None else reader.piece(line, begin + within.start(2), within[2])
        text, shown, form = text[: within.start()], shown[: within.start()], "within"
    stays = _STAYS.search(shown)
    if stays and form == "end":
        form = "always"
    if modal := _MODAL.match(shown):
        if form == "within":
            reader.problem(whole, f"`{modal[1].lower()}` has no `within`: {_HOW}")
            return None
        form, start = modal[1].lower(), modal.end()
    forms: dict[str, Form] = {"end": "end", "within": "within", "always": "always", "never": "never"}
    about = reader.piece(line, begin + start, text[start:])
    if stays:
        shift, compared = _compared(text[start : stays.start()], text[stays.end() :])
        about = reader.piece(line, begin + start - shift, compared)
    return Requirement(whole.text, whole.span, forms[form], about, recovery, scans, time, until)
