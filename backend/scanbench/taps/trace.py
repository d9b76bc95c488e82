"""Traces: signals over scans, with a trigger. Recorded in the PLC's process, whoever looks.

A trace is recorded after every n-th scan by the engine itself (`engines.sample`), so no scan is missed. Its trigger is looked at in every
scan, also where the signals are recorded more seldom.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Literal

import numpy as np
from annotated_types import Ge, Le, MaxLen, MinLen
from numpy.typing import NDArray

from scanbench.check.typed.condition import BadCondition, Signal, compile_signal, parsed
from scanbench.engines.sample import HEAD_WORDS, MAX_SIGNALS, Sampling
from scanbench.program.program import Program
from scanbench.program.types import BOOL, Elementary, Enumeration, Kind
from scanbench.public import Public
from scanbench.taps.trace_buffer import TraceBuffer, Words, row_bytes

When = Literal["rises", "falls", "changes", "above", "below", "equals", "holds"]
WHENS: tuple[When, ...] = ("rises", "falls", "changes", "above", "below", "equals", "holds")
State = Literal["stopped", "recording", "armed", "triggered", "complete"]
MAX_TRACES = 8
MAX_SCANS = 10_000_000
MAX_BYTES = 256 << 20
"""Of all traces of a PLC."""
SignalText = Annotated[str, MinLen(1), MaxLen(2000)]
_COMPARED = {"above": ">", "below": "<", "equals": "="}


@dataclass(frozen=True, slots=True)
class TraceTrigger(Public):
    """What a trace waits for: an edge of `text` (of `text >= value`, where there is one), or that it is above, below, equal to
    the value, or that it `holds`, from when the trace is armed on."""

    GIVEN: ClassVar = True

    text: SignalText
    """A variable, an address, or an expression."""
    when: When = "rises"
    value: Annotated[str, MaxLen(200)] = ""
    """To compare with; empty for an edge of a BOOL."""
    before: Annotated[int, Ge(0), Le(100)] = 50
    """Percent of the buffer that is before the trigger."""


@dataclass(frozen=True, slots=True)
class TraceDefinition(Public):
    """What is to be recorded: `scans` is how far the buffer reaches back."""

    GIVEN: ClassVar = True

    name: Annotated[str, MinLen(1), MaxLen(100)]
    signals: Annotated[tuple[SignalText, ...], MinLen(1), MaxLen(MAX_SIGNALS)]
    """Variables, addresses, expressions."""
    every: Annotated[int, Ge(1), Le(1_000_000)] = 1
    """So many scans from sample to sample."""
    scans: Annotated[int, Ge(2), Le(MAX_SCANS)] = 30_000
    """How far the buffer reaches back."""
    trigger: TraceTrigger | None = None
    repeat: bool = False
    """With a trigger: armed again when it is complete; what is shown is the last complete record."""

    @property
    def rows(self) -> int:
        """Rows that the buffer holds."""
        return max(1, self.scans // self.every)


@dataclass(frozen=True, slots=True)
class TraceSignal(Public):
    """A signal of a trace; `message` says why it has no values (any more)."""

    text: str
    type: str = ""
    """Empty where it was never found."""
    kind: str = ""
    size: int = 0
    values: tuple[tuple[str, int], ...] = ()
    """Names of an enumeration's numbers."""
    message: str = ""


