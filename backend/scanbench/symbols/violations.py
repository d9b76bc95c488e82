"""The list of subrange violations in an image, for people: where, which instance, which value, how often."""

import struct
from dataclasses import dataclass
from typing import TypeAlias

from scanbench.problems import Span
from scanbench.program.calling import callers
from scanbench.program.copies import Image
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.program.sites import CheckSite
from scanbench.symbols.leaves import WHOLE
from scanbench.symbols.names import names_of

_HEAD = struct.Struct("<II")
_ENTRY = struct.Struct("<IIQQQQQ")
_PATH = struct.Struct("<" + Layout.PATH_LIMIT * "II")
assert _ENTRY.size == Layout.VIOLATION_BYTES


Key: TypeAlias = "tuple[int, str, str, tuple[Calling, ...]]"
"""Of an entry: its place, instance, variable and path."""


@dataclass(frozen=True, slots=True)
class Calling:
    """One call that leads to a violation."""

    pou: str
    instance: str
    """Path of the instance that calls, '' in a FUNCTION."""
    span: Span
    """The call."""
    method: str = ""
    """The METHOD, ACTION or part of a property of that instance, '' in what is none."""

    def __str__(self) -> str:
        where = f"{self.instance}.{self.method}" if self.instance and self.method else self.instance or self.pou
        return f"{where} {self.span.file}:{self.span.line}"


@dataclass(frozen=True, slots=True)
class Violation:
    """One place and instance at which a value left its subrange, by one path of calls; see `Layout.VIOLATION_BYTES`."""

    site: int
    """Index into `Program.checks` plus one."""
    span: Span
    pou: str
    instance: str
    """Path of the instance that ran, '' in a FUNCTION."""
    variable: str
    """As it is written there."""
    target: str
    """Which variable that was, where `variable` is an in-out, or leads through one or through a reference; else ''."""
    value: int
    """The last one. What has no room in 65 bits is the nearest number that has, and `beyond`."""
    low: int
    high: int
    times: int
    first_scan: int
    last_scan: int
    beyond: bool = False
    calls: tuple[Calling, ...] = ()
    """Those that lead there, the outermost first; none in what a task runs."""
    cut: bool = False
    """Whether there are more outside of them, see `Layout.PATH_LIMIT`."""

    @property
    def key(self) -> Key:
        """What an entry of the list is of: place, instance, variable and path."""
        return self.site, self.instance, self.target, self.calls

    @property
    def path(self) -> str:
        """The calls in one line: `Main Main.st:12 > Main.belt Belt.st:5`; a `...` for those that are not known."""
        return " > ".join([*(["..."] if self.cut else []), *map(str, self.calls)])

    @property
    def name(self) -> str:
        """The variable, and for one that has a different name there, both."""
        return f"{self.target} (here {self.variable})" if self.target else self.variable

    @property
    def told(self) -> str:
        """The violation, and who called."""
        return f"{self}; called from {self.path}" if self.calls else str(self)

    def __str__(self) -> str:
        where = f" in {self.instance}" if self.instance else f" in {self.pou}"
        if self.variable == "EN_CHECK":
            return f"EN_CHECK{where}: ENO was FALSE"
        if self.beyond:
            return f"{self.name}{where} was beyond {self.value}, outside of {self.low}..{self.high}"
        return f"{self.name}{where} was {self.value}, outside of {self.low}..{self.high}"


@dataclass(frozen=True, slots=True)
class Violations:
    """The present list, in the order in which the places first violated."""

    entries: tuple[Violation, ...] = ()
    dropped: int = 0
    """Violations that found the list full."""
    count: int = 0
    """Violations in all, saturating at 2**32 - 1."""


def read_violations(program: Program, image: Image) -> Violations:
    """The violations recorded in an image since they were last cleared."""
    layout = program.layout
    if not layout.violations:
        return Violations()
    used, dropped = _HEAD.unpack_from(image, layout.violations)
    count = int.from_bytes(image[Layout.SUBRANGE_COUNT : Layout.SUBRANGE_COUNT + 4], "little")
    at = layout.violations + _HEAD.size
    entries = []
    for index in range(min(used, Layout.VIOLATION_LIMIT)):
        number, times, instance, value, first, last, more = _ENTRY.unpack_from(image, at + index * _ENTRY.size)
        if not 1 <= number <= len(program.checks):
            continue  # a tool wrote over the list
        site = program.checks[number - 1]
        path = names_of(program).instance(instance, site.pou) if instance else ""
        calls, cut = _path(program, image, index, site.pou)
        made = Violation(
            number, _plain(site.span), site.pou, path, site.variable, _target(program, more), _signed(site, value, more),
            site.low, site.high, times, first, last, bool(more >> Layout.VIOLATION_BEYOND & 1), calls, cut,
        )  # fmt: skip
        entries.append(made)
    return Violations(tuple(entries), dropped, count)


def cleared(layout: Layout) -> tuple[tuple[int, bytes], ...]:
    """What to write, and where, so that the list is empty and nothing has happened."""
    if not layout.violations:
        return ()
    size = _HEAD.size + Layout.VIOLATION_LIMIT * Layout.VIOLATION_BYTES
    if layout.paths:
        size = layout.paths - layout.violations + Layout.VIOLATION_LIMIT * _PATH.size
    return ((layout.violations, bytes(size)), (Layout.SUBRANGE_ERROR, bytes(1)), (Layout.SUBRANGE_COUNT, bytes(4)))


def _path(program: Program, image: Image, index: int, pou: str) -> tuple[tuple[Calling, ...], bool]:
    """The calls that lead to the entry, which is of this POU, and whether there are others around them."""
    if not program.layout.paths:
        return (), False
    numbers = _PATH.unpack_from(image, program.layout.paths + index * _PATH.size)
    found: list[Calling] = []
    seen = {pou}
    for number, instance in zip(numbers[::2], numbers[1::2], strict=True):
        if not 1 <= number <= len(program.calls):
            return tuple(reversed(found)), False
        site = program.calls[number - 1]
        if not site.passes:
            path = names_of(program).instance(instance, site.pou) if instance else ""
            found.append(Calling(site.pou, path, _plain(site.span), _method(program, site.pou)))
        if site.pou in seen:  # who called it before is not in the image any more
            break
        seen.add(site.pou)
    else:  # as many as an entry has
        return tuple(reversed(found)), callers(program)[numbers[-2] - 1] != 0
    return tuple(reversed(found)), True


def _method(program: Program, name: str) -> str:
    """What a POU is called in its class; '' of one that is no method."""
    pou = next((each for each in program.pous if each.name == name), None)
    return name.rpartition(".")[2] if pou is not None and pou.this is not None else ""


def _plain(span: Span) -> Span:
    """A span as data, to be sent on: one of a tree may still keep its whole text."""
    return Span(span.file, span.line, span.column, span.end_line, span.end_column)


def _target(program: Program, more: int) -> str:
    """The variable that an entry says it was bound to."""
    offset, names = more & Layout.VIOLATION_BOUND, names_of(program)
    if offset == 0:
        return ""
    if offset < program.layout.frames:
        return names.whole(offset, WHOLE).name
    return next((each.name for each in names.at(offset)), "")


def _signed(site: CheckSite, value: int, more: int) -> int:
    """The list keeps 64 bits, and says so where there are 65; else bounds beyond LINT say that they are a ULINT's."""
    if more >> Layout.VIOLATION_WIDE & 1:
        return value - ((more >> Layout.VIOLATION_SIGN & 1) << 64)
    return value if site.high >= 1 << 63 or value < 1 << 63 else value - (1 << 64)
