"""A sweep as a page to print or to send: one file, no scripts, nothing loaded from elsewhere."""

from collections.abc import Iterable, Iterator
from html import escape
from urllib.parse import quote

from scanbench.faults.reaction.reaction import Difference, Outcome, OutputRestart, Verdict
from scanbench.faults.reaction.required import REQUIRED, Required
from scanbench.faults.reaction.sweep import Cell
from scanbench.reports.page import Page, Words, table, td, th, tr
from scanbench.reports.reason import reason_of
from scanbench.reports.required_words import NOT_TRIED, OUTCOMES, evidence, outcome_of, restarted
from scanbench.reports.sweep_report import WORDS, SweepResult, count, reason, verdict_of

_ORDER: tuple[Outcome, ...] = ("failed", "not_checked", "passed")
_WORDS: Words = {"en": {"title": "Error sweep"}, "ja": {"title": "異常スイープ"}}


def sweep_page(result: SweepResult, at: str, required: Required = REQUIRED) -> str:
    """The page; `at` says when the sweep was made."""
    page, about = Page("en", _WORDS), f"{result.project} on {result.model}"
    parts = (
        f"<h1>{page.word('title')}: {escape(about)}</h1>\n",
        f'<p class="faint">{escape(at)} · every error alone, {result.window} scans, '
        "compared with the same run without it</p>\n",
        *_summary(result),
        *_matrix(result),
        *_findings(result, required),
        *_required(result),
        *_reactions(result, required),
    )
    return page.document(about, parts, "screen")


def _verdict(verdict: Verdict | None, before: str = "") -> str:
    """With its sign, which the style sheet gives it."""
    return f'<span class="verdict {verdict or "unknown"}">{before}{escape(WORDS[verdict])}</span>'


def _table(heads: Iterable[str], rows: Iterable[str]) -> str:
    return table("".join(map(th, map(escape, heads))), rows)


def _summary(result: SweepResult) -> Iterator[str]:
    items = [
        f"<li>{_verdict(verdict, f'{number} ')}</li>"
        for verdict in WORDS
        if (number := sum(verdict_of(cell) == verdict for cell in result.cells))
    ]
    yield f'<ul class="numbers">{"".join(items)}</ul>\n'


def _matrix(result: SweepResult) -> Iterator[str]:
    """Errors down, states across."""
    heads = map(th, ("Error", "Code", "Severity", *(escape(name) for name, _ in result.states)))
    scans = (td(f"before scan {scan}", "faint") for _, scan in result.states)
    yield "<h2>Errors and states</h2>\n"
    rows = (
        tr(
            f'<th scope="row">{escape(entry.name)} <code class="faint">{escape(error)}</code></th>',
            f"<td><code>{result.code(error)}</code></td>", td(entry.severity),
            *(_in_matrix(cell) for cell in result.cells if cell.error == error),
        )
        for error, entry in {cell.error: result.entry(cell) for cell in result.cells}.items()
    )  # fmt: skip
    yield table(tr(*heads) + tr(td(None) * 3, *scans), rows)


def _in_matrix(cell: Cell) -> str:
    verdict, reaction = verdict_of(cell), cell.reaction
    text = _verdict(verdict)
    if reaction is not None and reaction.first_effect is not None:
        text += f', <span class="faint">{count(reaction.first_effect, "scan")}</span>'
    link = f'<a href="#{_anchor(cell)}">{text}</a>' if verdict != "stopped" else text
    return f"<td>{link}</td>"


def _findings(result: SweepResult, required: Required) -> Iterator[str]:
    found = [cell for cell in result.cells if not _is_met(cell, required)]
    yield "<h2>Findings</h2>\n"
    if not found:
        yield "<p>Every error that leaves the program running did what is required.</p>\n"
        return
    yield _table(("Error", "State", "Verdict", "Why"), (_finding(result, cell) for cell in found))


