"""`scanbench check --report`: what a program is made of, and how much of it is supported."""

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
    supported: Counter[str]
    refused: Counter[str]
    errors: int

    @property
    def percent(self) -> float:
        """Share of the constructs that are supported."""
        total = self.supported.total() + self.refused.total()
        return 100.0 * self.supported.total() / total if total else 100.0


def report_files(texts: Mapping[str, str], problems: Sequence[Problem]) -> list[FileReport]:
    """A report of every file, by the problems that its check found."""
    made = []
    for name, text in texts.items():
        own = [each for each in problems if each.span.file == name and each.severity is Severity.ERROR]
        refused = Counter(each.message for each in own if each.code == REFUSED)
        constructs = count_constructs(parse_file(Source(name, text))[0])
        made.append(FileReport(name, constructs, refused, len(own) - refused.total()))
    return made


def report_lines(reports: Sequence[FileReport]) -> list[str]:
    """For people: a line a file, then what was refused, then what the program uses."""
    width = max(len(each.name) for each in reports)
    lines = [f"{'file':{width}}  supported  refused  other errors  percent"]
    for each in [*reports, _sum(reports)] if len(reports) > 1 else reports:
        lines.append(
            f"{each.name:{width}}  {each.supported.total():9}  {each.refused.total():7}  {each.errors:12}  "
            f"{each.percent:6.1f}%"
        )
    whole = _sum(reports)
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
            "percent": round(each.percent, 1),
        }
        for each in reports
    ]


def _sum(reports: Sequence[FileReport]) -> FileReport:
    supported: Counter[str] = Counter()
    refused: Counter[str] = Counter()
    for each in reports:
        supported += each.supported
        refused += each.refused
    return FileReport("all", supported, refused, sum(each.errors for each in reports))
