"""The rows of a verification as CSV: the scan, A and A' of every output side by side, the inputs, what differs."""

import csv
import io
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from scanbench.reports.report import Report
from scanbench.reports.value_text import value_text
from scanbench.symbols.values import Format
from scanbench.verify.contract import Column, Input, Output, Row

PIECE = 1 << 18
"""Characters that are made at a time."""
FIRST = ("scan", "call", "kind", "instance", "statement", "differs")
LAST = ("differences", "disturbances", "note")


@dataclass(frozen=True, slots=True)
class _Field:
    """A column of the file."""

    head: str
    of: Callable[[Row], bytes | None]
    column: Column
    format: Format

    def text(self, row: Row) -> str:
        return _guarded(value_text(self.column, self.of(row), self.format))


def to_csv(
    report: Report, formats: Mapping[str, Format] | None = None, shown: Sequence[str] | None = None
) -> Iterator[str]:
    """The text, piece by piece. `formats` by the names of columns; `shown`: only these columns, in this order, inputs
    after outputs."""
    fields = _fields(report, formats or {}, shown)
    out = io.StringIO()
    write = csv.writer(out, lineterminator="\r\n").writerow
    write([*FIRST, *(_guarded(each.head) for each in fields), *LAST])
    for row in report.rows:
        statement = "" if row.place is None else f"{row.place.file}:{row.place.line}"
        write([
            row.scan, row.call or "", row.kind, _guarded(row.instance), _guarded(statement),
            "yes" if row.differs else "" if row.compared else "not compared", *(each.text(row) for each in fields),
            _guarded("; ".join(each.message for each in row.differences)),
            _guarded("; ".join(row.disturbances)), _guarded(row.note),
        ])  # fmt: skip
        if out.tell() > PIECE:
            yield _taken(out)
    yield _taken(out)


def _fields(report: Report, formats: Mapping[str, Format], shown: Sequence[str] | None) -> list[_Field]:
    known = {each.name: each for each in report.ordered()}
    chosen = list(known.values()) if shown is None else [known[name] for name in shown if name in known]
    edited = any(each.set is not None for row in report.rows for each in row.outputs.values())
    fields: list[_Field] = []
    for column in chosen:
        if column.name in report.outputs:
            fields += _output(column, formats.get(column.name, "default"), edited)
    for column in chosen:
        if column.name in report.inputs:
            fields += _input(report.rows, column, formats.get(column.name, "default"))
    return fields


def _output(column: Column, format: Format, edited: bool) -> Iterator[_Field]:
    def of(get: Callable[[Output], bytes | None]) -> Callable[[Row], bytes | None]:
        return lambda row: get(row.outputs[column.name]) if column.name in row.outputs else None

    yield _Field(f"{column.name} A", of(lambda each: each.control), column, format)
    yield _Field(f"{column.name} A'", of(lambda each: each.monitor), column, format)
    if edited:
        yield _Field(f"{column.name} A' set", of(lambda each: each.set), column, format)


def _input(rows: Sequence[Row], column: Column, format: Format) -> Iterator[_Field]:
    """The value that was used; what was expected, or set, where there is any such."""

    def of(get: Callable[[Input], bytes | None]) -> Callable[[Row], bytes | None]:
        return lambda row: get(row.inputs[column.name]) if column.name in row.inputs else None

    yield _Field(f"{column.name} in", of(lambda each: each.recorded), column, format)
    given = [row.inputs[column.name] for row in rows if column.name in row.inputs]
    if any(each.expected is not None for each in given):
        yield _Field(f"{column.name} in expected", of(lambda each: each.expected), column, format)
    if any(each.set is not None for each in given):
        yield _Field(f"{column.name} in set", of(lambda each: each.set), column, format)


def _taken(out: io.StringIO) -> str:
    text = out.getvalue()
    out.seek(0)
    out.truncate()
    return text


def _guarded(text: str) -> str:
    """A spreadsheet takes a field that begins like this for a formula; a number is none."""
    if text[:1] in ("+", "-"):
        try:
            float(text)
        except ValueError:
            return f"'{text}"
    return f"'{text}" if text.startswith(("=", "@")) else text