def _is_met(cell: Cell, required: Required) -> bool:
    reaction = cell.reaction
    return reaction is not None and not reaction.unmet and required.met(cell.error, reaction.verdict, cell.point)


def _finding(result: SweepResult, cell: Cell) -> str:
    entry = result.entry(cell)
    about = f'<code class="faint">{result.code(cell.error)} {escape(entry.flag_text)}</code>'
    return (
        f'<tr id="{_anchor(cell)}"><th scope="row">{escape(entry.name)}<br>{about}</th>{td(cell.point)}'
        f"<td>{_verdict(verdict_of(cell))}</td>{td(reason(cell))}</tr>\n"
    )


def _required(result: SweepResult) -> Iterator[str]:
    """Each requirement with what it came to, what is wrong first."""
    judged = [(cell, each) for cell in result.cells for each in cell.required]
    restarts = [(cell, each) for cell in result.cells if cell.reaction is not None for each in cell.reaction.restarts]
    if not judged and not restarts and not result.problems:
        return
    yield "<h2>Required reactions</h2>\n"
    for problem in result.problems:
        yield f'<p><span class="verdict failed">{NOT_TRIED}</span> {escape(str(problem))}</p>\n'
    if not judged and not restarts:
        return
    rows = [
        _row(result, cell, "no unexpected restart", outcome, OUTCOMES[outcome], restarted(each))
        for cell, each in restarts
        for outcome in (_restarted(each),)
    ]
    rows += [
        _row(result, cell, each.text, each.outcome, outcome_of(each), evidence(each))
        for cell, each in sorted(judged, key=lambda one: _ORDER.index(one[1].outcome))
    ]
    yield _table(("Error", "State", "Required", "Outcome", "Why"), rows)


def _restarted(each: OutputRestart) -> Outcome:
    return "passed" if each.allowed_by else "failed"


def _row(result: SweepResult, cell: Cell, text: str, outcome: Outcome, word: str, why: str) -> str:
    sign = f'<span class="verdict {outcome}">{escape(word)}</span>'
    about = f'<th scope="row">{escape(result.entry(cell).name)} <code class="faint">{escape(cell.error)}</code></th>'
    return tr(about, td(cell.point), f"<td><code>{escape(text)}</code></td>", f"<td>{sign}</td>", td(why))


def _reactions(result: SweepResult, required: Required) -> Iterator[str]:
    reacted = [cell for cell in result.cells if verdict_of(cell) != "stopped" and _is_met(cell, required)]
    if not reacted:
        return
    yield "<h2>Reactions</h2>\n"
    for cell in reacted:
        entry, reaction = result.entry(cell), cell.reaction
        assert reaction is not None
        yield f'<section id="{_anchor(cell)}"><h3>{escape(entry.name)}, {escape(cell.point)}</h3>\n'
        read = ", ".join(f"<code>{escape(each)}</code>" for each in reaction.reader_places) or "no statement"
        if reaction.first_effect is not None:
            first = f"First effect after {count(reaction.first_effect, 'scan')}"
        else:
            first = escape(reason_of(reaction))
        yield f"<p>{first}. Read by: {read}."
        lines = ", ".join(f"<code>{escape(each.file)}:{each.line}</code>" for each in reaction.lines)
        yield f" Reached only with it: {lines}." if lines else ""
        yield f" {escape(reaction.note)}." if reaction.note else ""
        yield "</p>\n"
        yield _table(("What differed", "Without", "With", "Scan"), map(_difference, reaction.differences))
        more = reaction.difference_count - len(reaction.differences)
        yield f"{f'<p class=faint>{more} more</p>' if more > 0 else ''}</section>\n"


def _difference(each: Difference) -> str:
    kind = ' <span class="faint">output</span>' if each.output else ""
    return tr(f"<td><code>{escape(each.path)}</code>{kind}</td>", td(each.without), td(each.value), td(each.scan))


def _anchor(cell: Cell) -> str:
    return quote(f"{cell.error}/{cell.point}")
