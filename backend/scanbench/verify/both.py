"""One scan on both sides: what the range used, what came out, and where the two part."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from scanbench.engines.debug import Frame
from scanbench.faults.disturb.disturb import DISTURBED, is_disturbance, told, told_held
from scanbench.faults.disturb.fire import Unfired
from scanbench.program.layout import Layout
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.command import Entry
from scanbench.runtime.holds import held
from scanbench.runtime.trap import Trapped, trap_info
from scanbench.symbols.leaves import WHOLE, Leaf
from scanbench.verify.contract import ENDED, Mismatch, Row
from scanbench.verify.control import Control, trap_of
from scanbench.verify.monitor import Inputs, Monitor
from scanbench.verify.ranges import Resolved
from scanbench.verify.rows import MAX_MISMATCHES, Disturbed, Pair, Reader, row_of
from scanbench.verify.sentences import mismatch, values
from scanbench.verify.sides import Begin, Side
from scanbench.verify.uses import Access, Pass, Recorder, results_are

MAX_BYTES = 2000
"""The number of differing bytes whose variables are looked up."""


@dataclass(frozen=True, slots=True)
class View:
    """How the program that runs is looked at."""

    reader: Reader
    range: Resolved
    limit: int


ViewOf = Callable[[Side], View]
"""Of the program that runs on a side."""


@dataclass(slots=True)
class Ran:
    """A scan, or the part of one before a trap, so that it can be run again."""

    view: View
    control: Begin
    monitor: Begin
    held: Mapping[int, int]
    calls: int
    """Passes of the scan before it."""
    there: dict[int, tuple[int, int]] = field(default_factory=dict)
    """What is held: offset -> mask, and the byte of the control device as the first statement began."""
    passes: list[Pass] = field(default_factory=list)
    """Of the control device."""
    counts: tuple[int, int] = (0, 0)
    """Statements that began in it, of the control device and of the monitor."""


class Both:
    """The control device and the monitor, side by side."""

    def __init__(self, reader: RunReader, control: Control, monitor: Monitor) -> None:
        self._reader, self.control, self.monitor = reader, control, monitor
        self.ran: list[Ran] = []
        """The scan that ran last."""
        self.ran_last = -1
        """Its number, also where nothing ran in it; -1: none since this was put somewhere."""
        self.told: list[str] = []
        self.missed: list[str] = []
        """Disturbances that did not come about, as the journal says it."""
        self.extra: list[Mismatch] = []
        self._disturbed = Disturbed()

    def goto(self, scan: int) -> None:
        """Before what was entered in a scan."""
        self.control.goto(scan)
        self.monitor.restart(self.control.side)
        self.ran, self.ran_last = [], -1
        self.told, self.missed, self.extra, self._disturbed = [], [], [], Disturbed()

    # ---- a whole scan ---------------------------------------------------------------------------------------------

    def run(self, scan: int, view_of: ViewOf) -> tuple[Row, ...]:
        """Runs the scan that is next."""
        self.ran, self.told, self.missed, self.extra, self._disturbed = [], [], [], [], Disturbed()
        rows: list[Row] = []
        while True:
            self.seam(scan)
            view = view_of(self.control.side)
            trapped = False
            if self.control.side.resource.runnable:
                more, trapped = self._run(scan, view, max((each.call for each in rows), default=0))
                rows += more
            elif not rows:
                rows.append(Row("none", scan, note=self._stopped(), compared=False))
            if not trapped:
                break
            if self._next(scan) is None:
                break
        self._pass_time(scan)
        self._look_at_record(view, scan)
        self.tell_disturbed(view, scan)
        self.ran_last = scan
        rows[0] = replace(rows[0], differences=(*self.extra, *rows[0].differences)[:MAX_MISMATCHES])
        rows[0] = replace(rows[0], note="; ".join(filter(None, (*self.missed, rows[0].note))))
        injected = tuple(dict.fromkeys(self.told))
        return tuple(replace(each, disturbances=injected) for each in rows) if injected else tuple(rows)

    def _stopped(self) -> str:
        header = self.control.side.resource.header
        if header.halted_by_trap:
            return "the program is stopped by a run-time error"
        return "the program is stopped by a fatal error" if header.halt else "the program is stopped: mode PROGRAM"

    def _pass_time(self, scan: int) -> None:
        control, monitor = self.control.side.resource, self.monitor.side.resource
        if control.header.scan == scan and not control.runnable and not control.header.halted_by_trap:
            control.pass_time(1)
            monitor.pass_time(1)

    def _next(self, scan: int) -> Entry | None:
        """What is to be entered next, in this scan."""
        entries, at = self._reader.entries, len(self.control.side.resource.journal)
        return entries[at] if at < len(entries) and entries[at].scan == scan else None

    def seam(self, scan: int) -> None:
        """Enters what was entered before the scan; then monitor and control device are in the same seam."""
        control, monitor = self.control, self.monitor
        disturbed = entered = False
        while (entry := self._next(scan)) is not None and not entry.step and not isinstance(entry.command, Trapped):
            entered = True
            control.enter(entry)
            monitor.enter(entry)
            if isinstance(entry.command, Unfired):
                self.missed.append(entry.plan.message)
            elif is_disturbance(entry.command):
                disturbed = True
                self._tell(entry)
        if disturbed:
            for at in self.different():
                self._disturbed.there[at] = control.side.memory[at]
                self._disturbed.own[at] = monitor.side.memory[at]
        if entered:
            monitor.take_over(control.side)
        self.told += told_held(control.side.resource.journal.derived(DISTURBED))
        steps = []
        while (entry := self._next(scan)) is not None and entry.step:
            control.side.wait_for([entry])
            steps.append(entry)
            if is_disturbance(entry.command):
                self._tell(entry)
        monitor.wait_for(steps)

    def _tell(self, entry: Entry) -> None:
        text = told(entry)
        if text:
            self.told.append(text)

    def _run(self, scan: int, view: View, calls: int) -> tuple[list[Row], bool]:
        """The rows, and whether it ended by a run-time error."""
        control, monitor = self.control.side, self.monitor.side
        ran = Ran(view, control.begin(), monitor.begin(), held(control.resource.journal), calls)
        self.ran.append(ran)
        recorder = Recorder(
            control.resource, view.reader.names, view.range, view.limit, disturbed={*self._disturbed.own, *ran.held}
        )
        ran.passes, self._disturbed.written = recorder.passes, recorder.written

        def first() -> None:
            ran.there.update((at, (mask, control.memory[at])) for at, mask in ran.held.items())

        recorder.on_first = first
        trap = self.control.run(recorder, ran.control)
        count = control.count
        if not recorder.began:
            first()
        inputs = Inputs(ran.passes, ran.there)
        other = Recorder(monitor.resource, view.reader.names, view.range, view.limit)
        right = trap_of(self.monitor.run(other, inputs))
        ran.counts = count, monitor.count
        if not other.began:
            inputs.first()
        self._note_held(inputs, ran)
        rows = self._rows(scan, ran, other.passes, inputs, (trap, right))
        if trap:
            at = max(len(ran.passes) - 1, 0)
            note = f"{ENDED}: {trap_info(control.resource.program, trap, scan)}"
            rows[at] = replace(rows[at], note="; ".join(filter(None, (rows[at].note, note))))
        self._keep_own(inputs, ran)
        self._go_on(scan, trap)
        return rows, bool(trap)

    def _go_on(self, scan: int, trap: int) -> None:
        entry = self._next(scan)
        if trap:
            if entry is None or not isinstance(entry.command, Trapped):
                raise Unreadable(f"scan {scan} ends by a run-time error, and did not when it was recorded")
            self.control.enter(entry)
            self.monitor.enter(entry)
        elif entry is not None:
            raise Unreadable(f"scan {scan} went to its end, and was broken off when it was recorded")
        self.monitor.take_over(self.control.side)

    # ---- what came out --------------------------------------------------------------------------------------------

    def _rows(
        self, scan: int, ran: Ran, other: list[Pass], inputs: Inputs, traps: tuple[int, int]
    ) -> list[Row]:  # fmt: skip
        """`traps`: numbers of the run-time errors that ended it on either side, or 0."""
        control, monitor, passes = self.control.side, self.monitor.side, ran.passes
        cut = traps[0] != traps[1]
        different = self.different(begin=ran.control.memory if cut else b"")
        if different and not any(each.full for each in (*passes, *other)):
            _settle(passes, other, control.memory, monitor.memory, different)
        rows = []
        for number in range(max(len(passes), len(other))):
            pair = Pair(
                passes[number] if number < len(passes) else None, other[number] if number < len(other) else None, scan,
                ran.calls + number + 1, cut,
            )  # fmt: skip
            rows.append(
                row_of(
                    ran.view.reader, pair, inputs, number, self._disturbed,
                    lambda count: control.frames_at(ran.control, count),
                    lambda count: monitor.frames_at(ran.monitor, count),
                )
            )  # fmt: skip
        if not rows:
            rows.append(Row("none", scan, note="not run in this scan"))
        if cut:
            at = max(len(passes) - 1, 0)
            side, begin = (control, ran.control) if traps[0] else (monitor, ran.monitor)
            frames = side.frames_at(begin, ran.counts[0 if traps[0] else 1])
            rows[at] = _with(rows[at], self.trap(ran.view, scan, *traps, frames))
        known = _explained(passes, other) if different else set()
        left = [at for at in different if at not in known]
        if left:
            # what differs already comes first: an instance that came out right is not marked for it
            at = next((number for number, each in enumerate(rows) if each.differs), len(rows) - 1)
            told = self._outside(ran.view, scan, left, control.memory, monitor.memory, rows[at].differs)
            rows[at] = _with(rows[at], *told)
        return rows

    def different(
        self, one: bytes | bytearray = b"", other: bytes | bytearray = b"", begin: bytes = b""
    ) -> list[int]:  # fmt: skip
        """The bytes in which the two states (by default the present ones) differ, except for the force table, the loop budget of the
        scan and what a disturbance holds. If only one side came to the end of the scan: those that the control device has changed since the
        scan began, except for counters of the system; what it did not reach is not reported as a difference."""
        one, other = one or self.control.side.memory, other or self.monitor.side.memory
        size = self.control.side.resource.program.layout.state_size
        found = np.flatnonzero(_bytes(one, size) != _bytes(other, size)).tolist()
        if not found:
            return []
        bits = held(self.control.side.resource.journal)
        return [
            at
            for at in found
            if not (Layout.FORCE_COUNT <= at < Layout.FORCES_END or Layout.BUDGET <= at < Layout.BUDGET + 8)
            and (one[at] ^ other[at]) & ~bits.get(at, 0)
            and not (begin and (at < Layout.HEADER_SIZE or one[at] == begin[at]))
        ]

    def _outside(
        self, view: View, scan: int, found: Sequence[int], control: bytes | bytearray, monitor: bytes | bytearray, after: bool
    ) -> list[Mismatch]:  # fmt: skip
        """Variables that the range does not use. `after` something that it does: a violation then kept what was different."""
        layout = self.control.side.resource.program.layout
        made = []
        for leaf in self.leaves(view, found, control, monitor):
            was, right = _cut(leaf, control), _cut(leaf, monitor)
            one, other = values(view.reader.names, leaf, was, right)
            text = f"{leaf.name} is {one}, the reference gives {other}, after scan {scan}"
            kept = after and layout.violations and leaf.offset >= layout.violations
            made.append(mismatch("logic" if kept else "outside", leaf, was, right, None, text))
        return made

    @staticmethod
    def leaves(
        view: View, found: Sequence[int], one: bytes | bytearray, other: bytes | bytearray
    ) -> list[Leaf]:  # fmt: skip
        """The variables that have any of these bytes, where their values differ."""
        leaves: dict[str, Leaf] = {}
        for at in found[:MAX_BYTES]:
            leaf = view.reader.names.whole(at, one[at] ^ other[at])
            if leaf.name not in leaves and _cut(leaf, one) != _cut(leaf, other):
                leaves[leaf.name] = leaf
        return list(leaves.values())[:MAX_MISMATCHES]

    def trap(self, view: View, scan: int, control: int, monitor: int, frames: tuple[Frame, ...]) -> Mismatch:
        """A run-time error, given by its number, ended the scan on one side; the other side had none or a different one. `frames`: the
        open calls where it happened, of the control device where it has one."""
        program = self.control.side.resource.program
        texts = [str(trap_info(program, each, scan)) if each else "" for each in (control, monitor)]
        if control:
            text = f"a run-time error ended scan {scan}: {texts[0]}; " + (
                f"in the reference a different one: {texts[1]}" if monitor else "the reference went on"
            )
        else:
            text = f"the control device went to the end of scan {scan}, and a run-time error ended the reference: {texts[1]}"
        place = view.reader.places.of_trap(control or monitor, frames)
        return Mismatch("trap", "run-time error", b"", b"", place, text)

    # ---- disturbances ---------------------------------------------------------------------------------------------

    def _note_held(self, inputs: Inputs, ran: Ran) -> None:
        for at, (mask, value) in ran.there.items():
            own = inputs.own.get(at, value)
            if (own ^ value) & mask:
                self._disturbed.there[at], self._disturbed.own[at] = value, value & ~mask | own & mask

    def _keep_own(self, inputs: Inputs, ran: Ran) -> None:
        """What is held is taken from the monitor's inputs for one scan only, unless the program wrote it."""
        memory = self.monitor.side.memory
        for at, (mask, value) in ran.there.items():
            if not (memory[at] ^ value) & mask:
                memory[at] = memory[at] & ~mask | inputs.own.get(at, value) & mask

    def tell_disturbed(self, view: View, scan: int) -> None:
        """Bytes that nobody wrote and no row has read."""
        disturbed = self._disturbed
        left = [at for at in disturbed.own if at not in disturbed.told]
        if not left:
            return
        there, own = (self._patched(each) for each in (disturbed.there, disturbed.own))
        made = []
        for leaf in self.leaves(view, left, there, own):
            was, right = _cut(leaf, there), _cut(leaf, own)
            one, other = values(view.reader.names, leaf, was, right)
            text = f"{leaf.name} was {one} in scan {scan}, and should have been {other}: nobody wrote it"
            made.append(mismatch("input", leaf, was, right, None, text))
        self.extra = [*made, *self.extra]

    def _patched(self, bytes_of: Mapping[int, int]) -> bytes:
        made = bytearray(self.ran[0].control.memory if self.ran else self.control.side.memory)
        for at, byte in bytes_of.items():
            made[at] = byte
        return bytes(made)

    def _look_at_record(self, view: View, scan: int) -> None:
        """The run file may have the state of this moment: it counts."""
        side = self.control.side
        recorded = self.control.recorded()
        if recorded is None:
            return
        here = side.state
        found = [at for at, (one, other) in enumerate(zip(recorded, here, strict=True)) if one != other]
        for leaf in self.leaves(view, found, recorded, here):
            was, again = _cut(leaf, recorded), _cut(leaf, here)
            one, other = values(view.reader.names, leaf, was, again)
            text = f"{leaf.name} was {one} after scan {scan} when it was recorded, and the same code gives {other} now"
            self.extra.append(mismatch("recorded", leaf, was, again, None, text))
        side.memory[: len(recorded)] = recorded
        self.monitor.take_over(side)


