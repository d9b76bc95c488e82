"""What a program remembers and a trace has no column of, where the trace tells all the same.

A controller log begins in the middle of a run. A latch that it does not have is off in the monitor, and was on in the
controller: then its output differs in each scan, and nothing is wrong. So before the second scan each remembered BOOL and each
remembered enumeration is given its other values, and each remembered number or time is raised and lowered by what some output is off;
what makes fewer outputs differ from the trace is assumed, and told.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from scanbench.program.types import Elementary, Enumeration, Kind
from scanbench.runtime.command import Patch
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.values import format_value
from scanbench.verify.trace.monitor import Ran, Result, TraceMonitor
from scanbench.verify.trace.patches import put
from scanbench.verify.trace.values import is_number, number_of, real_bytes

MOST_VALUES = 300
"""Of all variables, that are tried in a round."""
MOST_ROUNDS = 8
"""Each finds one variable."""


@dataclass(frozen=True, slots=True)
class Assumed:
    """A remembered variable, and its value when the trace begins."""

    name: str
    text: str
    """The value, for people."""
    patch: Patch

    def __str__(self) -> str:
        return f"{self.name} = {self.text}"


def assume(monitor: TraceMonitor, remembered: Iterable[tuple[str, Leaf]]) -> tuple[Assumed, ...]:
    """The fewest that were found. The monitor is in the seam before its second scan, before and after this call."""
    side, leaves = monitor.side, list(remembered)
    here = side.begin()
    found: list[Assumed] = []

    def ran_with(more: Iterable[Assumed]) -> Ran:
        put(side.memory, [each.patch for each in more])
        ran = monitor.run(None)
        side.restore(here)
        return ran

    last = ran_with(())
    while len(found) < MOST_ROUNDS and _differing(last):
        known = {each.name for each in found}
        off = [each for each in last.results if not each.same]
        others = [each for name, leaf in leaves if name not in known for each in _others(name, leaf, here.memory, off)]
        tried = [(each, ran_with((*found, each))) for each in others[:MOST_VALUES]]
        best = min(tried, key=lambda each: _differing(each[1]), default=None)
        if best is None or _differing(best[1]) >= _differing(last):
            break
        found.append(best[0])
        last = best[1]
    return tuple(found)


def _differing(ran: Ran) -> int:
    return sum(not each.same for each in ran.results) + bool(ran.trap)


def _others(name: str, leaf: Leaf, memory: bytes, off: Iterable[Result]) -> Iterator[Assumed]:
    """Values that a variable does not have: all of a type with few of them, else those that differ by what an output is off."""
    now, type = leaf.cut(memory), leaf.type
    values: list[bytes] = []
    if isinstance(type, Enumeration):
        values = [number.to_bytes(type.size, "little", signed=type.kind is Kind.INT) for _, number in type.values]
    elif isinstance(type, Elementary) and type.kind is Kind.BOOL:
        values = [b"\0", b"\1"]
    elif isinstance(type, Elementary) and is_number(type):
        values = [value for each in off for value in _shifted(type, now, each)]
    for value in dict.fromkeys(values):
        if value != now:
            yield Assumed(name, format_value(type, value), _patch(leaf, value))


def _shifted(type: Elementary, now: bytes, off: Result) -> Iterator[bytes]:
    """The value and the difference of an output together, and the one without the other: a timer counts from its start."""
    signal = off.signal
    if off.recorded is None or not isinstance(signal.type, Elementary) or not is_number(signal.type):
        return
    if (Kind.TIME in (signal.type.kind, type.kind)) and signal.type.kind is not type.kind:
        return
    apart = number_of(signal.type, off.recorded) - number_of(signal.type, off.found)
    for value in (number_of(type, now) + apart, number_of(type, now) - apart):
        if type.kind is Kind.REAL:
            yield real_bytes(type, value)
        elif value == int(value):
            try:
                yield int(value).to_bytes(type.size, "little", signed=type.kind is not Kind.UINT)
            except OverflowError:
                continue


def _patch(leaf: Leaf, value: bytes) -> Patch:
    if leaf.bit is not None:
        return Patch.of_bit(leaf.offset, leaf.bit, value != b"\0")
    return Patch.whole(leaf.offset, value)
