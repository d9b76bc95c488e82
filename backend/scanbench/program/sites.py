"""Places of the source text that engines name by a number: where a run-time error can happen, and where a subrange is checked."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TypeVar

from scanbench.problems import Span


class TrapKind(StrEnum):
    BOUNDS = "bounds"
    DIVISION = "division"
    NULL = "null"
    STRING = "string"
    LOOP = "loop"
    ABSTRACT = "abstract"
    """A call whose instance has no body for it."""
    FATAL = "fatal"
    """The program called an instruction that stops the PLC (FALS and the like): see `Layout.ASKED`."""


EXCEPTIONS = {
    TrapKind.BOUNDS: 0x101,
    TrapKind.DIVISION: 0x102,
    TrapKind.NULL: 0x51,
    TrapKind.STRING: 0x101,
    TrapKind.ABSTRACT: 0x51,
}
"""The traps that __TRY catches, with their number in `__SYSTEM.ExceptionCode`: RTSEXCPT_ARRAYBOUNDS, RTSEXCPT_DIVIDEBYZERO,
RTSEXCPT_ACCESS_VIOLATION (https://infosys.beckhoff.com/content/1033/tc3_plc_intro/6753940235.html). Not a LOOP, which stands
for the watchdog, and not what the program asked for itself."""


@dataclass(frozen=True, slots=True)
class TrapSite:
    """A place that can trap; engines name it by its index in `Program.traps` plus one."""

    kind: TrapKind
    span: Span
    pou: str
    message: str


@dataclass(frozen=True, slots=True)
class CallSite:
    """A place that calls; engines name it by its index in `Program.calls` plus one, and 0 is a call by the system."""

    span: Span
    pou: str
    passes: bool = False
    """Nobody wrote this call: it only passes on to the body that an instance has."""


@dataclass(frozen=True, slots=True)
class CheckSite:
    """A subrange check that the compiler embedded; engines name it by its index in `Program.checks` plus one."""

    span: Span
    pou: str
    variable: str
    """What is checked, as people write it: `valve.level`, or `EN_CHECK`."""
    low: int
    high: int
    needless: str = ""
    """Why no check was embedded here, empty when there is one. Shown, never run."""


_Site = TypeVar("_Site", TrapSite, CallSite, CheckSite)


def plain_sites(sites: Iterable[_Site]) -> tuple[_Site, ...]:
    """The same without the texts that spans of a tree may keep."""
    return tuple(replace(site, span=site.span.plain()) for site in sites)
