"""What all printed pages have in common: one HTML file that needs nothing else, to be read, printed, signed and kept."""

from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from html import escape
from importlib.resources import files
from typing import Literal

from scanbench.reports.record_text import Language

Words = Mapping[Language, Mapping[str, str]]

HEAD: Words = {
    "en": {
        "project": "Project", "model": "PLC model", "instance": "Virtual PLC", "version": "Program version",
        "written": "Written", "by": "By", "tool": "With", "note": "Note",
    },
    "ja": {
        "project": "プロジェクト", "model": "PLC機種", "instance": "仮想PLC", "version": "プログラム版数",
        "written": "作成日時", "by": "作成者", "tool": "作成ソフトウェア", "note": "備考",
    },
}  # fmt: skip
"""Words that all pages use."""


class Page:
    """In one language."""

    def __init__(self, language: Language, words: Words) -> None:
        self._language = language
        self._words = {**HEAD[language], **words[language]}

    def plain(self, word: str, /, **values: object) -> str:
        """A word or sentence; `values` go in its braces."""
        return self._words[word].format(**values) if values else self._words[word]

    def word(self, word: str, /, **values: object) -> str:
        """The same as HTML."""
        return escape(self.plain(word, **values))

    def document(self, about: str, parts: Iterable[str], look: Literal["paper", "screen"] = "paper") -> str:
        """The whole file: its title is the kind of page, then `about`; `parts` are HTML."""
        style = files("scanbench.reports").joinpath("page.css").read_text("utf-8")
        mark = "" if look == "paper" else f' class="{look}"'
        return (
            f'<!DOCTYPE html>\n<html lang="{self._language}"{mark}>\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{self.word('title')} – {escape(about)}</title>\n<style>\n{style}</style>\n</head>\n"
            f"<body>\n{''.join(parts)}</body>\n</html>\n"
        )

    def head(self, pairs: Iterable[tuple[str, str]], more: str = "") -> str:
        """The title, and what the page is about: words, each with HTML next to it. `more`: one more row."""
        rows = self.pairs(pairs)
        return f'<h1>{self.word("title")}</h1>\n<dl class="head">{rows}<dt></dt><dd></dd>{more}</dl>\n'

    def pairs(self, pairs: Iterable[tuple[str, str]]) -> str:
        """For a `<dl>`."""
        return "".join(f"<dt>{self.word(name)}</dt><dd>{value}</dd>" for name, value in pairs)

    def table(self, heads: Iterable[str], rows: Iterable[str]) -> str:
        """Words over the columns, and rows."""
        return table("".join(map(th, map(self.word, heads))), rows)


def table(heads: str, rows: Iterable[str], kind: str = "") -> str:
    """Heads of columns, or rows of them, and rows."""
    mark = f' class="{kind}"' if kind else ""
    above = heads if heads.startswith("<tr>") else f"<tr>{heads}</tr>"
    return (
        f'<div class="scroll"><table{mark}>\n<thead>{above}</thead>\n<tbody>\n{"".join(rows)}</tbody>\n</table></div>\n'
    )


def th(html: str) -> str:
    """The head of a column."""
    return f'<th scope="col">{html}</th>'


def tr(*cells: str) -> str:
    """A row."""
    return f"<tr>{''.join(cells)}</tr>\n"


def td(text: str | int | None, kind: str = "") -> str:
    """A cell with plain text, empty for None; `kind`: `mono`, `num`."""
    mark = f' class="{kind}"' if kind else ""
    return f"<td{mark}>{'' if text is None else escape(str(text))}</td>"


def moment(at: datetime) -> str:
    """To the second, in UTC."""
    return f"{at.astimezone(UTC):%Y-%m-%d %H:%M:%S}"