def _with(row: Row, *more: Mismatch) -> Row:
    """There is always room for a run-time error."""
    room = MAX_MISMATCHES - sum(each.cause == "trap" for each in more)
    return replace(row, differences=(*row.differences[:room], *more)[:MAX_MISMATCHES])


def _bytes(memory: bytes | bytearray, size: int) -> NDArray[np.uint8]:
    return np.frombuffer(memory, np.uint8, size)


def _cut(leaf: Leaf, memory: bytes | bytearray) -> bytes:
    return leaf.cut(memory, 0)


def _settle(
    passes: list[Pass], other: list[Pass], control: bytearray, monitor: bytearray, different: list[int]
) -> None:  # fmt: skip
    """Handles bytes that differ at the end although the statements gave the same results: the code that ran live computed
    them, or they were changed right after a statement. Each counts as the result of the last statement that wrote it, unless
    something else wrote it later."""
    for at in different[:MAX_BYTES]:
        for mine, right in zip(reversed(passes), reversed(other), strict=False):
            last = _last(right.log, at)
            if last is None:
                continue
            if last.bits != WHOLE or last.value[at - last.offset] == monitor[at]:
                results_are(mine.log, control, range(at, at + 1))
            break


def _last(log: list[Access], at: int) -> Access | None:
    """The last write of a byte."""
    return next((each for each in reversed(log) if each.written and each.offset <= at < each.offset + each.size), None)


def _explained(passes: list[Pass], other: list[Pass]) -> set[int]:
    """Bytes that rows tell of already."""
    found: set[int] = set()
    for number in range(max(len(passes), len(other))):
        mine = passes[number].log if number < len(passes) else []
        right = other[number].log if number < len(other) else []
        if mine == right:
            continue
        for index in range(max(len(mine), len(right))):
            pair = mine[index : index + 1], right[index : index + 1]
            if pair[0] != pair[1]:
                for each in (*pair[0], *pair[1]):
                    if each.written:
                        found.update(range(each.offset, each.offset + each.size))
    return found
