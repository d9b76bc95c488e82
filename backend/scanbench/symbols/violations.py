"""The list of subrange violations in an image, for people: where, which instance, which value, how often."""

import struct
from dataclasses import dataclass

from scanbench.problems import Span
from scanbench.program.copies import Image
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.program.sites import CheckSite
from scanbench.symbols.leaves import WHOLE
from scanbench.symbols.names import names_of

_HEAD = struct.Struct("<II")
_ENTRY = struct.Struct("<IIQQQQQ")
assert _ENTRY.size == Layout.VIOLATION_BYTES


@dataclass(frozen=True, slots=True)
class Violation:
    """One place and instance at which a value left its subrange; see `Layout.VIOLATION_BYTES`."""

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

    @property
    def key(self) -> tuple[int, str, str]:
        """What an entry of the list is of: place, instance and variable."""
        return self.site, self.instance, self.target

    @property
    def name(self) -> str:
        """The variable, and for one that has a different name there, both."""
        return f"{self.target} (here {self.variable})" if self.target else self.variable

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
        made = Violation(
            number, _plain(site.span), site.pou, path, site.variable, _target(program, more), _signed(site, value, more),
            site.low, site.high, times, first, last, bool(more >> Layout.VIOLATION_BEYOND & 1),
        )  # fmt: skip
        entries.append(made)
    return Violations(tuple(entries), dropped, count)


def cleared(layout: Layout) -> tuple[tuple[int, bytes], ...]:
    """What to write, and where, so that the list is empty and nothing has happened."""
    if not layout.violations:
        return ()
    size = _HEAD.size + Layout.VIOLATION_LIMIT * Layout.VIOLATION_BYTES
    return ((layout.violations, bytes(size)), (Layout.SUBRANGE_ERROR, bytes(1)), (Layout.SUBRANGE_COUNT, bytes(4)))


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
