"""Where two runs first differ, and why: a command that only one of them has, a different program, a different beginning.

Runs are determined by what was entered. So while two of one program have the same journal and the same state, they stay the
same: only where their journals or their programs differ every scan is looked at.
"""

from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Literal

from scanbench.history.changes import Comparer, Moment, entered, moment_of, same_model
from scanbench.history.contract import BetweenEntry, Change, Changes, Divergence
from scanbench.history.first_write import first_write
from scanbench.history.left_out import LeftOut
from scanbench.recording.gaps import Gap
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.recording.replay import NOT_AS_RECORDED, replay
from scanbench.runtime.command import Entry
from scanbench.runtime.inside import Diverged
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import Trapped
from scanbench.verify.contract import Place

MAX_MARKS = 200
MAX_ENTRIES = 200
MAX_LEFT = 100
AFTER = 100
"""Scans after the difference whose entries are listed too."""
_CHUNK = 10_000
"""Scans between two looks at both."""
_LOOKS = 50_000
"""Scans after the first difference that are looked at; more of them only in part."""
OnProgress = Callable[[int, int], None]
"""Scans that are done, and of how many; may raise to end it."""


def find_divergence(one: RunReader, other: RunReader, on_progress: OnProgress = lambda done, of: None) -> Divergence:
    """The first scan after which anything differs. `Unreadable` says why the runs cannot be compared.

    Both have been followed; their programs must not share memory.
    """
    if one is other:
        raise Unreadable("that is one and the same run: choose a different one to compare it with")
    first, end = max(one.first, other.first), min(one.over, other.over)
    if first >= end:
        raise Unreadable(f"the runs have no scan in common: {_scans(one)}, {_scans(other)}")
    within = {
        (each.first, each.until): each
        for reader in (one, other)
        for each in reader.recording.gaps
        if each.until > first and each.first < end
    }
    gaps = [within[each] for each in sorted(within)]
    stretches = _between_gaps(first, end, gaps)
    if not stretches:
        raise Unreadable(f"no scan can be compared that both runs have: {gaps[-1]}")
    try:
        return _compared(one, other, stretches, gaps, on_progress)
    except (Diverged, *NOT_AS_RECORDED) as error:
        raise Unreadable(f"the runs cannot be compared: {error}") from error


_Stretch = tuple[int, int]
"""Scans: the first one, and the one after the last."""


def _between_gaps(first: int, end: int, gaps: Iterable[Gap]) -> list[_Stretch]:
    """The scans that can be compared, where commands are lost of one of the runs."""
    found: list[_Stretch] = []
    for gap in gaps:
        if first < gap.first:
            found.append((first, gap.first))
        first = max(first, gap.until)
    return [*found, (first, end)] if first < end else found


def _compared(
    one: RunReader, other: RunReader, stretches: Sequence[_Stretch], gaps: Sequence[Gap], on_progress: OnProgress
) -> Divergence:  # fmt: skip
    left_out, only, marks = LeftOut(), list[_Only](), list[tuple[int, int]]()
    parted: Divergence | None = None
    count, done = sum(end - first for first, end in stretches), 0
    for first, end in stretches:
        comparison = _Comparison(one, other, first, end, left_out, _going_on(on_progress, done, count))
        comparison.again = first > stretches[0][0]
        found = comparison.run()
        if found is not None:
            marks += found.marks
            parted = parted or found
        only += comparison.only
        done += end - first
    result = parted or _same(stretches, only, left_out, bool(gaps))
    text = result.text
    if gaps:
        lost = f"Not all was compared: {gaps[0]}"
        text = f"{text}. {lost}"
        left_out.lose(each.lost for each in gaps)
    left = left_out.found()
    return replace(
        result, text=text, marks=tuple(_joined(marks)), compared=count, first=stretches[0][0], last=stretches[-1][1] - 1,
        variables=left_out.variables, left=left[:MAX_LEFT], left_count=len(left),
    )  # fmt: skip


