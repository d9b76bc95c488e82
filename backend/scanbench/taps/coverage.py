"""Coverage: which statements of a program were reached, and which ways they went, since it was switched on."""

from collections.abc import Mapping, Sequence
from difflib import SequenceMatcher
from itertools import groupby

from scanbench.engines.observe import Seen
from scanbench.problems import Span
from scanbench.symbols.sites import Sites
from scanbench.taps.covered import CoveredFile, CoveredOutcome, CoveredSite

Key = tuple[str, str]
"""A POU and the text of a statement up to the first one inside of it."""


class CoverageTap:
    """Adds up what an observer of the debug flavour notes (`Seen`)."""

    def __init__(self, sites: Sites, sources: Mapping[str, str], scan: int) -> None:
        self._sites = sites
        self._sources = sources
        self._reached: set[int] = set()
        self._outcomes: set[int] = set()
        self.since_scan = scan
        self.scans = 0

    def note(self, seen: Seen, scans: int = 1) -> bool:
        """Takes what was seen in some more scans; whether anything of it is new."""
        self.scans += scans
        before = len(self._reached) + len(self._outcomes)
        self._reached |= seen.reached
        self._outcomes |= seen.outcomes
        return len(self._reached) + len(self._outcomes) > before

    def change(self, sites: Sites, sources: Mapping[str, str]) -> None:
        """Turns to a new program: statements whose text is the same keep what was noted for them; the rest is forgotten."""
        moved = _moved(_keys(self._sites, self._sources), _keys(sites, sources))
        outcomes = {(each.site, each.name): number for number, each in enumerate(sites.outcomes)}
        went = [self._sites.outcomes[number] for number in self._outcomes]
        self._outcomes = {
            number
            for each in went
            if each.site in moved and (number := outcomes.get((moved[each.site], each.name))) is not None
        }
        self._reached = {moved[site] for site in self._reached if site in moved}
        self._sites, self._sources = sites, sources

    @property
    def files(self) -> tuple[CoveredFile, ...]:
        """All statements there are, by file and place."""
        ways: dict[int, list[CoveredOutcome]] = {}
        for number, outcome in enumerate(self._sites.outcomes):
            ways.setdefault(outcome.site, []).append(CoveredOutcome(outcome.name, number in self._outcomes))
        numbered = enumerate(self._sites.statements)
        return tuple(
            CoveredFile(file, tuple(self._covered(site, ways.get(site, ())) for site, _ in group))
            for file, group in groupby(numbered, key=lambda each: each[1].span.file)
        )

    def _covered(self, number: int, ways: Sequence[CoveredOutcome]) -> CoveredSite:
        site = self._sites.statements[number]
        span = site.span
        return CoveredSite(
            span.line, span.column, span.end_line, span.end_column, site.pou, number in self._reached, tuple(ways)
        )


def _keys(sites: Sites, sources: Mapping[str, str]) -> dict[str, list[tuple[int, Key]]]:
    """The statements of each POU, in order, with what they read."""
    lines = {file: text.splitlines() for file, text in sources.items()}
    found: dict[str, list[tuple[int, Key]]] = {}
    statements = sites.statements
    for number, site in enumerate(statements):
        span = site.span
        following = statements[number + 1].span if number + 1 < len(statements) else None
        text = _text(lines.get(span.file, []), span, following)
        found.setdefault(site.pou, []).append((number, (site.pou, text)))
    return found


def _text(lines: list[str], span: Span, following: Span | None) -> str:
    """What a statement reads up to the next one that begins in it, without how it is laid out."""
    end = (span.end_line, span.end_column)
    if (
        following is not None
        and following.file == span.file
        and (following.line, following.column) > (span.line, span.column)
    ):
        end = min(end, (following.line, following.column))
    found = []
    for line in range(span.line, min(end[0], len(lines)) + 1):
        text = lines[line - 1]
        text = text[: end[1] - 1] if line == end[0] else text
        found.append(text[span.column - 1 :] if line == span.line else text)
    return " ".join(" ".join(found).split())


def _moved(old: dict[str, list[tuple[int, Key]]], new: dict[str, list[tuple[int, Key]]]) -> dict[int, int]:
    """Which statement of the new program each old one is, where it is there still."""
    found = {}
    for pou, before in old.items():
        after = new.get(pou, [])
        matcher = SequenceMatcher(None, [key for _, key in before], [key for _, key in after], autojunk=False)
        for at, to, size in matcher.get_matching_blocks():
            found.update({before[at + each][0]: after[to + each][0] for each in range(size)})
    return found
