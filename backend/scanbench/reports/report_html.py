"""A verification as one HTML file that needs nothing else: to be read, printed and kept with a build."""

from collections.abc import Iterable, Iterator, Sequence
from html import escape

from scanbench.reports.page import Page, table, td, th, tr
from scanbench.reports.record_text import Language
from scanbench.reports.report import CONTEXT, Report
from scanbench.reports.report_words import WORDS
from scanbench.reports.value_text import column_of, differing_bits, value_text
from scanbench.verify.contract import Column, Mismatch, Output, Place, Row

DIFFERENCES = 50
"""Differences that have a section of their own."""
ROWS = 500
SAME = 20
"""Rows that are shown where none differs."""
OUTPUTS, INPUTS = 8, 8
"""Columns that fit a page; CSV and JSON have them all."""
_BITS = 64
"""Bits up to which a value is written out."""


def to_html(report: Report, language: Language = "en") -> str:
    """The whole document."""
    return _Document(report, language).text()


class _Document:
    def __init__(self, report: Report, language: Language) -> None:
        self._report, self._page = report, Page(language, WORDS)
        self._word = self._page.word
        self._differences = report.differences()

    def text(self) -> str:
        head = self._report.head
        parts = (self._head(), self._verdict(), *self._sections(), self._coverage(), self._table())
        return self._page.document(f"{head.project}, {head.title}", parts)

    # ---- head and verdict -----------------------------------------------------------------------------------------

    def _head(self) -> str:
        head = self._report.head
        source = self._word(head.source, name=head.trace) if head.source == "trace" else self._word(head.source)
        pairs = [
            ("project", escape(head.project)), ("instance", escape(head.instance)),
            ("model", escape(head.model)), ("version", str(head.version)),
            ("range", escape(head.title)), ("scans", f"{head.first} – {head.last}"),
            ("source", source), ("interval", f"{head.interval_ns / 1e6:g} ms"),
            ("written", escape(_moment(head.when))), ("by", escape(head.by)), ("tool", escape(head.tool)),
        ]  # fmt: skip
        return self._page.head(pairs)

    def _verdict(self) -> str:
        head = self._report.head
        if head.differing:
            mark, word = "differs", "differences_found"
        else:
            found = ("none", "no_difference_partly") if head.partly else ("same", "no_difference")
            mark, word = found if head.compared and not self._report.idle else ("none", "nothing_compared")
        numbers = [("compared", head.compared), ("skipped", head.skipped), ("differing", head.differing)]
        items = "".join(f"<li><b>{count:,}</b>{self._word(name)}</li>" for name, count in numbers)
        skipped = ", ".join(str(first) if first == last else f"{first} – {last}" for first, last in head.stretches)
        notes = [self._word("skipped_text", stretches=skipped) if skipped else ""]
        if head.coverage is not None and head.coverage.ungiven:
            notes.append(self._word("ungiven_text"))
        if self._report.idle and not head.differing:
            notes.append(self._word("idle"))
        elif head.compared and not head.skipped and not head.not_reached:
            notes.append(self._word("all_compared"))
        if head.forgotten:
            notes.append(self._word("forgotten", count=f"{head.forgotten:,}"))
        notes.append(escape(head.note))
        told = " ".join(filter(None, notes))
        return (
            f'<h2>{self._word("verdict")}</h2>\n<p class="result {mark}">{self._word(word)}</p>\n'
            f'<ul class="numbers">{items}</ul>\n<p>{told}</p>\n<p class="faint">{self._word("what")}</p>\n'
        )

    # ---- differences ----------------------------------------------------------------------------------------------

    def _sections(self) -> Iterator[str]:
        if not self._differences:
            return
        yield f"<h2>{self._word('differences')}</h2>\n"
        for row, difference in self._differences[:DIFFERENCES]:
            yield self._section(row, difference)
        more = len(self._differences) - DIFFERENCES
        if more > 0:
            yield f'<p class="faint">{self._word("more_differences", count=f"{more:,}")}</p>\n'

    def _section(self, row: Row, difference: Mismatch) -> str:
        column = column_of(difference, self._report.columns)
        nothing = self._page.plain("nothing")
        bits = differing_bits(difference.control, difference.monitor)
        pairs = [
            ("control_long", _value(column, difference.control, nothing, bits)),
            ("monitor_long", _value(column, difference.monitor, nothing, bits)),
        ]
        if bits:
            pairs.append(("bits", f'<span class="mono">{_numbers(bits)}</span>'))
        pairs.append(("cause", self._word(difference.cause)))
        pairs.append(("disturbance", escape("; ".join(row.disturbances)) or self._word("no_disturbance")))
        if difference.place is not None:
            pairs.append(("place", _place(difference.place)))
            pairs.append(("task", escape(difference.place.task) or escape(nothing)))
        rows = self._page.pairs(pairs)
        call = f", {self._word('call').lower()} {row.call}" if row.call > 1 else ""
        source = difference.place.text if difference.place is not None else ""
        code = f'<pre class="mono">{escape(source)}</pre>' if source else ""
        return (
            f'<section><h3>{self._word("scan")} {row.scan}{call}: <span class="mono">{escape(difference.name)}</span></h3>\n'
            f"<p>{escape(difference.message)}</p>\n<dl>{rows}</dl>{code}</section>\n"
        )

    def _coverage(self) -> str:
        """What of a trace was compared, and what was not."""
        coverage = self._report.head.coverage
        if coverage is None:
            return ""
        rows = [
            tr(
                td(each.path, "mono"), td(each.compared, "num"), td(each.differing, "num"), td(each.allowed, "num"),
                td(each.left_open, "num"), td(each.missing, "num"), td(f"{each.largest:.4g}", "num"),
            )
            for each in coverage.outputs
        ]  # fmt: skip
        heads = ("output", "values", "values_differ", "values_allowed", "values_open", "values_missing", "values_off")
        kinds = (
            ("given", coverage.inputs), ("ignored", coverage.ignored), ("unrecorded", coverage.unrecorded),
            ("assumed", coverage.assumed), ("remembered", coverage.remembered),
            ("ungiven", coverage.ungiven),
        )  # fmt: skip
        told = [(word, f'<span class="mono">{escape(", ".join(names))}</span>') for word, names in kinds if names]
        return f"<h2>{self._word('coverage')}</h2>\n{self._page.table(heads, rows)}<dl>{self._page.pairs(told)}</dl>\n"

    # ---- rows -----------------------------------------------------------------------------------------------------

    def _table(self) -> str:
        rows, title = self._around(), "rows" if self._differences else "rows_same"
        if not rows:
            return ""
        outputs, inputs, left_out = self._shown()
        body = [self._row(row, outputs, inputs) for row in rows[:ROWS]]
        notes = []
        if left_out:
            notes.append(self._word("columns_left_out", count=left_out))
        if len(rows) > ROWS:
            notes.append(self._word("rows_left_out", count=f"{len(rows) - ROWS:,}"))
        return (
            f"<h2>{self._word(title)}</h2>\n{table(self._heads(outputs, inputs), body, 'values')}"
            f'<p class="faint">{" ".join(notes)}</p>\n'
        )

    def _around(self) -> list[Row]:
        """The rows that differ, with a few on either side; where none does, the last ones."""
        rows = self._report.rows
        if not self._differences:
            return [*rows[-SAME:]]
        near: dict[int, None] = {}
        for index, row in enumerate(rows):
            if row.differs:
                near |= dict.fromkeys(range(max(index - CONTEXT, 0), min(index + CONTEXT + 1, len(rows))))
        return [rows[index] for index in near]

    def _heads(self, outputs: Sequence[Column], inputs: Sequence[Column]) -> str:
        def over(word: str) -> str:
            return f'<th scope="col" rowspan="2">{self._word(word)}</th>'

        names = "".join(f'<th scope="colgroup" colspan="2">{escape(each.name)}</th>' for each in outputs)
        group = f'<th scope="colgroup" colspan="{len(inputs)}">{self._word("inputs")}</th>' if inputs else ""
        sides = (th(self._word("control")) + th(self._word("monitor"))) * len(outputs)
        used = "".join(f'<th scope="col" class="faint">{escape(each.name)}</th>' for each in inputs)
        first = "".join(map(over, ("scan", "call", "instance_path")))
        return f"<tr>{first}{names}{group}{over('note')}</tr><tr>{sides}{used}</tr>"

    def _shown(self) -> tuple[list[Column], list[Column], int]:
        """The columns that fit, those first that differ somewhere; and the number of those left out."""
        bad = {difference.name for _, difference in self._differences}
        names = sorted(self._report.ordered(), key=lambda each: each.name not in bad)
        outputs = [each for each in names if each.name in self._report.outputs]
        inputs = [each for each in names if each.name in self._report.inputs]
        left_out = max(len(outputs) - OUTPUTS, 0) + max(len(inputs) - INPUTS, 0)
        return outputs[:OUTPUTS], inputs[:INPUTS], left_out

    def _row(self, row: Row, outputs: Sequence[Column], inputs: Sequence[Column]) -> str:
        bad = {each.name for each in row.differences}
        cells = [
            td(row.scan, "num first"), td(row.call or None, "num"), td(row.instance, "mono"),
        ]  # fmt: skip
        for column in outputs:
            output = row.outputs.get(column.name)
            mark = " bad" if output is not None and column.name in bad and output.control != output.monitor else ""
            cells += _output_cells(column, output, mark)
        for column in inputs:
            given = row.inputs.get(column.name)
            if given is None:
                cells.append("<td></td>")
                continue
            text = escape(value_text(column, given.recorded))
            if given.expected is not None:
                text += f"<br>{self._word('expected', value=value_text(column, given.expected))}"
            if given.set is not None:
                text += f"<br>{self._word('was_set', value=value_text(column, given.set))}"
            mark = " bad" if given.expected is not None and column.name in bad else ""
            cells.append(f'<td class="value mono{mark}">{text}</td>')
        cells.append(td("; ".join((*row.disturbances, *filter(None, [row.note]))), "note"))
        return f'<tr class="{"differs" if row.differs else ""}">{"".join(cells)}</tr>\n'