def _going_on(on_progress: OnProgress, before: int, count: int) -> OnProgress:
    """After so many scans of other stretches."""
    return lambda done, _: on_progress(before + done, count)


def _same(stretches: Sequence[_Stretch], only: Sequence["_Only"], left_out: LeftOut, gaps: bool) -> Divergence:
    count, left = sum(end - first for first, end in stretches), len(left_out.found())
    first, last = stretches[0][0], stretches[-1][1] - 1
    same: Literal["all", "partly", "nothing"] = "partly" if gaps else "all"
    text = f"the same in all {count:,} scans that both have, {first} to {last}"
    if gaps:
        text = f"the same in all {count:,} scans that could be compared, {first} to {last}"
    if left_out.nothing:
        same = "nothing"
        text = (
            "the programs have no variable in common: only addresses were compared, "
            f"the same in all {count:,} scans, {first} to {last}"
        )
    elif left:
        same = "partly"
        text = (
            f"in what both have they are the same in all {count:,} scans, {first} to {last}; "
            f"what only one has, or has otherwise, was not compared ({left:,})"
        )
    if only:
        text += ", although 1 command is only in one of them" if len(only) == 1 else ""
        text += f", although {len(only)} commands are only in one of them" if len(only) > 1 else ""
    told = tuple(each.told for each in only[:MAX_ENTRIES])
    return Divergence(count, first, last, None, "", text, None, None, told, same=same)


def _scans(reader: RunReader) -> str:
    if reader.first >= reader.over:
        return f"{reader.path.name} has none"
    return f"{reader.path.name} has scans {reader.first} to {reader.over - 1}"


class _Side:
    """One run, on its way through the scans. It is always in a seam, either before or after the entries for the next scan."""

    def __init__(self, reader: RunReader, first: int) -> None:
        self.reader = reader
        self.entries = reader.entries
        reader.goto(first)

    @property
    def resource(self) -> Resource:
        """What runs it. It is the reader's own: nobody else must move it meanwhile."""
        return self.reader.timeline.resource

    @property
    def state(self) -> bytearray:
        """The whole image."""
        return self.resource.memory

    def run_to(self, scan: int) -> None:
        """Runs to the seam before `scan`, before anything was entered there."""
        done = len(self.resource.journal)
        replay(self.resource, self.entries[done : bisect_left(self.entries, scan, key=attrgetter("scan"))], scan)

    def front(self) -> None:
        """Enters what was entered before the scan that is next."""
        resource, scan = self.resource, self.resource.header.scan
        for entry in self.entries[len(resource.journal) :]:
            if entry.scan != scan or entry.step or isinstance(entry.command, Trapped):
                break
            resource.reenter(entry)

    def moment(self) -> Moment:
        """Its present moment."""
        return moment_of(self.reader)


@dataclass(frozen=True, slots=True)
class _Only:
    """An entry that only one of them has."""

    side: Literal["A", "B"]
    entry: Entry

    @property
    def told(self) -> BetweenEntry:
        """For people."""
        return BetweenEntry(self.entry.scan, self.side, self.entry.command.author, entered(self.entry))


