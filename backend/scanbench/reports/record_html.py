"""A test record as one HTML file that needs nothing else: to be read, printed and signed."""

from collections.abc import Iterator, Sequence
from html import escape
from itertools import groupby

from scanbench.faults.reaction.reaction import FINDINGS, UNGRADED, WORST_FIRST, Difference, Reaction, Verdict
from scanbench.reports.page import Page, moment, table, td, th, tr
from scanbench.reports.reason import evidence_of
from scanbench.reports.record import (
    Missed,
    RecordCell,
    RecordError,
    RecordProblem,
    RecordSweep,
    TestRecord,
)
from scanbench.reports.record_text import FoldedLine, Language, folded
from scanbench.reports.record_words import WORDS
from scanbench.reports.required_words import evidence
from scanbench.syntax.requirements import REQUIREMENTS

SHOWN = 8
"""Readers, and outputs, of one error; the XML has them all."""


def to_html(record: TestRecord, language: Language = "en") -> str:
    """The whole document."""
    return _Document(record, language).text()


class _Document:
    def __init__(self, record: TestRecord, language: Language) -> None:
        self._record, self._page = record, Page(language, WORDS)
        self._word = self._page.word

    def text(self) -> str:
        parts = [
            self._head(), self._summary(), self._findings(), self._untested(), self._table(), *self._sweeps(),
            self._required(), self._log(), self._sign(),
        ]  # fmt: skip
        return self._page.document(self._record.title, parts)

    # ---- head and summary -----------------------------------------------------------------------------------------

    def _head(self) -> str:
        head = self._record.head
        pairs = [
            ("project", head.project), ("instance", head.instance), ("model", head.model),
            ("version", str(head.program_version)), ("written", f"{moment(head.exported_at)} UTC"),
            ("by", head.exported_by), ("tool", head.tool),
        ]  # fmt: skip
        hash_ = f'<dt>{self._word("hash")}</dt><dd class="wide mono">{escape(head.program_hash) or "–"}</dd>'
        return self._page.head(((name, escape(value)) for name, value in pairs), hash_)

    def _summary(self) -> str:
        told = self._record.summary
        verdicts = [each for each in reversed(WORST_FIRST) if told.verdicts[each] or each not in UNGRADED]
        numbers = [
            (self._word("errors"), "", told.errors), (self._word("tested"), "", told.tested),
            (self._word("untested"), "", told.errors - told.tested), (self._word("generated_now"), "", told.generated),
            *((self._word(verdict), f"verdict {verdict}", told.verdicts[verdict]) for verdict in verdicts),
            (self._word("unknown"), "verdict unknown", told.unknown), (self._word("accepted"), "", told.accepted),
            (self._word("open"), "", told.open),
        ]  # fmt: skip
        items = "".join(f'<li><b>{count}</b><span class="{mark}">{word}</span></li>' for word, mark, count in numbers)
        meanings = "".join(
            f'<dt class="verdict {verdict}">{self._word(verdict)}</dt><dd>{self._word(f"mean_{verdict}")}</dd>'
            for verdict in verdicts
        )
        return (
            f'<h2>{self._word("summary")}</h2>\n<ul class="numbers">{items}</ul>\n'
            f'<h3>{self._word("meaning")}</h3>\n<dl class="meaning">{meanings}</dl>\n'
        )

    # ---- findings -------------------------------------------------------------------------------------------------

    def _findings(self) -> str:
        found, problems = self._record.missed, self._record.problems
        if not found and not problems:
            tested = self._record.summary.tested
            return f"<h2>{self._word('findings')}</h2>\n<p>{self._word('no_findings' if tested else 'nothing_tested')}</p>\n"
        rows = [*map(self._finding_row, found), *map(self._problem_row, problems)]
        heads = ("error", "code", "severity", "state", "verdict", "status", "reason")
        return f"<h2>{self._word('findings')}</h2>\n{self._page.table(heads, rows)}"

    def _finding_row(self, missed: Missed) -> str:
        error, one = missed.error, missed.accepted
        accepted = escape(missed.why if one is None else f"{one.reason} ({one.by}, {moment(one.at)})")
        word = self._word("finding_open" if one is None else "finding_accepted")
        return tr(
            f'<th scope="row">{escape(error.name)}</th>', td(error.code, "mono"), td(self._page.plain(error.severity)),
            td(missed.state or self._page.plain("on_plc")), f"<td>{self._missed_verdict(missed)}{self._unmet(missed.unmet)}</td>",
            f"<td>{word}</td>", f"<td>{accepted}</td>",
        )  # fmt: skip

    def _problem_row(self, problem: RecordProblem) -> str:
        return tr(
            f'<th scope="row">{REQUIREMENTS}:{problem.line}:{problem.column}</th>', td(None), td(None), td(None),
            f"<td>{self._untried_sign()}</td>", f"<td>{self._word('finding_open')}</td>", td(problem.message),
        )  # fmt: skip

    def _missed_verdict(self, missed: Missed) -> str:
        return self._untried_sign() if missed.verdict is None else self._verdict(missed.verdict)

    def _untried_sign(self) -> str:
        return f'<span class="verdict failed">{self._word("not_tried")}</span>'

    def _untested(self) -> str:
        names = [error for error in self._record.errors if not self._record.tested(error)]
        if not names:
            return f"<h2>{self._word('not_tested')}</h2>\n<p>{self._word('all_tested')}</p>\n"
        listed = ", ".join(
            f'{escape(error.name)} <span class="mono faint">{escape(error.code)}</span>' for error in names
        )
        return f"<h2>{self._word('not_tested')} ({len(names)})</h2>\n<p>{listed}</p>\n"

    # ---- every error ----------------------------------------------------------------------------------------------

    def _table(self) -> str:
        heads = (
            "error", "code", "flag", "severity", "status", "when", "count", "verdict", "scans", "read_by", "outputs",
        )  # fmt: skip
        rows = []
        for group, errors in groupby(self._record.errors, key=lambda error: error.group):
            rows.append(f'<tr class="group"><th scope="colgroup" colspan="{len(heads)}">{escape(group)}</th></tr>\n')
            rows += map(self._error_row, errors)
        return (
            f"<h2>{self._word('table')}</h2>\n{self._page.table(heads, rows)}"
            f'<p class="faint">{self._word("scans_hint")}</p>\n'
        )

    def _error_row(self, error: RecordError) -> str:
        finding, reaction = self._record.finding(error), error.reaction
        name = f'<th scope="row">{escape(error.name)}'
        if error.details:
            name += f'<br><span class="faint">{escape(error.details_text or error.details)}</span>'
        verdict = self._verdict(finding.verdict) if self._record.tested(error) else ""
        if finding.where == "sweep":
            verdict += f'<br><span class="faint">{self._word("in_sweep")}</span>'
        note = error.reaction_note or ("" if reaction is None else reaction.note)
        if reaction is not None and finding.where == "plc":
            verdict += "".join(f'<br><span class="mono faint">{escape(each)}</span>' for each in evidence_of(reaction))
        if note:
            verdict += f'<br><span class="faint">{escape(note)}</span>'
        return tr(
            f"{name}</th>", td(error.code, "mono"), td(error.flag, "mono"), td(self._page.plain(error.severity)),
            td(self._page.plain(error.status)), f'<td class="when">{self._when(error)}</td>', td(error.count or None, "num"),
            f"<td>{verdict}</td>", td(finding.scans, "num"), f'<td class="mono places">{self._readers(reaction)}</td>',
            f'<td class="mono places">{self._outputs(() if reaction is None else reaction.differences)}</td>',
        )  # fmt: skip

    def _when(self, error: RecordError) -> str:
        lines = []
        for at, scan in ((error.generated_at, error.generated_scan), (error.recovered_at, error.recovered_scan)):
            if at is not None:
                before = "" if scan is None else f' <span class="faint">{self._word("scan")} {scan}</span>'
                lines.append(f"{moment(at)}{before}")
        if error.by:
            origin = {"plc": "origin_plc", "program": "origin_program"}.get(error.origin or "")
            lines.append(self._word(origin) if origin else escape(error.by))
        return "<br>".join(lines)

    def _readers(self, reaction: Reaction | None) -> str:
        return self._shortened([escape(place) for place in (() if reaction is None else reaction.reader_places)])

    def _outputs(self, differences: Sequence[Difference]) -> str:
        return self._shortened([escape(f"{each.path}: {each.without} → {each.value}") for each in differences])

    def _shortened(self, items: Sequence[str]) -> str:
        shown = list(items[:SHOWN])
        if len(items) > SHOWN:
            shown.append(self._word("and_more", count=len(items) - SHOWN))
        return "<br>".join(shown)

    # ---- sweeps and log -------------------------------------------------------------------------------------------

    def _sweeps(self) -> list[str]:
        return [self._sweep(sweep) for sweep in self._record.sweeps]

    def _sweep(self, sweep: RecordSweep) -> str:
        errors = {error.id: error for error in self._record.errors}
        cells: dict[str, dict[str, RecordCell]] = {}
        for cell in sweep.cells:
            cells.setdefault(cell.error, {})[cell.state] = cell
        text = self._word(
            "sweep_text", window=sweep.window, status=self._page.plain(sweep.status), by=sweep.by, at=moment(sweep.at)
        )
        heads = "".join(map(th, (self._word("error"), *map(escape, sweep.states))))
        rows = [
            tr(
                f'<th scope="row">{escape(errors[id].name if id in errors else id)}</th>',
                *(self._found(by.get(state), errors.get(id)) for state in sweep.states),
            )
            for id, by in cells.items()
        ]
        return f"<h2>{self._word('sweep')}: {escape(sweep.instance)}</h2>\n<p>{text}</p>\n{table(heads, rows)}"

    def _found(self, cell: RecordCell | None, error: RecordError | None) -> str:
        if cell is None:
            return "<td></td>"
        if cell.verdict is None:
            return f'<td><span class="verdict unknown">{self._word("not_raised")}</span><br>{escape(cell.note)}{self._unmet(cell.unmet)}</td>'
        scans = "" if cell.scans is None else f' <span class="faint">{cell.scans}</span>'
        missed = error is not None and cell.verdict in FINDINGS and error.accepted_in(cell.state) is not None
        accepted = f'<br><span class="faint">{self._word("finding_accepted")}</span>' if missed else ""
        return f"<td>{self._verdict(cell.verdict)}{scans}{accepted}{self._unmet(cell.unmet)}</td>"

    def _unmet(self, count: int) -> str:
        return f'<br><span class="verdict failed">{self._word("unmet", count=count)}</span>' if count else ""

    def _required(self) -> str:
        """What the project requires, of the errors that were raised on the PLC itself."""
        rows = [
            self._required_row(error, *each)
            for error in self._record.errors if error.reaction is not None for each in self._judged(error.reaction)
        ]  # fmt: skip
        heads = ("error", "required", "outcome", "why")
        return f"<h2>{self._word('requirements')}</h2>\n{self._page.table(heads, rows)}" if rows else ""

    def _judged(self, reaction: Reaction) -> Iterator[tuple[str, str, str]]:
        for one in reaction.restarts:
            rule = self._word("no_restart")
            text = self._page.plain("restarted").format(path=one.path, scan=one.scan)
            yield rule, "passed" if one.allowed_by else "failed", f"{text} {one.allowed_by}".strip()
        for each in reaction.required:
            yield f"<code>{escape(each.text)}</code>", each.outcome, evidence(each)

    def _required_row(self, error: RecordError, rule: str, outcome: str, why: str) -> str:
        sign = f'<span class="verdict {outcome}">{self._word(f"required_{outcome}")}</span>'
        return tr(f'<th scope="row">{escape(error.name)}</th>', f"<td>{rule}</td>", f"<td>{sign}</td>", td(why))

    def _log(self) -> str:
        if not self._record.log:
            return ""
        rows = map(self._line, folded(self._record.log))
        return f"<h2>{self._word('log')}</h2>\n{self._page.table(('time', 'scan', 'by', 'text'), rows)}"

    def _line(self, line: FoldedLine) -> str:
        first, last, text = line.first, line.last, "; ".join(line.texts)
        if line.times == 1:
            return tr(td(moment(first.at), "mono"), td(first.scan, "num"), td(first.by), td(text))
        times = self._word("times", count=line.times)
        return tr(
            f'<td class="mono">{moment(first.at)}<br>– {moment(last.at)}</td>',
            f'<td class="num">{first.scan}<br>– {last.scan}</td>', td(first.by),
            f"<td>{escape(text)} <b>({times})</b></td>",
        )  # fmt: skip

    def _sign(self) -> str:
        boxes = "".join(
            f"<div><b>{self._word(who)}</b><p><span>{self._word('signature')}</span><span>{self._word('date')}</span></p></div>"
            for who in ("tested_by", "approved_by")
        )
        return f'<h2>{self._word("sign")}</h2>\n<div class="sign">{boxes}</div>\n'

    # ---- parts ----------------------------------------------------------------------------------------------------

    def _verdict(self, verdict: Verdict | None) -> str:
        return f'<span class="verdict {verdict or "unknown"}">{self._word(verdict or "unknown")}</span>'
