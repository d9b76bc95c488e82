"""`scanbench check --report`: what a program is made of, and how much of it is supported."""

import re
from bisect import bisect
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from scanbench.problems import Problem, Severity
from scanbench.syntax import tree
from scanbench.syntax.constructs import count_constructs
from scanbench.syntax.parse_file import parse_file
from scanbench.syntax.source import Source

REFUSED = "X001"
OF_THE_WHOLE = "D011"
"""No program: an error of no POU."""


@dataclass(frozen=True, slots=True)
class FileReport:
    """One file: constructs that are supported by name, refused ones by message, and other errors."""

    name: str
    pous: int
    clean: int
    """POUs without an error of their own. Such a POU may still use one that has an error."""
    run: int
    """POUs that would run: neither they nor anything that they use has an error."""
    supported: Counter[str]
    refused: Counter[str]
    errors: int


@dataclass(slots=True)
class _Unit:
    """One declaration: a POU, a type, a list of globals."""

    line: int
    names: tuple[str, ...]
    """What others use of it, in upper case."""
    is_pou: bool
    wrong: bool = False
    words: set[str] = field(default_factory=set)
    """All words in its text, in upper case."""


WORD = re.compile(r"[A-Za-z_]\w*")


def report_files(texts: Mapping[str, str], problems: Sequence[Problem]) -> list[FileReport]:
    """A report of every file, by the problems that its check found."""
    files = {name: parse_file(Source(name, text))[0] for name, text in texts.items()}
    errors = [each for each in problems if each.severity is Severity.ERROR]
    units = {name: _units(file, texts[name], errors) for name, file in files.items()}
    stopped = _stopped([each for own in units.values() for each in own])
    made = []
    for name, file in files.items():
        own = [each for each in errors if each.span.file == name]
        refused = Counter(each.message for each in own if each.code == REFUSED)
        pous = [each for each in units[name] if each.is_pou]
        clean = sum(not each.wrong for each in pous)
        run = sum(id(each) not in stopped for each in pous)
        others = len(own) - refused.total()
        made.append(FileReport(name, len(pous), clean, run, count_constructs(file), refused, others))
    return made


def _units(file: tree.File, text: str, errors: Sequence[Problem]) -> list[_Unit]:
    """What a file declares, in order, with the errors that are in the lines of each."""
    made = [_Unit(each.span.line, (each.name.upper(),), is_pou=True) for each in file.pous]
    made += [_Unit(each.span.line, (each.name.upper(),), is_pou=False) for each in file.types]
    for section in file.globals:
        made.append(_Unit(section.span.line, tuple(each.name.upper() for each in section.variables), is_pou=False))
    made.sort(key=lambda each: each.line)
    begins = [each.line for each in made]
    for error in errors:
        at = bisect(begins, error.span.line) - 1
        if error.span.file == file.name and at >= 0 and error.code != OF_THE_WHOLE:
            made[at].wrong = True
    lines = text.split("\n")
    for each, end in zip(made, [*begins[1:], len(lines) + 1], strict=True):
        each.words = {word.upper() for word in WORD.findall("\n".join(lines[each.line - 1 : end - 1]))}
    return made


def _stopped(units: Sequence[_Unit]) -> set[int]:
    """The units, by identity, that have an error or use what has one, by whatever way."""
    users: dict[str, list[_Unit]] = {}
    for each in units:
        for word in each.words:
            users.setdefault(word, []).append(each)
    open_ = [each for each in units if each.wrong]
    stopped = {id(each) for each in open_}
    while open_:
        for name in open_.pop().names:
            for user in users.get(name, ()):
                if id(user) not in stopped:
                    stopped.add(id(user))
                    open_.append(user)
    return stopped


def report_lines(reports: Sequence[FileReport]) -> list[str]:
    """For people: a line a file, how many POUs are whole, then what was refused, then what the program uses."""
    width = max(len(each.name) for each in reports)
    whole = _sum(reports)
    lines = [f"{'file':{width}}  POUs  run  without errors  constructs  refused  other errors"]
    for each in [*reports, whole] if len(reports) > 1 else reports:
        lines.append(
            f"{each.name:{width}}  {each.pous:4}  {each.run:3}  {each.clean:14}  {each.supported.total():10}  "
            f"{each.refused.total():7}  {each.errors:12}"
        )
    if whole.pous:
        lines += [
            "",
            f"{whole.run} of {whole.pous} POUs ({_share(whole.run, whole.pous)}) run: neither they nor what they use has an error",
            f"{whole.clean} of {whole.pous} POUs ({_share(whole.clean, whole.pous)}) have no error of their own",
        ]
    if whole.refused or whole.errors:
        lines.append("a program runs when none of its files has an error")
    if whole.refused:
        lines += ["", "refused:", *(f"{count:6}  {message}" for message, count in whole.refused.most_common())]
    if whole.errors:
        lines += ["", f"other errors: {whole.errors}; without --report each is listed with its place"]
    lines += ["", "in use:", *(f"{count:6}  {name}" for name, count in whole.supported.most_common())]
    return lines


def report_json(reports: Sequence[FileReport]) -> list[dict[str, object]]:
    """For machines: one object a file."""
    return [
        {
            "file": each.name,
            "supported": dict(each.supported),
            "refused": dict(each.refused),
            "other_errors": each.errors,
            "pous": each.pous,
            "pous_without_errors": each.clean,
            "pous_that_run": each.run,
        }
        for each in reports
    ]


def _sum(reports: Sequence[FileReport]) -> FileReport:
    supported: Counter[str] = Counter()
    refused: Counter[str] = Counter()
    for each in reports:
        supported += each.supported
        refused += each.refused
    pous, clean, run, errors = (
        sum(each) for each in zip(*((r.pous, r.clean, r.run, r.errors) for r in reports), strict=True)
    )
    return FileReport("all", pous, clean, run, supported, refused, errors)


def _share(part: int, whole: int) -> str:
    return f"{100 * part / whole:.1f} %"
