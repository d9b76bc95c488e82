"""What of a trace was compared, and what was not: counted as the scans are verified."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.sites import Sites
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.verify.contract import Compared, VerifyCoverage
from scanbench.verify.trace.assume import Assumed
from scanbench.verify.trace.bind import Signal, Trace
from scanbench.verify.trace.mapping import bits_of, written
from scanbench.verify.trace.monitor import Ran
from scanbench.verify.trace.patches import Agrees
from scanbench.verify.trace.values import is_number, number_of

MOST_NAMES = 100
"""Variables of a kind that are named."""


@dataclass(slots=True)
class _Count:
    compared: int = 0
    differing: int = 0
    allowed: int = 0
    left_open: int = 0
    missing: int = 0
    largest: float = 0.0

    def add(self, signal: Signal, recorded: bytes, found: bytes, agrees: Agrees) -> None:
        self.compared += 1
        self.differing += agrees == "no"
        self.allowed += agrees == "allowed"
        self.left_open += agrees == "open"
        if agrees != "same" and is_number(signal.type):
            apart = abs(number_of(signal.type, recorded) - number_of(signal.type, found))
            self.largest = max(self.largest, apart) if math.isfinite(apart) else self.largest


class Tally:
    """Of one verification."""

    def __init__(self, program: Program, sites: Sites, trace: Trace) -> None:
        self._program, self._sites, self._trace = program, sites, trace
        self._counts = [_Count() for _ in trace.outputs]
        self._until = -1
        self._remembered: dict[str, Leaf] = {}
        self._assumed: tuple[Assumed, ...] = ()
        self._ungiven: dict[str, bool] = {}
        """What was read: whether nobody gives it a value."""
        self._mapped = {bit for each in (*trace.inputs, *trace.outputs) for bit in bits_of(each.symbol)}
        given = (each for each in trace.inputs if each.values and each.values[0] is not None)
        self._given = {bit for each in (*given, *trace.outputs) for bit in bits_of(each.symbol)}
        """Of them what has a value from the first row on: an input without one has its start value until then."""

    def remember(self, read: Mapping[str, Leaf]) -> Mapping[str, Leaf]:
        """Of what the program read in a scan before it wrote it: what it has from the scan before, and the trace does not."""
        self._remembered = {name: leaf for name, leaf in read.items() if self._is_memory(name, leaf)}
        return self._remembered

    @property
    def remembered(self) -> list[str]:
        """Those of which the trace did not tell."""
        known = {each.name for each in self._assumed}
        return [each for each in self._remembered if each not in known]

    def assume(self, assumed: tuple[Assumed, ...]) -> None:
        """Of some of it the trace told."""
        self._assumed = assumed

    def add(self, ran: Ran, shown: Sequence[Signal]) -> None:
        """A scan that ran; one that was counted is not counted again. `shown`: outputs that the range has rows of."""
        scan = ran.recorded.scan
        if scan <= self._until:
            return
        self._until = scan
        if ran.recorded.row is None:
            return
        wanted = {id(each) for each in shown}
        for count, each in zip(self._counts, ran.results, strict=True):
            if ran.recorded.taken_over or id(each.signal) not in wanted:
                continue
            if each.recorded is None:
                count.missing += 1
            else:
                count.add(each.signal, each.recorded, each.found, each.agrees)

    def read(self, read: Iterable[Leaf]) -> None:
        """What the range read in a scan before it wrote it, by the names that it has in the program."""
        for leaf in read:
            if leaf.name not in self._ungiven:
                self._ungiven[leaf.name] = self._is_ungiven(leaf)

    def _is_ungiven(self, leaf: Leaf) -> bool:
        """Whether it keeps its start value in the monitor, and may have another one in the controller."""
        if leaf.offset < Layout.HEADER_SIZE:
            return False
        try:
            symbol = resolve(self._program, leaf.name)
        except UnknownPath:
            symbol = Symbol(leaf.name, leaf.name, leaf.type, "", leaf.offset, leaf.bit)
        if (
            symbol.constant or symbol.slots or symbol.tool != "write"
        ):  # what no tool writes is the business of the system
            return False
        return self._given.isdisjoint(bits_of(symbol)) and not written(self._program, self._sites, symbol)

    def _is_memory(self, name: str, leaf: Leaf) -> bool:
        """Whether the program has it from the scan before, and the trace does not."""
        symbol = Symbol(name, name, leaf.type, "", leaf.offset, leaf.bit)
        return self._mapped.isdisjoint(bits_of(symbol)) and written(self._program, self._sites, symbol)

    def made(self, alone: Iterable[str]) -> VerifyCoverage:
        """So far. `alone`: what the range wrote and the trace has no column of."""
        outputs = tuple(
            Compared(
                each.column, each.path, count.compared, count.differing, count.allowed, count.left_open,
                count.missing, count.largest,
            )
            for each, count in zip(self._trace.outputs, self._counts, strict=True)
        )  # fmt: skip
        unrecorded, remembered = list(alone), self.remembered
        ungiven = [name for name, nobody in self._ungiven.items() if nobody]
        more = sum(max(0, len(each) - MOST_NAMES) for each in (unrecorded, remembered, ungiven))
        return VerifyCoverage(
            outputs, tuple(each.path for each in self._trace.inputs if any(one is not None for one in each.values)), self._trace.ignored, tuple(unrecorded[:MOST_NAMES]),
            tuple(remembered[:MOST_NAMES]), more, tuple(map(str, self._assumed)),
            tuple(ungiven[:MOST_NAMES]),
        )  # fmt: skip
