"""How much of a program runs here, as a page to read or to send: one file, no scripts, nothing loaded from elsewhere."""

from collections.abc import Iterable, Iterator
from html import escape

from scanbench.reports.page import Page, Words, table, td, th, tr
from scanbench.reports.program_report import FileReport, ProgramReport, pou_lines, stubs_alike, whole_of

MOST_PLACES = 5
"""Places that are named of each cause."""
_WORDS: Words = {"en": {"title": "Program report"}, "ja": {"title": "プログラム報告"}}


def program_page(report: ProgramReport, about: str) -> str:
    """The page of a program that is called `about`."""
    page = Page("en", _WORDS)
    parts = (
        f"<h1>{page.word('title')}: {escape(about)}</h1>\n",
        *_summary(report),
        *_causes(report),
        *_libraries(report),
        *_files(report),
    )
    return page.document(about, parts, "screen")


def _summary(report: ProgramReport) -> Iterator[str]:
    whole = whole_of(report.files)
    lines = pou_lines(whole) if whole.pous else ["There is no POU."]
    errors = sum(len(each.places) for each in report.causes)
    lines.append(f"{errors} errors: a program runs when none of its files has one" if errors else "no error: it runs")
    yield f"<ul>{''.join(f'<li>{escape(line)}</li>' for line in lines)}</ul>\n"


def _causes(report: ProgramReport) -> Iterator[str]:
    if not report.causes:
        return
    yield "<h2>What stops the others</h2>\n"
    rows = []
    for cause in report.causes:
        more = len(cause.places) - MOST_PLACES
        places = "<br>".join(escape(str(each)) for each in cause.places[:MOST_PLACES])
        rest = f"<br>and {more} more" if more > 0 else ""
        what = f"{cause.code} {cause.message}"
        rows.append(
            tr(td(cause.pous, "num"), td(len(cause.places), "num"), td(what), f'<td class="mono">{places}{rest}</td>')
        )
    yield _table(("POUs", "Places", "What", "Where"), rows)
    if report.waiting:
        yield "<p>Without an error of their own, and stopped by what they need:</p>\n"
        yield _table(("POU", "Where"), [tr(td(each.pou), td(str(each.place), "mono")) for each in report.waiting])


def _libraries(report: ProgramReport) -> Iterator[str]:
    if not (report.libraries or report.missing or report.absent or report.stubs):
        return
    yield "<h2>Libraries</h2>\n"
    if report.libraries:
        yield f"<p>Their texts are in the project: {escape(', '.join(report.libraries))}.</p>\n"
    if report.missing:
        yield f"<p>Missing, so that their names are not known: {escape(', '.join(report.missing))}.</p>\n"
    if report.absent:
        yield f"<p>Files that the project lists and that are missing: {escape(', '.join(report.absent))}.</p>\n"
    if report.stubs:
        for said, found in stubs_alike(report):
            yield f"<p>{escape(said)}</p>\n"
            yield _table(("Stub", "First use"), [tr(td(name), td(str(place), "mono")) for name, place in found])


def _files(report: ProgramReport) -> Iterator[str]:
    yield "<h2>Files</h2>\n"
    heads = ("File", "POUs", "run", "with stubs", "without errors", "constructs", "refused", "other errors")
    whole = [whole_of(report.files)] if len(report.files) > 1 else []
    yield _table(heads, [_row(each) for each in (*report.files, *whole)])


def _row(file: FileReport) -> str:
    counts = file.pous, file.run, file.aided, file.clean, file.supported.total(), file.refused.total(), file.errors
    return tr(td(file.name), *(td(count, "num") for count in counts))


def _table(heads: Iterable[str], rows: Iterable[str]) -> str:
    return table("".join(map(th, map(escape, heads))), rows)
