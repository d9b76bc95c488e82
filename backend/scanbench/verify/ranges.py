"""Monitor ranges: which statements a stretch of the program is."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from difflib import get_close_matches

from scanbench.engines.debug import Frame
from scanbench.problems import Span, perhaps
from scanbench.program.program import Pou, Program
from scanbench.symbols.instances import instances_of, owner_of
from scanbench.symbols.sites import Sites
from scanbench.symbols.symbols import UnknownPath, resolve
from scanbench.verify.contract import BadRange, Range

_TEXT = re.compile(r"(?P<head>[^:@]*)(?::(?P<first>[^-@]*)(?:-(?P<last>[^@]*))?)?(?:@(?P<instance>.*))?")
_FILE = re.compile(r".*(/|\.(st|il|iecst|scl|exp|txt|tcpou|tcgvl|tcdut|xml)$)", re.IGNORECASE)
_SHOWN = 5
"""Names in one message."""


@dataclass(frozen=True, slots=True)
class Resolved:
    """A range of one program."""

    title: str
    """`Belt, lines 33 to 42`, `Main`, `the whole scan`."""
    pous: frozenset[Pou] = frozenset()
    """The POU, or all that are made of its one text; none: the whole scan."""
    sites: frozenset[int] = frozenset()
    outside: frozenset[int] = frozenset()
    """The other statements of these POUs."""
    first_sites: frozenset[int] = frozenset()
    """With which a call of them begins."""
    instances: tuple[str, ...] = ()
    """Paths; none of a FUNCTION."""
    only: int | None = None
    """Where the one instance begins that counts."""
    note: str = ""
    """What is not quite as it was asked for."""

    @property
    def whole(self) -> bool:
        """Whether it is the whole scan."""
        return not self.pous

    def holds(self, frames: tuple[Frame, ...]) -> bool:
        """Whether the statement that is next, or one of the calls that lead to it, is of the range. `frames`: innermost first."""
        return self.whole or any(
            each.site in self.sites and (self.only is None or each.instance == self.only) for each in frames
        )


def parse_range(text: str) -> Range:
    """`POU`, `POU:10-20`, `POU:10`, `File.st:10-20`, nothing for the whole scan; `@Main.belt[3]` after it: this instance only."""
    found = _TEXT.fullmatch(text.strip())
    if found is None:
        raise BadRange(f"`{text}` is no range: write POU, POU:10-20 or File.st:10-20")
    head, instance = found["head"].strip(), (found["instance"] or "").strip()
    first, last = (_line(found[each], text) for each in ("first", "last"))
    if found["first"] is not None and found["last"] is None:
        last = first
    if not head and (first or instance):
        raise BadRange(f"`{text}` names no POU: write POU:10-20 or File.st:10-20")
    if last < first:
        raise BadRange(f"`{text}`: line {last} is before line {first}")
    if _FILE.fullmatch(head):
        return Range(file=head, first=first, last=last, instance=instance)
    return Range(pou=head, first=first, last=last, instance=instance)


def _line(text: str | None, whole: str) -> int:
    if text is None:
        return 0
    if not text.strip().isdecimal() or int(text) == 0:
        raise BadRange(f"`{whole}`: `{text.strip()}` is no line. Lines are numbers from 1 on, as in POU:10-20")
    return int(text)


LinesOf = Callable[[str], int]
"""How many lines a source file has; 0: that is not known."""


def resolve_range(program: Program, sites: Sites, wanted: Range, lines_of: LinesOf = lambda file: 0) -> Resolved:
    """The statements that are meant; `BadRange` says what there is instead."""
    if not wanted.pou and not wanted.file:
        if wanted.instance:
            raise BadRange("the whole scan has no instance: name a POU")
        if wanted.first or wanted.last:
            raise BadRange(f"{_asked(wanted)} of what? Name a POU or a file, as in POU:10-20 or File.st:10-20")
        return Resolved("the whole scan")
    if 0 < wanted.last < wanted.first:
        raise BadRange(f"lines {wanted.first} to {wanted.last} are none: the first line comes first")
    pous = _named(sites, wanted) if wanted.pou else _in_file(sites, wanted)
    _reaches(sites, pous[0].span.file, wanted, lines_of)
    wanted, shorter = _ended(pous[0].span.file, wanted, lines_of)
    mine = frozenset(site for pou in pous for site in sites.bodies[pou])
    inside, lines, note = _within(sites, mine, wanted, pous[0].name)
    instances = _instances(program, pous[0])
    only = None if not wanted.instance else _only(program, pous[0], instances, wanted.instance)
    title = pous[0].name + lines + (f", in {wanted.instance.strip()}" if wanted.instance else "")
    return Resolved(
        title, frozenset(pous), inside, mine - inside, frozenset(sites.bodies[each][0] for each in pous),
        instances if only is None else (only[0],), None if only is None else only[1], note or shorter,
    )  # fmt: skip


def _named(sites: Sites, wanted: Range) -> list[Pou]:
    """The POU of this name."""
    names = {pou.name.upper(): pou.name for pou in sites.bodies}
    pous = [pou for pou in sites.bodies if pou.name.upper() == wanted.pou.strip().upper()]
    if not pous:
        near = tuple(names[each] for each in get_close_matches(wanted.pou.strip().upper(), names, 3, 0.5))
        raise BadRange(f"no POU `{wanted.pou}` runs in this program.{_perhaps(near, names.values())}", near)
    if wanted.file and not any(_is_file(pou.span.file, wanted.file) for pou in pous):
        raise BadRange(f"{pous[0].name} is in {pous[0].span.file}, not in {wanted.file}", (pous[0].span.file,))
    return pous


def _in_file(sites: Sites, wanted: Range) -> list[Pou]:
    """The one POU that has the lines."""
    files = {pou.span.file for pou in sites.bodies}
    there = [pou for pou in sites.bodies if _is_file(pou.span.file, wanted.file)]
    if not there:
        near = tuple(get_close_matches(wanted.file, files, 3, 0.4))
        raise BadRange(f"no statement of `{wanted.file}` runs in this program.{_perhaps(near, files)}", near)
    first, last = wanted.first or 1, wanted.last or 1 << 30
    hit = [pou for pou in there if any(first <= line <= last for line in _begins(sites, pou))]
    if not hit:  # between two statements: whoever has something around them
        hit = [pou for pou in there if pou.span.line <= first and _end(sites, pou) >= first]
        hit = hit or [min(there, key=lambda pou: _distance(sites, pou, first, last))]
    texts = {(pou.span.file, pou.span.line, pou.span.column) for pou in hit}
    if len(texts) > 1:
        names = tuple(dict.fromkeys(pou.name for pou in hit))
        raise BadRange(
            f"a range is in one POU, and these lines are in {len(names)}: {', '.join(names[:_SHOWN])}. "
            "Take a part of one of them, or the whole scan",
            names,
        )
    return hit


def _reaches(sites: Sites, file: str, wanted: Range, lines_of: LinesOf) -> None:
    """Whether the file has these lines."""
    first, lines = wanted.first, lines_of(file)
    if lines and first > lines:
        are = "is" if first == wanted.last else "are"
        raise BadRange(f"{file} has {lines} lines: there {are} no {_asked(wanted)}")
    end = max(_end(sites, pou) for pou in sites.bodies if pou.span.file == file)
    if not lines and first > end + 1:  # after END_PROGRAM at best
        raise BadRange(f"{_asked(wanted)}: the last statement of {file} ends in line {end}")


def _ended(file: str, wanted: Range, lines_of: LinesOf) -> tuple[Range, str]:
    """The range up to the last line of the file, and what is said where it was to go further."""
    lines = lines_of(file)
    if not lines or wanted.last <= lines:
        return wanted, ""
    return replace(wanted, last=lines), f"{file} has {lines} lines: the range ends with the last of them"


def _asked(wanted: Range) -> str:
    first, last = wanted.first or 1, wanted.last
    return f"line {first}" if first == last else f"lines {first} to {last or 'the end'}"


def _is_file(file: str, asked: str) -> bool:
    one, other = file.upper(), asked.strip().upper()
    return one == other or one.endswith(f"/{other}")


def _begins(sites: Sites, pou: Pou) -> list[int]:
    return [_span(sites, site).line for site in sites.bodies[pou]]


def _span(sites: Sites, site: int) -> Span:
    return sites.statements[site].span


def _end(sites: Sites, pou: Pou) -> int:
    return max((_span(sites, site).end_line for site in sites.bodies[pou]), default=pou.span.line)


def _distance(sites: Sites, pou: Pou, first: int, last: int) -> int:
    return min(max(first - line, line - last, 0) for line in _begins(sites, pou))


def _within(sites: Sites, mine: frozenset[int], wanted: Range, name: str) -> tuple[frozenset[int], str, str]:
    """The statements between two lines; how that reads; and what is other than it was asked for."""
    if not wanted.first and not wanted.last:
        return mine, "", ""
    first, last = wanted.first or 1, wanted.last or 1 << 30
    inside = frozenset(site for site in mine if first <= _span(sites, site).line <= last)
    if inside:
        end = wanted.last or max(_span(sites, site).end_line for site in inside)
        return inside, _lines(first, end), ""
    around = [site for site in mine if _span(sites, site).line <= first <= _span(sites, site).end_line]
    if around:  # inside of a statement of several lines: the innermost
        chosen = max(around, key=lambda site: _span(sites, site).line)
    else:
        after = [site for site in mine if _span(sites, site).line > last]
        chosen = (
            min(after, key=lambda site: _span(sites, site).line)
            if after
            else max(mine, key=lambda site: _span(sites, site).line)
        )
    line = _span(sites, chosen).line
    inside = frozenset(site for site in mine if _span(sites, site).line == line)
    return inside, _lines(line, line), f"no statement begins in {_asked(wanted)} of {name}: line {line} was taken"


def _lines(first: int, last: int) -> str:
    return f", line {first}" if first == last else f", lines {first} to {last}"


def _instances(program: Program, pou: Pou) -> tuple[str, ...]:
    record = owner_of(pou)
    return () if record is None else tuple(each.path for each in instances_of(program, record.name))


def _only(program: Program, pou: Pou, instances: tuple[str, ...], asked: str) -> tuple[str, int]:
    """The path of the one instance that counts, and where it begins."""
    known = {each.upper(): each for each in instances}
    try:
        symbol = resolve(program, asked)
    except UnknownPath as error:
        raise BadRange(error.message, error.near) from error
    path = known.get(symbol.path.upper())
    if path is None:
        near = tuple(known[each] for each in get_close_matches(symbol.path.upper(), known, 3, 0.4))
        if not instances:
            raise BadRange(f"{pou.name} is a FUNCTION and has no instances")
        raise BadRange(f"{symbol.path} is no instance of {pou.name}.{_perhaps(near, instances)}", near)
    return path, symbol.offset


def _perhaps(near: tuple[str, ...], all: Iterable[str]) -> str:
    if near:
        return perhaps(near)
    names = sorted(all)
    more = ", ..." if len(names) > _SHOWN else ""
    return f" There is {', '.join(names[:_SHOWN])}{more}." if names else ""
