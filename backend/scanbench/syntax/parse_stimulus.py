"""A table of inputs -> tree: a CSV file whose first column counts scans or time, and whose others are variables.

# repeat 3s
time;   %IX0.0; level
0;      FALSE;  10
T#1.5s; TRUE;
"""

import csv
import re
from contextlib import suppress

from scanbench.problems import Problem, Span
from scanbench.syntax import tree
from scanbench.syntax.literals import duration
from scanbench.syntax.source import Source

MAX_PROBLEMS = 20
"""Of one file: who wrote one wrong row has written many."""
MAX_ROWS = 1_000_000
_LAST = (1 << 63) - 1
"""Moments are numbers of 64 bits, and so is the moment that never comes."""
_REPEAT = re.compile(r"#\s*repeat\b\s*(.*)", re.IGNORECASE)
_UNITS = ("scan", "time")
_PLAIN = re.compile(r"\d+(\.\d+)?")


class _Refused(Exception):
    """The file cannot be used. The reasons have been added to the problems."""


def parse_stimulus(source: Source) -> tuple[tree.File, list[Problem]]:
    """The table, when it has a heading; and every problem on the way."""
    parser = _Parser(source)
    file = tree.File(source.name)
    with suppress(_Refused):
        file.stimuli.append(parser.table())
    return file, parser.problems


def cells(line: str, delimiter: str) -> list[str]:
    """The cells of a row; one in double quotes may hold the delimiter."""
    if '"' not in line:
        return [each.strip() for each in line.split(delimiter)]
    return [each.strip() for each in next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))]


def cell_span(stimulus: tree.Stimulus, row: int, column: int) -> Span:
    """The span of a cell, computed only when a problem is reported for it. Column 0 is the first variable."""
    line = stimulus.lines[row]
    text = stimulus.text.split("\n")[line - 1]
    parts = text.split(stimulus.delimiter)
    if '"' in text or column + 1 >= len(parts):
        return Span(stimulus.file, line, 1, line, len(text) + 1)
    start = sum(len(part) + 1 for part in parts[: column + 1])
    part = parts[column + 1]
    start += len(part) - len(part.lstrip())
    return Span(stimulus.file, line, start + 1, line, start + 1 + max(len(part.strip()), 1))


class _Parser:
    def __init__(self, source: Source) -> None:
        self.source = source
        self.problems: list[Problem] = []
        self.repeat: tuple[str, Span] | None = None

    def table(self) -> tree.Stimulus:
        """The heading, then row by row."""
        made: tree.Stimulus | None = None
        start = 0
        for number, line in enumerate(self.source.text.split("\n"), 1):
            text = line.strip()
            if text.startswith("#"):
                self._comment(text, start, len(line))
            elif made is None and text.strip(";, "):
                made = self._heading(line, start)
            elif made is not None and text.strip(f"{made.delimiter} "):
                self._row(made, line, start, number)
            start += len(line) + 1
        if made is None:
            raise self._refuse(
                "This file has no heading. Write the first row like `scan; %IX0.0; level`, or with `time`.", 0, 1
            )
        if not made.moments and self.problems:
            raise _Refused
        if not made.moments:
            raise self._refuse("This file has no rows below its heading.", 0, 1)
        self._close(made)
        return made

    def _comment(self, text: str, start: int, length: int) -> None:
        option = _REPEAT.fullmatch(text)
        if option is not None:
            self.repeat = option.group(1).strip(), self.source.span(start, start + max(length, 1))

    def _heading(self, line: str, start: int) -> tree.Stimulus:
        delimiter = ";" if ";" in line else ","
        first, *names = cells(line, delimiter)
        if first.lower() not in _UNITS:
            raise self._refuse(
                f"The first column is `scan` or `time`, not `{first}`.",
                start,
                start + len(line.partition(delimiter)[0]),
            )
        while names and not names[-1]:
            names.pop()
        if not names:
            raise self._refuse(
                "There are no variables in the heading: write them after the first column.", start, start + 1
            )
        columns, at = [], start + len(line.partition(delimiter)[0]) + 1
        for text, part in zip(names, line[at - start :].split(delimiter), strict=False):
            begin = at + len(part) - len(part.lstrip())
            columns.append((text, self.source.span(begin, begin + max(len(text), 1))))
            at += len(part) + 1
        by_time, where = first.lower() == "time", self.source.span(start, start + 1)
        return tree.Stimulus(self.source.name, self.source.text, by_time, delimiter, tuple(columns), where)

    def _row(self, made: tree.Stimulus, line: str, start: int, number: int) -> None:
        if len(self.problems) >= MAX_PROBLEMS:
            return
        moment, *values = cells(line, made.delimiter)
        while len(values) > len(made.columns) and not values[-1]:
            values.pop()
        end = start + len(line)
        if len(values) > len(made.columns):
            self._problem(f"This row has {len(values) + 1} cells, the heading {len(made.columns) + 1}.", start, end)
            return
        if len(made.moments) >= MAX_ROWS:
            self._problem(f"A file has at most {MAX_ROWS:,} rows; split it up.", start, end)
            return
        moment_end = start + len(line.partition(made.delimiter)[0])
        try:
            at = _moment(made.by_time, moment)
        except ValueError as error:
            self._problem(f"`{moment}` is no {'time' if made.by_time else 'scan'}: {error}.", start, moment_end)
            return
        if made.moments and at <= made.moments[-1]:
            self._problem(
                f"Rows are in ascending order, and `{moment}` is not after that of line {made.lines[-1]}.",
                start,
                moment_end,
            )
            return
        made.moments.append(at)
        made.lines.append(number)
        made.rows.append(values)

    def _close(self, made: tree.Stimulus) -> None:
        """Sets the period of a table that repeats: the last row lasts as long as the one before, unless the file says."""
        if self.repeat is None:
            return
        text, span = self.repeat
        last = made.moments[-1]
        if not text:
            if len(made.moments) < 2:
                self.problems.append(Problem("S003", "Say how long one round is, as in `# repeat 3s`.", span))
                return
            made.period = last + (last - made.moments[-2])
            return
        try:
            made.period = _moment(made.by_time, text)
        except ValueError as error:
            self.problems.append(Problem("S003", f"`{text}` is no length of a round: {error}.", span))
            return
        if made.period <= last:
            self.problems.append(Problem("S003", f"A round of `{text}` ends before the last row comes.", span))

    def _problem(self, message: str, start: int, end: int) -> None:
        self.problems.append(Problem("S003", message, self.source.span(start, max(end, start + 1))))

    def _refuse(self, message: str, start: int, end: int) -> _Refused:
        self._problem(message, start, end)
        return _Refused()


def _moment(by_time: bool, text: str) -> int:
    """The scan, or the time in ns."""
    if not by_time:
        if not text.isdecimal():
            raise ValueError("write a number of scans, from 0 on")
        if len(text.lstrip("0")) > len(str(_LAST)) or int(text) > _LAST:
            raise ValueError(f"no run gets further than scan {_LAST:,}")
        return int(text)
    plain = text.upper()
    for prefix in ("LTIME#", "TIME#", "LT#", "T#"):
        plain = plain.removeprefix(prefix)
    if _PLAIN.fullmatch(plain):
        plain += "ms"
    made = duration(plain)
    if made < 0:
        raise ValueError("it counts from the start of the program, so it is not negative")
    return made