def _output_cells(column: Column, output: Output | None, mark: str) -> tuple[str, str]:
    if output is None:
        return "<td></td>", "<td></td>"
    control, monitor = value_text(column, output.control), value_text(column, output.monitor)
    if output.set is not None:
        monitor = f"{monitor} → {value_text(column, output.set)}"
    return td(control, f"value mono{mark}"), td(monitor, "value mono")


def _value(column: Column, data: bytes, nothing: str, bits: Iterable[int]) -> str:
    """The value, and its bits, of which those that differ are marked."""
    if not data:
        return escape(nothing)
    text = f'<span class="mono">{escape(value_text(column, data))}'
    if column.kind == "bool" or 8 * len(data) > _BITS:
        return f"{text}</span>"
    marked, number, digits = set(bits), int.from_bytes(data, "little"), ""
    for bit in range(8 * len(data) - 1, -1, -1):
        digit = str(number >> bit & 1)
        digits += f"<mark>{digit}</mark>" if bit in marked else digit
        digits += " " if bit and bit % 4 == 0 else ""
    return f'{text} <span class="faint">{digits}</span></span>'


def _moment(iso: str) -> str:
    """To the second, for people."""
    return f"{iso[:10]} {iso[11:19]} UTC" if iso.endswith("Z") else iso


def _numbers(bits: Sequence[int]) -> str:
    shown = ", ".join(map(str, bits[:_BITS]))
    return f"{shown}, …" if len(bits) > _BITS else shown


def _place(place: Place) -> str:
    where = f"{place.file}:{place.line}" if place.file else ""
    pou = f" ({place.pou})" if place.pou and place.pou != place.instance else ""
    return f'<span class="mono">{escape(where)}</span> {escape(place.instance)}{escape(pou)}'
