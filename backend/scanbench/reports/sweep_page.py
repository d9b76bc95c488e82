"""A sweep as a page to print or to send: one file, no scripts, nothing loaded from elsewhere."""

from collections.abc import Iterator, Mapping
from html import escape
from urllib.parse import quote

from scanbench.faults.reaction.reaction import FINDINGS, Difference, Verdict
from scanbench.faults.reaction.sweep import Cell
from scanbench.reports.sweep_report import WORDS, SweepResult, count, reason, verdict_of

_SIGNS: Mapping[Verdict | None, str] = {
    "reacted": "✓", "stored_only": "▤", "no_effect": "◐", "not_reached": "↷", "never_read": "✗", "stopped": "■", None: "–",
}  # fmt: skip
_STYLE = """
:root { color-scheme: light dark; --ink: #1a1a1a; --dim: #666; --page: #fff; --line: #ccc;
  --reacted: #0a6b2d; --no_effect: #8a5a00; --stored_only: #8a5a00; --not_reached: #b00020; --never_read: #b00020; --stopped: #444; --none: #666; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8e8e8; --dim: #a0a0a0; --page: #16181b; --line: #3a3d42;
  --reacted: #58c47c; --no_effect: #e0a94a; --stored_only: #e0a94a; --not_reached: #ff7a85; --never_read: #ff7a85; --stopped: #b8b8b8; --none: #a0a0a0; } }
@media print { :root { --ink: #000; --dim: #444; --page: #fff; --line: #999;
  --reacted: #0a6b2d; --no_effect: #8a5a00; --stored_only: #8a5a00; --not_reached: #b00020; --never_read: #b00020; --stopped: #444; --none: #666; }
  tr, section { break-inside: avoid; } a { color: inherit; text-decoration: none; } }
body { font: 14px/1.45 system-ui, sans-serif; color: var(--ink); background: var(--page); max-width: 72rem;
  margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin-bottom: 0; } h2 { font-size: 1.15rem; margin-top: 2rem; } h3 { font-size: 1rem; margin-bottom: .2rem; }
p.about { color: var(--dim); margin-top: .2rem; }
table { border-collapse: collapse; margin: .6rem 0; } th, td { text-align: left; vertical-align: top;
  padding: .2rem .7rem .2rem 0; border-bottom: 1px solid var(--line); }
code { font-family: ui-monospace, monospace; font-size: .93em; } .dim { color: var(--dim); }
.reacted { color: var(--reacted); } .no_effect { color: var(--no_effect); } .never_read { color: var(--never_read); }
.stored_only { color: var(--stored_only); } .not_reached { color: var(--not_reached); }
.stopped { color: var(--stopped); } .none { color: var(--none); } td a { color: inherit; }
"""


def sweep_page(result: SweepResult, at: str) -> str:
    """The page; `at` says when the sweep was made."""
    title = escape(f"{result.project} on {result.model}")
    return "".join(
        (
            f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>Error sweep: {title}</title>',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<style>{_STYLE}</style></head>\n<body>\n<h1>Error sweep: {title}</h1>\n",
            f'<p class="about">{escape(at)} · every error alone, {result.window} scans, '
            "compared with the same run without it</p>\n",
            *_summary(result),
            *_matrix(result),
            *_findings(result),
            *_reactions(result),
            "</body></html>\n",
        )
    )


def _summary(result: SweepResult) -> Iterator[str]:
    parts = [
        f'<span class="{verdict or "none"}">{_SIGNS[verdict]} {number} {escape(WORDS[verdict])}</span>'
        for verdict in WORDS
        if (number := sum(verdict_of(cell) == verdict for cell in result.cells))
    ]
    yield f"<p>{' &nbsp; '.join(parts)}</p>\n"


