"""Coverage as LCOV trace files, which genhtml, editors and CI read."""

from collections.abc import Iterator, Sequence

from scanbench.taps.covered import CoveredFile, CoveredSite


def lcov(files: Sequence[CoveredFile]) -> str:
    """One record a file: POUs as functions, statements by line, ways of a statement as its branches.

    A count is 1 for what was reached and 0 for what was not: how often is not noted.
    """
    return "".join(f"{line}\n" for file in files for line in _record(file))


def _record(file: CoveredFile) -> Iterator[str]:
    yield "TN:"
    yield f"SF:{file.file}"
    yield from _functions(file.sites)
    yield from _branches(file.sites)
    yield from _lines(file.sites)
    yield "end_of_record"


def _functions(sites: Sequence[CoveredSite]) -> Iterator[str]:
    first: dict[str, int] = {}
    reached: dict[str, bool] = {}
    for site in sites:
        first[site.pou] = min(first.get(site.pou, site.line), site.line)
        reached[site.pou] = reached.get(site.pou, False) or site.reached
    yield from (f"FN:{line},{pou}" for pou, line in first.items())
    yield from (f"FNDA:{int(hit)},{pou}" for pou, hit in reached.items())
    yield f"FNF:{len(first)}"
    yield f"FNH:{sum(reached.values())}"


def _branches(sites: Sequence[CoveredSite]) -> Iterator[str]:
    found = hit = 0
    for block, site in enumerate(sites):
        for branch, way in enumerate(site.outcomes):
            found, hit = found + 1, hit + way.taken
            yield f"BRDA:{site.line},{block},{branch},{int(way.taken) if site.reached else '-'}"
    yield f"BRF:{found}"
    yield f"BRH:{hit}"


def _lines(sites: Sequence[CoveredSite]) -> Iterator[str]:
    lines: dict[int, bool] = {}
    for site in sites:
        lines[site.line] = lines.get(site.line, False) or site.reached
    yield from (f"DA:{line},{int(lines[line])}" for line in sorted(lines))
    yield f"LF:{len(lines)}"
    yield f"LH:{sum(lines.values())}"