class BadTrace(Exception):
    """A trace that cannot be; the message says why, `near` what was perhaps meant."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.near = near


def check_definition(definition: TraceDefinition) -> None:
    """Bounds of all that needs no program to be checked; `BadTrace`."""
    if not definition.name.strip() or len(definition.name) > 100:
        raise BadTrace("A trace needs a name of 1 to 100 characters.")
    if not 0 < len(definition.signals) <= MAX_SIGNALS:
        raise BadTrace(f"The trace has {len(definition.signals)} signals; it may have 1 to {MAX_SIGNALS}.")
    doubles = [text for text in definition.signals if definition.signals.count(text) > 1]
    if doubles:
        raise BadTrace(f"`{doubles[0]}` is in the trace twice.")
    if not 1 <= definition.every <= 1_000_000:
        raise BadTrace(f"Every {definition.every} scans is no way to sample: from 1 to 1,000,000.")
    if not 2 <= definition.scans <= MAX_SCANS or definition.scans < definition.every:
        raise BadTrace(f"A buffer of {definition.scans} scans: from 2 (and `every`) to {MAX_SCANS:,}.")
    trigger = definition.trigger
    if trigger is not None:
        if trigger.when not in WHENS:
            raise BadTrace(f"`{trigger.when}` is no trigger; choose one of {', '.join(WHENS)}.")
        if not 0 <= trigger.before <= 100:
            raise BadTrace(f"{trigger.before} % before the trigger: from 0 to 100.")
        if trigger.when in _COMPARED and not trigger.value.strip():
            raise BadTrace(f"The trigger needs a value to be {trigger.when}.")
    if definition.repeat and trigger is None:
        raise BadTrace("Only a trace with a trigger can be armed again by itself.")


def resolve_signals(program: Program, texts: tuple[str, ...]) -> list[Signal | BadCondition]:
    """What each text means in this program."""
    return [compile_signal(program, text) for text in texts]


def trigger_signal(program: Program, trigger: TraceTrigger) -> Signal:
    """What the trigger looks at: BOOL, but for `changes`, which takes any value. `BadTrace` says what is wrong."""
    given = compile_signal(program, trigger.text)
    if isinstance(given, BadCondition):
        raise BadTrace(f"Trigger: {given.message}", given.near)
    text, value = trigger.text.strip(), trigger.value.strip()
    unreadable = parsed(value) if value else None  # what its names mean depends on what it is compared with
    if isinstance(unreadable, BadCondition):
        raise BadTrace(f"Trigger: the value `{value}` cannot be read: {unreadable.message}")
    if trigger.when in _COMPARED:
        text = f"({text}) {_COMPARED[trigger.when]} ({value})"
    elif value and trigger.when in ("rises", "falls", "changes"):
        text = f"({text}) >= ({value})"
    elif trigger.when == "changes":
        return given
    elif given.type != BOOL:
        hint = "compare it, as in `... > 0`" if trigger.when == "holds" else "give the value that it has to cross"
        raise BadTrace(f"Trigger: `{text}` is {given.type}, which is not TRUE or FALSE: {hint}.")
    made = compile_signal(program, text)
    if isinstance(made, BadCondition):
        raise BadTrace(f"Trigger: {made.message}", made.near)
    return made


class Trace:
    """A trace of one PLC. All in the thread that runs the scans, but for `buffer`, which anybody may read."""

    def __init__(self, id: int, definition: TraceDefinition, by: str) -> None:
        self.id, self.definition, self.by = id, definition, by
        self.state: State = "stopped"
        self.buffer = TraceBuffer((), 1)
        """What is shown."""
        self.generation = 0
        """Counts the buffers that were shown: samples of different buffers do not belong together."""
        self.triggered: int | None = None
        """The scan after which the trigger came, of what is shown."""
        self.hits = 0
        """How often it came since the trace was started."""
        self.note = ""
        self.signals: tuple[TraceSignal, ...] = tuple(map(TraceSignal, definition.signals))
        self._current = self.buffer
        self._types: dict[str, Elementary] = {}
        self._columns: list[int] = []
        self._sampling: Sampling | None = None
        self._watching: Sampling | None = None
        self._seen: int | None = None  # the last value that the trigger had, which was of the type `_seen_as`
        self._seen_as: Elementary = BOOL
        self._fired: int | None = None
        self._armed_from = 0

    # ---- what is recorded -----------------------------------------------------------------------------------------

    @property
    def running(self) -> bool:
        """Whether rows are still wanted."""
        return self.state in ("recording", "armed", "triggered")

    @property
    def samplings(self) -> tuple[Sampling, ...]:
        """What the engine has to sample."""
        if not self.running:
            return ()
        return tuple(each for each in (self._sampling, self._watching) if each is not None)

    @property
    def row_bytes(self) -> int:
        """What a row takes; with `repeat` there are two of each."""
        types = [self._types[text] for text in self.definition.signals if text in self._types]
        missing = len(self.definition.signals) - len(types)
        return (row_bytes(types) + 8 * missing) * (2 if self.definition.repeat else 1)

    @property
    def bytes(self) -> int:
        """What the buffer takes when it is full."""
        return self.row_bytes * self.definition.rows

    def define(self, definition: TraceDefinition, program: Program, by: str) -> None:
        """Sets a new definition: nothing is recorded until the trace is started. `BadTrace`."""
        check_definition(definition)
        found = resolve_signals(program, definition.signals)
        bad = next((each for each in found if isinstance(each, BadCondition)), None)
        if bad is not None:
            raise BadTrace(bad.message, bad.near)
        if definition.trigger is not None:
            trigger_signal(program, definition.trigger)
        self.definition, self.by = definition, by
        self._aim(found)
        self.stop()
        self._begin_again()

    def rename(self, name: str, by: str) -> None:
        """Sets a new name; recording continues."""
        self.definition, self.by = replace(self.definition, name=name), by

    def choose(self, definition: TraceDefinition, program: Program, scan: int, by: str) -> None:
        """Other signals, and nothing else: what was recorded of those that stay is kept, and goes on. Already checked."""
        before = self.definition.signals
        of = [before.index(text) if text in before else None for text in definition.signals]
        self.definition, self.by = definition, by
        found = resolve_signals(program, definition.signals)
        types = [
            self.buffer.types[column] if column is not None else each.type if isinstance(each, Signal) else BOOL
            for column, each in zip(of, found, strict=True)
        ]
        self._types = {text: type for text, type in self._types.items() if text in definition.signals}
        shown = self.buffer.with_columns(types, of)
        self._current = shown if self._current is self.buffer else self._current.with_columns(types, of)
        self._show(shown, self.triggered)
        self.aim(program, scan)

    def start(self, program: Program, scan: int) -> None:
        """Records from `scan` on, armed where there is a trigger. What was recorded before is forgotten. `BadTrace`."""
        self.aim(program, scan, fresh=True)
        if self._sampling is None:
            raise BadTrace("No signal of the trace is in the program that runs: " + self.signals[0].message)
        self._begin_again()
        self.hits, self.note = 0, ""
        self._arm(program, scan)

    def _arm(self, program: Program, scan: int) -> None:
        trigger = self.definition.trigger
        self._seen = self._fired = self._watching = None
        self._armed_from = scan
        if trigger is not None:
            self._watch(program, trigger, scan)
        self.state = "recording" if trigger is None else "armed"

    def _watch(self, program: Program, trigger: TraceTrigger, scan: int) -> None:
        signal = trigger_signal(program, trigger)
        if signal.type != self._seen_as:
            self._seen, self._seen_as = None, signal.type
        self._watching = Sampling(program, [signal], changes=True)
        self._watching.skip_to(scan)

    def stop(self) -> None:
        """Records no more; what there is stays."""
        if self.running:
            self.state = "complete" if self.state == "triggered" else "stopped"

    def aim(self, program: Program, scan: int, fresh: bool = False) -> None:
        """Finds the signals in a program that runs from `scan` on. The caller has drained what was sampled before."""
        types = dict(self._types)
        found = resolve_signals(program, self.definition.signals)
        self._aim(found)
        others = [text for text, type in types.items() if text in self._types and self._types[text] != type]
        good = [each for each in found if isinstance(each, Signal)]
        self._columns = [index for index, each in enumerate(found) if isinstance(each, Signal)]
        self._sampling = Sampling(program, good, self.definition.every) if good else None
        if self._sampling is not None:
            self._sampling.skip_to(scan)
        if fresh or not self.running:
            return
        if others:
            self._begin_again()
            self.note = f"begun again at scan {scan}: {', '.join(others)} has a different type"
        self._aim_trigger(program, scan)

    def _aim(self, found: "list[Signal | BadCondition]") -> None:
        before = {signal.text: signal for signal in self.signals}
        signals = []
        for text, each in zip(self.definition.signals, found, strict=True):
            if isinstance(each, BadCondition):
                known = before.get(text, TraceSignal(text))
                signals.append(TraceSignal(text, known.type, known.kind, known.size, known.values, each.message))
            else:
                self._types[text] = each.type
                signals.append(described(each))
        self.signals = tuple(signals)

    def _aim_trigger(self, program: Program, scan: int) -> None:
        trigger = self.definition.trigger
        if trigger is None:
            return
        self._watching = None
        try:
            self._watch(program, trigger, scan)
        except BadTrace as error:
            self.note = f"the trigger has no meaning in the program since scan {scan}: {error}"
            if self.state == "armed":
                self.stop()

    def _begin_again(self) -> None:
        self._current = self._empty()
        self._show(self._current, None)

    def _empty(self) -> TraceBuffer:
        # a signal that was never found has no values either: any type will do
        types = [self._types.get(text, BOOL) for text in self.definition.signals]
        return TraceBuffer(types, self.definition.rows)

    def _show(self, buffer: TraceBuffer, triggered: int | None) -> None:
        self.buffer, self.triggered = buffer, triggered
        self.generation += 1

    # ---- what comes -----------------------------------------------------------------------------------------------

    def drain(self, scan: int) -> bool:
        """Takes what was sampled up to `scan`, which is next; whether the state changed."""
        before = self.state, self.generation, self.hits
        sampling, watching = self._sampling, self._watching
        events = watching.take() if watching is not None else np.zeros((0, 3), dtype=np.uint64)
        if self.running:
            self._take(self._whole(sampling.take()) if sampling is not None else None, events, scan)
        return before != (self.state, self.generation, self.hits)

    def _take(self, rows: Words | None, events: Words, scan: int) -> None:
        rows = np.zeros((0, HEAD_WORDS + len(self.signals)), dtype=np.uint64) if rows is None else rows
        fires = self._fires(events) if self.definition.trigger is not None else []
        while True:
            if self.state == "armed":
                at = next((each for each in fires if each >= self._armed_from), None)
                if at is not None:
                    self.state, self._fired = "triggered", at
                    self.hits += 1
                    if self.buffer is self._current:
                        self.triggered = at
            if self.state != "triggered":
                self._current.append(rows)
                return
            assert self._fired is not None
            end = self._fired + 1 + self._scans_after
            cut = int(np.searchsorted(rows[:, 0], end))
            self._current.append(rows[:cut])
            if scan < end:
                return
            rows = rows[cut:]
            self._complete(end)
            if not self.running:
                return

    @property
    def _scans_after(self) -> int:
        """Scans that are recorded after the one of the trigger."""
        trigger = self.definition.trigger
        assert trigger is not None
        rows = self.definition.rows
        return max(0, rows - rows * trigger.before // 100 - 1) * self.definition.every

    def _complete(self, end: int) -> None:
        if self.buffer is not self._current or self.definition.repeat:
            self._show(self._current, self._fired)
        self.state = "complete"
        if self.definition.repeat and self._watching is not None:
            self._current, self.state = self._empty(), "armed"
            self._armed_from, self._fired = end, None

    def _whole(self, rows: Words) -> Words:
        """Rows with a column for every signal, also for those that are not sampled."""
        count = len(self.signals)
        if len(self._columns) == count:
            return rows
        whole = np.zeros((len(rows), HEAD_WORDS + count), dtype=np.uint64)
        whole[:, 0] = rows[:, 0]
        for at, column in enumerate(self._columns):
            whole[:, 1] |= (rows[:, 1] >> np.uint64(at) & np.uint64(1)) << np.uint64(column)
            whole[:, HEAD_WORDS + column] = rows[:, HEAD_WORDS + at]
        return whole

    def _fires(self, events: Words) -> list[int]:
        """Scans in which the trigger comes; `events` are the changes of what it looks at."""
        if not len(events):
            return []
        trigger = self.definition.trigger
        assert trigger is not None
        now = np.where(events[:, 1] & np.uint64(1), events[:, 2], np.uint64(0))
        known = self._seen is not None
        last: NDArray[np.uint64] = np.concatenate((np.array([self._seen or 0], dtype=np.uint64), now[:-1]))
        self._seen = int(now[-1])
        if trigger.when == "changes":
            fires = now != last
        elif trigger.when == "falls":
            fires = (now == 0) & (last != 0)
        else:
            fires = (now != 0) & (last == 0)
        if not known and trigger.when in ("rises", "falls", "changes"):
            fires[0] = False  # what it was before nobody saw
        return [int(each) for each in events[fires, 0]]


def described(signal: Signal) -> TraceSignal:
    """A signal as data."""
    type = signal.type
    values = type.values if isinstance(type, Enumeration) else ()
    return TraceSignal(signal.text, type.name, _kind(type), type.size, values)


def _kind(type: Elementary) -> str:
    return Kind(type.kind).value


def total_bytes(traces: Mapping[int, Trace]) -> int:
    """What all traces take together."""
    return sum(each.bytes for each in traces.values())