def _matrix(result: SweepResult) -> Iterator[str]:
    """Errors down, states across."""
    heads = "".join(f'<th scope="col">{escape(name)}</th>' for name, _ in result.states)
    scans = "".join(f'<td class="dim">before scan {scan}</td>' for _, scan in result.states)
    yield '<h2>Errors and states</h2>\n<table><thead><tr><th scope="col">Error</th><th scope="col">Code</th>'
    yield f'<th scope="col">Severity</th>{heads}</tr><tr><td></td><td></td><td></td>{scans}</tr></thead><tbody>\n'
    for entry in result.errors:
        row = "".join(_in_matrix(cell) for cell in result.cells if cell.error == entry.id)
        name = f'{escape(entry.name)} <code class="dim">{escape(entry.id)}</code>'
        yield f'<tr><th scope="row">{name}</th><td><code>{entry.code_text}</code></td><td>{entry.severity}</td>{row}</tr>\n'
    yield "</tbody></table>\n"


def _in_matrix(cell: Cell) -> str:
    verdict, reaction = verdict_of(cell), cell.reaction
    text = f"{_SIGNS[verdict]} {escape(WORDS[verdict])}"
    if reaction is not None and reaction.first_effect is not None:
        text += f', <span class="dim">{count(reaction.first_effect, "scan")}</span>'
    link = f'<a href="#{_anchor(cell)}">{text}</a>' if verdict != "stopped" else text
    return f'<td class="{verdict or "none"}">{link}</td>'


def _findings(result: SweepResult) -> Iterator[str]:
    found = [cell for cell in result.cells if verdict_of(cell) in FINDINGS or cell.reaction is None]
    yield "<h2>Findings</h2>\n"
    if not found:
        yield "<p>The program reacted to every error that leaves it running.</p>\n"
        return
    yield '<table><thead><tr><th scope="col">Error</th><th scope="col">State</th><th scope="col">Verdict</th><th scope="col">Why</th></tr></thead><tbody>\n'
    for cell in found:
        entry, verdict = result.entry(cell), verdict_of(cell)
        yield (
            f'<tr id="{_anchor(cell)}"><th scope="row">{escape(entry.name)}<br><code class="dim">{entry.code_text} {escape(entry.flag_text)}'
            f'</code></th><td>{escape(cell.point)}</td><td class="{verdict or "none"}">{_SIGNS[verdict]} {WORDS[verdict]}</td>'
            f"<td>{escape(reason(cell))}</td></tr>\n"
        )
    yield "</tbody></table>\n"


def _reactions(result: SweepResult) -> Iterator[str]:
    reacted = [cell for cell in result.cells if verdict_of(cell) == "reacted"]
    if not reacted:
        return
    yield "<h2>Reactions</h2>\n"
    for cell in reacted:
        entry, reaction = result.entry(cell), cell.reaction
        assert reaction is not None
        yield f'<section id="{_anchor(cell)}"><h3>{escape(entry.name)}, {escape(cell.point)}</h3>\n'
        first = count(reaction.first_effect, "scan") if reaction.first_effect is not None else ""
        read = ", ".join(f"<code>{escape(each)}</code>" for each in reaction.reader_places) or "no statement"
        yield f"<p>First effect after {first}. Read by: {read}."
        lines = ", ".join(f"<code>{escape(each.file)}:{each.line}</code>" for each in reaction.lines)
        yield f" Reached only with it: {lines}." if lines else ""
        yield f" {escape(reaction.note)}." if reaction.note else ""
        yield "</p>\n<table><thead><tr><th>What differed</th><th>Without</th><th>With</th><th>Scan</th></tr></thead><tbody>\n"
        yield from map(_difference, reaction.differences)
        more = reaction.difference_count - len(reaction.differences)
        yield f"</tbody></table>{f'<p class=dim>{more} more</p>' if more > 0 else ''}</section>\n"


def _difference(each: Difference) -> str:
    kind = ' <span class="dim">output</span>' if each.output else ""
    return (
        f"<tr><td><code>{escape(each.path)}</code>{kind}</td><td>{escape(each.without)}</td>"
        f"<td>{escape(each.value)}</td><td>{each.scan}</td></tr>\n"
    )


def _anchor(cell: Cell) -> str:
    return quote(f"{cell.error}/{cell.point}")
