"""The statements of a line that somebody names: `main.st:12`."""

from difflib import get_close_matches

from scanbench.problems import perhaps
from scanbench.program.program import Program
from scanbench.runtime.command import Refusal
from scanbench.symbols.sites import sites_of


def find_line(program: Program, file: str, line: int) -> tuple[int, ...] | Refusal:
    """The sites of the statements that begin there, or what would have been one."""
    sites = sites_of(program)
    files = list(dict.fromkeys(site.span.file for site in sites.statements))
    name = _file(files, file)
    if name is None:
        near = tuple(get_close_matches(file, files, n=3, cutoff=0.3))
        hint = f".{perhaps(near)}" if near else f": there are {', '.join(files[:10]) or 'none'}"
        return Refusal(f"no statement of the program is in a file {file or '(none named)'}{hint}", near)
    found = sites.at_line(name, line)
    if found:
        return found
    lines = sorted({site.span.line for site in sites.statements if site.span.file == name})
    around = [each for each in lines if each < line][-1:] + [each for each in lines if each > line][:1]
    near = tuple(f"{name}:{each}" for each in around)
    if len(near) == 1:
        return Refusal(f"no statement begins at {name}:{line}; the nearest is at {near[0]}", near)
    return Refusal(f"no statement begins at {name}:{line}; the nearest are at {' and '.join(near)}", near)


def _file(files: list[str], wanted: str) -> str | None:
    """The file of this name, or the only one whose path ends with it."""
    if wanted in files:
        return wanted
    ends = [each for each in files if each.lower() == wanted.lower() or each.lower().endswith(f"/{wanted.lower()}")]
    return ends[0] if len(ends) == 1 and wanted else None