class _Comparison:
    again = False
    """There are scans before these that were compared: a gap is between."""

    def __init__(
        self, one: RunReader, other: RunReader, first: int, end: int, left_out: LeftOut, on_progress: OnProgress
    ) -> None:  # fmt: skip
        self._first, self._end, self._on_progress = first, end, on_progress
        self._one, self._other = _Side(one, first), _Side(other, first)
        self.only = list(_unpaired(self._one.entries, self._other.entries, first, end))
        self._comparers: dict[tuple[int, int], Comparer] = {}
        self._left_out = left_out

    def run(self) -> Divergence | None:
        """Both, up to where they part, and the stretches after that; None where they do not."""
        same_model(self._one.resource.program, self._other.resource.program)
        if self._differ():
            scan, begun = self._first, True
            changes = self._changes(scan, scan)
            marks = [(scan, scan)]
        else:
            found = self._part()
            if found is None:
                return None
            scan, begun, changes, marks = found, False, self._changes(found + 1, found + 1), [(found, found)]
        marks = self._stretches(scan if begun else scan + 1, marks)
        return self._told(scan, begun, changes, tuple(marks))

    # ---- comparing ------------------------------------------------------------------------------------------------

    def _comparer(self) -> Comparer:
        key = self._one.resource.version, self._other.resource.version
        if key not in self._comparers:
            one, other = self._one.moment(), self._other.moment()
            self._left_out.add(one, other)
            self._comparers[key] = Comparer(one, other)
        return self._comparers[key]

    def _equal(self) -> bool:
        """Whether they stay the same as long as the same is entered."""
        return self._comparer().equal(self._one.state, self._other.state)

    def _differ(self) -> bool:
        """Whether the two differ in anything but what every run has of its own, such as the clock."""
        return self._comparer().differ(self._one.state, self._other.state)

    def _changes(self, first: int, last: int) -> Changes:
        comparer = self._comparer()
        found = comparer.changes(self._one.state, self._other.state)
        note = "" if comparer.same_layout else "different programs run: variables are compared by their names"
        return Changes(first, last, found.changes, found.count, (), note, found.at_least)

    # ---- to where they part ---------------------------------------------------------------------------------------

    def _part(self) -> int | None:
        """Runs both to the end of the first scan after which they differ, and gives this scan; None if there is none."""
        places = sorted({each.entry.scan for each in self.only})
        now = self._first
        while now < self._end:
            place = next((each for each in places if each >= now), self._end) if self._equal() else now
            upto = min(place, self._end)
            if upto > now:
                found = self._together(now, upto)
                if found is not None:
                    return found
                now = upto
                continue
            self._one.front()
            self._other.front()
            self._run_to(now + 1)
            if self._differ():
                return now
            now += 1
            if now % _CHUNK == 0:
                self._on_progress(now - self._first, self._end - self._first)
        return None

    def _together(self, first: int, end: int) -> int | None:
        """Through scans in which the same was entered in both: they should not part there; where they do."""
        now = first
        while now < end:
            upto = min(end, now + _CHUNK)
            self._run_to(upto)
            self._on_progress(upto - self._first, self._end - self._first)
            if self._differ():
                return self._exactly(now, upto)
            now = upto
        return None

    def _exactly(self, first: int, end: int) -> int:
        """The same commands came to something else: which of these scans."""
        for side in (self._one, self._other):
            side.reader.goto(first)
        for scan in range(first, end):
            self._run_to(scan + 1)
            if self._differ():
                break
        return scan

    def _run_to(self, scan: int) -> None:
        self._one.run_to(scan)
        self._other.run_to(scan)

    # ---- after that ----------------------------------------------------------------------------------------------

    def _stretches(self, now: int, marks: list[tuple[int, int]]) -> list[tuple[int, int]]:
        """In which scans they differ."""
        places = sorted({each.entry.scan for each in self.only})
        stride = max(1, (self._end - now) // _LOOKS)
        equal = False
        while now < self._end:
            upto = min(self._end, now + stride)
            if equal:
                upto = max(now, min(self._end, next((each for each in places if each >= now), self._end)))
                upto = upto + 1 if upto == now else upto
            self._run_to(upto)
            self._on_progress(upto - self._first, self._end - self._first)
            equal = self._equal()
            if not equal and self._differ():
                if marks and marks[-1][1] >= now - 1:
                    marks[-1] = marks[-1][0], upto - 1
                else:
                    marks.append((now, upto - 1))
            now = upto
        return _joined(marks)

    # ---- for people -----------------------------------------------------------------------------------------------

    def _told(self, scan: int, begun: bool, changes: Changes, marks: tuple[tuple[int, int], ...]) -> Divergence:
        before = [each for each in self.only if each.entry.scan <= scan and each.entry.command.author != "PLC"]
        told = [each.told for each in self.only if each.entry.scan <= scan + AFTER]
        differ = self._programs_differ(scan)
        cause: Literal["", "command", "program", "start"] = "command" if before else "program"
        if begun and not before and not differ:
            cause = "" if self.again else "start"
        change = changes.changes[0] if changes.changes else None
        place: Place | None = None
        if not begun and change is not None:
            place, change = self._first_write(scan, changes.changes)
        text = _sentence(scan, begun, self.again, before[-1:], differ, place, change)
        return Divergence(
            self._end - self._first, self._first, self._end - 1, scan, cause, text, place, _led_by(changes, change),
            tuple(told[-MAX_ENTRIES:]), marks,
        )  # fmt: skip

    def _programs_differ(self, scan: int) -> bool:
        for side in (self._one, self._other):
            side.reader.goto(scan)
        return not self._one.moment().same_program(self._other.moment())

    def _first_write(self, scan: int, changes: Sequence[Change]) -> tuple[Place | None, Change]:
        """The statement that first wrote one of these variables in the scan, in either of them; and which."""
        best: tuple[int, Place, Change] | None = None
        for side in (self._other, self._one):
            found = first_write(side.reader, scan, changes)
            if found is not None and (best is None or found[0] < best[0]):
                best = found
        return (None, changes[0]) if best is None else best[1:]


def _unpaired(one: Sequence[Entry], other: Sequence[Entry], first: int, end: int) -> Iterator[_Only]:
    """What only one of them has, in the order of the scans."""

    def within(entries: Sequence[Entry]) -> list[Entry]:
        return [each for each in entries if first <= each.scan < end]

    mine, theirs = within(one), within(other)
    left, right = Counter(map(_key, mine)), Counter(map(_key, theirs))
    found = [_Only("A", each) for each in _surplus(mine, left - right)]
    found += [_Only("B", each) for each in _surplus(theirs, right - left)]
    yield from sorted(found, key=lambda each: (each.entry.scan, each.side))


def _key(entry: Entry) -> tuple[object, ...]:
    """What was entered, and where; not when on the wall, nor by whom. On equal states it does the same."""
    return entry.scan, entry.step, repr(replace(entry.command, author=""))


def _surplus(entries: Iterable[Entry], count: "Counter[tuple[object, ...]]") -> Iterator[Entry]:
    for entry in entries:
        if count[_key(entry)] > 0:
            count[_key(entry)] -= 1
            yield entry


def _joined(marks: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """At most `MAX_MARKS` stretches: those with the smallest gaps between them become one."""
    if len(marks) <= MAX_MARKS:
        return marks
    gaps = sorted(range(1, len(marks)), key=lambda at: marks[at][0] - marks[at - 1][1], reverse=True)
    begins = sorted((0, *gaps[: MAX_MARKS - 1]))
    ends = (*begins[1:], len(marks))
    return [(marks[begin][0], marks[end - 1][1]) for begin, end in zip(begins, ends, strict=True)]


def _led_by(changes: Changes, change: Change | None) -> Changes:
    """The same with this one in front."""
    if change is None:
        return changes
    return replace(changes, changes=(change, *(each for each in changes.changes if each is not change)))


def _sentence(
    scan: int, begun: bool, again: bool, before: Sequence[_Only], differ: bool, place: Place | None, change: Change | None
) -> str:  # fmt: skip
    """All of it in one sentence."""
    what = "nothing that has a name differs"
    if change is not None:
        what = f"{change.path} is {change.before_shown} in A and {change.after_shown} in B"
    if begun and not before:
        why = ", as different programs run" if differ else ""
        if again:
            return f"they are different where they can be compared again, before scan {scan}{why}: {what}"
        return f"they are different where they begin, before scan {scan}{why}: {what}"
    text = f"before scan {scan} {what}" if begun else f"after scan {scan} {what}"
    if place is not None:
        text += f", written at {place.file}:{place.line} in {place.instance}, task {place.task}"
    if before:
        only = before[0]
        text += f"; {only.entry.command.author} entered only in {only.side}, before scan {only.entry.scan}: "
        return text + entered(only.entry)
    if differ:
        return text + "; different programs run"
    return (
        text + "; nothing else was entered: one of them was recorded on a different machine, or by a different version"
    )
