"""`scanbench check --report`: what a program is made of, and how much of it is supported."""

from bisect import bisect
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from scanbench.problems import Problem, Severity
from scanbench.syntax.constructs import count_constructs
from scanbench.syntax.parse_file import parse_file
from scanbench.syntax.source import Source

REFUSED = "X001"


@dataclass(frozen=True, slots=True)
class FileReport:
    """One file: constructs that are supported by name, refused ones by message, and other errors."""

    name: str
    pous: int
    clean: int
    """POUs without an error of their own. Such a POU may still use one that has an error."""
    supported: Counter[str]
    refused: Counter[str]
    errors: int


def report_files(texts: Mapping[str, str], problems: Sequence[Problem]) -> list[FileReport]:
    """A report of every file, by the problems that its check found."""
    made = []
    for name, text in texts.items():
        own = [each for each in problems if each.span.file == name and each.severity is Severity.ERROR]
        refused = Counter(each.message for each in own if each.code == REFUSED)
        file = parse_file(Source(name, text))[0]
        begins = sorted(pou.span.line for pou in file.pous)
        wrong = {bisect(begins, each.span.line) for each in own} - {0}
        made.append(
            FileReport(
                name, len(begins), len(begins) - len(wrong), count_constructs(file), refused, len(own) - refused.total()
            )
        )
    return made


def report_lines(reports: Sequence[FileReport]) -> list[str]:
    """For people: a line a file, how many POUs are whole, then what was refused, then what the program uses."""
    width = max(len(each.name) for each in reports)
    whole = _sum(reports)
    lines = [f"{'file':{width}}  POUs  without errors  constructs  refused  other errors"]
    for each in [*reports, whole] if len(reports) > 1 else reports:
        lines.append(
            f"{each.name:{width}}  {each.pous:4}  {each.clean:14}  {each.supported.total():10}  "
            f"{each.refused.total():7}  {each.errors:12}"
        )
    if whole.pous:
        lines += [
            "",
            f"{whole.clean} of {whole.pous} POUs ({100 * whole.clean / whole.pous:.1f} %) have no error of their own",
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
        }
        for each in reports
    ]


def _sum(reports: Sequence[FileReport]) -> FileReport:
    supported: Counter[str] = Counter()
    refused: Counter[str] = Counter()
    for each in reports:
        supported += each.supported
        refused += each.refused
    pous, clean, errors = (sum(each) for each in zip(*((r.pous, r.clean, r.errors) for r in reports), strict=True))
    return FileReport("all", pous, clean, supported, refused, errors)
