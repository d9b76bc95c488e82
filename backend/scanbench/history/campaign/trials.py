"""Tries the disturbances of a campaign, each alone, on the run as it was recorded; and looks who noticed."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from hashlib import blake2b
from itertools import chain
from pathlib import Path

from scanbench.check.typed.condition import BadCondition, Condition, compile_condition, without_value
from scanbench.faults.disturb.definition import Disturbance, describe
from scanbench.faults.disturb.disturb import DISTURBED, Disturb, told
from scanbench.faults.disturb.fire import Firing
from scanbench.faults.inject import Generate
from scanbench.history.bench import Bench, outputs_of
from scanbench.history.campaign.contract import (
    MOST_SCANS,
    MOST_TRIALS,
    MOST_WINDOW,
    BadCampaign,
    Campaign,
    CampaignWanted,
    Outcome,
    Trial,
)
from scanbench.history.campaign.plan import planned
from scanbench.history.entered import Entering, given_after
from scanbench.history.places import places
from scanbench.history.rerun_plan import number_of
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.recording.gaps import gap_between
from scanbench.recording.reader import RunReader
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Refusal, Swapped
from scanbench.runtime.holds import held
from scanbench.runtime.resource import Resource
from scanbench.symbols.violations import Key, Violation, read_violations
from scanbench.verify.contract import Mismatch, Range
from scanbench.verify.run_subject import RunSubject
from scanbench.verify.verifier import Verifier

AUTHOR = "campaign"
_LOOKED = 25
"""Scans with a disturbance that are verified, at most."""
OnTrial = Callable[[Trial, int], None]
"""A trial that is done, and of how many; may raise to end it."""


@dataclass(slots=True)
class _Seen:
    """A run, scan by scan."""

    outputs: dict[int, bytes] = field(default_factory=dict)
    """A digest after each scan, ..."""
    states: dict[int, tuple[bytes, bytes]] = field(default_factory=dict)
    """... and of all that is kept but the force table and the inputs; and the inputs themselves."""
    alarms: dict[int, tuple[bool | None, ...]] = field(default_factory=dict)
    """Whether each of them holds; None where it has no value."""
    errors: list[tuple[int, str]] = field(default_factory=list)
    """What the PLC or its program raised, and before which scan."""
    violations: dict[Key, Violation] = field(default_factory=dict)
    refused: dict[int, str] = field(default_factory=dict)
    """Of what is entered: the places in the list of it that were refused, and why."""
    held: dict[int, int] = field(default_factory=dict)
    """Offset -> the bits of inputs that a disturbance still holds at the end."""
    trap: tuple[int, str] | None = None
    number: int = 0
    """What the disturbance was given."""
    end: int = 0
    """Scans before this one are over."""


def run_campaign(
    reader: RunReader, wanted: CampaignWanted, bench: Bench, on_trial: OnTrial = lambda trial, of: None,
    only: Sequence[int] = (),
) -> Campaign:  # fmt: skip
    """All of them, or those with the numbers `only`. `BadCampaign`, `Unreadable`.

    The reader has been followed. Files in the bench's folder are left for who wants them.
    """
    trials = Trials(reader, wanted, bench)
    numbers = list(only) or range(1, len(trials.disturbances) + 1)
    done = []
    for number in numbers:
        done.append(trials.trial(number))
        on_trial(done[-1], len(numbers))
    return Campaign(wanted, tuple(done))


class Trials:
    """The trials of one campaign, and the run without any disturbance."""

    def __init__(self, reader: RunReader, wanted: CampaignWanted, bench: Bench) -> None:
        _check(reader, wanted)
        self._wanted, self._bench = wanted, bench
        bench.begin(reader, wanted.first, AUTHOR)
        self._given = given_after(reader, wanted.first, disturbed=False)
        with reader.reading():
            self.program = reader.programs.get(reader.version(wanted.first)).program
        self.disturbances = planned(self.program, wanted)
        self._alarms = [_condition(self.program, each) for each in wanted.alarms]
        self._right = self._run(None, wanted.last + wanted.window + 1)

    def trial(self, number: int) -> Trial:
        """One of them; its run file is there until the next one. `BadCampaign` where there is no such number."""
        if not 1 <= number <= len(self.disturbances):
            raise BadCampaign(f"there is no disturbance {number}: there are {len(self.disturbances)}")
        wanted = self.disturbances[number - 1]
        assert wanted.scan is not None
        end = min(wanted.scan + self._wanted.window + 1, self._right.end)
        seen = self._run(wanted, end)
        trial = Trial(number, describe(wanted), wanted.kind, wanted.scan, "missed")
        fired, why = self._fired(wanted, seen.number)
        if not fired:
            return replace(trial, why=why)
        difference, at = self._verified(fired)
        noticed, program_scan = self._noticed(seen, wanted.scan)
        output = next((scan for scan in sorted(seen.outputs) if self._differs(seen, scan)), None)
        differs = seen.trap != self._right.trap or self._remembers(seen, max(seen.states, default=wanted.scan))
        refused = tuple(text for at, text in seen.refused.items() if at not in self._right.refused)
        return replace(
            trial, outcome=_outcome(difference is not None, bool(noticed), output is not None or differs),
            verification="" if difference is None else difference.message, verified_scan=at,
            place=None if difference is None else difference.place, program=noticed, program_scan=program_scan,
            output_scan=output, differs=differs, trapped=seen.trap is not None and self._right.trap != seen.trap,
            refused=refused, unvalued=tuple(self._unvalued(seen, wanted.scan)),
        )  # fmt: skip

    @property
    def file(self) -> Path:
        """The run file of the trial that was run last."""
        return self._bench.file

    # ---- running --------------------------------------------------------------------------------------------------

    def _run(self, wanted: Disturbance | None, end: int) -> _Seen:
        """The run from its beginning to a scan, with the disturbance or without."""
        timeline = self._bench.gone_on()
        seen = _Seen()
        begin = timeline.live_scan if wanted is None or wanted.scan is None else wanted.scan
        known, entering = len(timeline.live_journal), Entering(self._given)
        try:
            entering.enter(timeline)
            if wanted is not None:
                outcome = timeline.submit(Disturb(AUTHOR, wanted))
                if isinstance(outcome, Refusal):
                    raise BadCampaign(f"{describe(wanted)}: {outcome.message}")
                seen.number = number_of(outcome) or 0
            self._through(timeline, seen, entering, begin, end)
            seen.end = timeline.live_scan
            self._take(timeline, seen, known)
        finally:
            timeline.close()
        return seen

    def _through(self, timeline: Timeline, seen: _Seen, entering: Entering, begin: int, end: int) -> None:
        """Scan by scan from `begin` on; before that as fast as it goes."""
        resource = timeline.resource
        while (now := timeline.live_scan) < end and not resource.header.halted_by_trap:
            entering.enter(timeline)
            until = now + 1 if now >= begin else min(entering.following(end), begin)
            if resource.runnable:
                timeline.run(until - now)
            else:
                resource.idle(until - now)
            if timeline.live_scan > begin:
                self._look(resource, seen, timeline.live_scan - 1)
        seen.refused = entering.refused

    def _look(self, resource: Resource, seen: _Seen, scan: int) -> None:
        seen.outputs[scan] = outputs_of(resource)
        kept, inputs = bytearray(resource.state), b""
        kept[Layout.FORCE_COUNT : Layout.FORCES_END] = bytes(Layout.FORCES_END - Layout.FORCE_COUNT)
        for stretch in places(resource.program, "I"):
            inputs += kept[stretch.start : stretch.stop]
            kept[stretch.start : stretch.stop] = bytes(len(stretch))
        before = seen.states.get(scan - 1)
        if before is not None and before[1] == inputs:
            inputs = before[1]  # they hardly ever change, and are kept once
        seen.states[scan] = blake2b(kept, digest_size=8).digest(), inputs
        seen.alarms[scan] = tuple(map(resource.engine.truth, self._alarms))

    def _take(self, timeline: Timeline, seen: _Seen, known: int) -> None:
        """What is known at the end."""
        resource = timeline.resource
        seen.held = held(resource.journal)
        for entry in timeline.live_journal[known:]:
            if isinstance(entry.command, Generate) and entry.command.origin != "simulator":
                seen.errors.append((entry.scan, entry.plan.message))
        for each in read_violations(resource.program, resource.memory).entries:
            seen.violations[each.key] = each
        if resource.trap is not None:
            seen.trap = (
                resource.trap.scan,
                f"run-time error at {resource.trap.file}:{resource.trap.line}: {resource.trap.message}",
            )

    # ---- what came of it ------------------------------------------------------------------------------------------

    def _differs(self, seen: _Seen, scan: int) -> bool:
        return seen.outputs[scan] != self._right.outputs.get(scan)

    def _remembers(self, seen: _Seen, scan: int) -> bool:
        """Whether anything else is remembered after this scan than without the disturbance. What holds an input, in the force
        table and at its place, is the disturbance itself: it is left out as long as it holds."""
        mine, right = seen.states.get(scan), self._right.states.get(scan)
        if mine is None or right is None:
            return mine is not right
        offsets = chain.from_iterable(places(self.program, "I"))
        inputs = zip(offsets, mine[1], right[1], strict=True)
        return mine[0] != right[0] or any((one ^ other) & ~seen.held.get(at, 0) for at, one, other in inputs)

    def _noticed(self, seen: _Seen, first: int) -> tuple[tuple[str, ...], int | None]:
        """What the program did that it does not do by itself, and when that began."""
        right, found = self._right, list[tuple[int, str]]()
        if seen.trap is not None and seen.trap != right.trap:
            found.append(seen.trap)
        usual = {text for scan, text in right.errors if scan >= first}
        found += [(scan, text) for scan, text in seen.errors if scan >= first and text not in usual]
        for place, each in seen.violations.items():
            if each.first_scan >= first and place not in right.violations:
                found.append((each.first_scan, each.told))
        for index, text in enumerate(self._wanted.alarms):
            scans = (scan for scan, held in sorted(seen.alarms.items()) if held[index])
            at = next((scan for scan in scans if not self._usual(scan, index)), None)
            if at is not None:
                found.append((at, f"`{text}` held"))
        found.sort()
        return tuple(text for _, text in found), found[0][0] if found else None

    def _usual(self, scan: int, index: int) -> bool:
        held = self._right.alarms.get(scan)
        return held is not None and bool(held[index])

    def _unvalued(self, seen: _Seen, first: int) -> Iterator[str]:
        """Of each alarm that had no value, the first scan after which that was so."""
        for index, text in enumerate(self._wanted.alarms):
            at = next(
                (scan for scan, held in sorted(seen.alarms.items()) if scan >= first and held[index] is None), None
            )
            if at is not None:
                yield without_value(text, at)

    def _fired(self, wanted: Disturbance, number: int) -> tuple[list[int], str]:
        """The scans in which it changed or held anything; else why it did not come about."""
        with self._reader() as reader:
            reader.follow()
            journal = reader.entries
            mine = (each for each in journal if isinstance(each.command, Firing) and each.command.id == number)
            scans = {each.scan for each in mine if told(each)}
            if wanted.kind in ("stuck", "late") and wanted.scan is not None and scans:
                scans |= set(range(wanted.scan, min(wanted.scan + (wanted.lasts or 1), reader.end)))
            left = DISTURBED.over(journal).get(str(number))
            why = left.missed if left is not None and left.missed else "the run ended before"
        return sorted(scans), why

    def _verified(self, scans: Sequence[int]) -> tuple[Mismatch | None, int | None]:
        """The first difference in these scans."""
        with Verifier(RunSubject(self._reader())) as verifier:
            verifier.begin(Range(), scan=scans[0])
            for scan in scans[:_LOOKED]:
                if scan >= verifier.end:
                    break
                for row in verifier.verify(scan).rows:
                    if row.differences:
                        return row.differences[0], scan
        return None, None

    def _reader(self) -> RunReader:
        return RunReader(self._bench.file, lambda kept: self._bench.verifies, self._bench.codec, self._bench.texts_of)


def _outcome(verification: bool, program: bool, changed: bool) -> Outcome:
    if verification:
        return "both" if program else "verification"
    if program:
        return "program"
    return "nothing" if changed else "no effect"


def _condition(program: Program, text: str) -> Condition:
    found = compile_condition(program, text)
    if isinstance(found, BadCondition):
        raise BadCampaign(f"{text}: {found.message}")
    return found


def _check(reader: RunReader, wanted: CampaignWanted) -> None:
    """`BadCampaign` where numbers make no sense."""
    bounds: Iterator[tuple[str, int, int, int]] = iter(
        (
            ("number of disturbances", wanted.count, 1, MOST_TRIALS),
            ("window", wanted.window, 0, MOST_WINDOW),
            ("seed", wanted.seed, 0, (1 << 63) - 1),
        )
    )
    for name, number, least, most in bounds:
        if not least <= number <= most:
            raise BadCampaign(f"the {name} is {number}: it must be {least} to {most}")
    if not wanted.kinds:
        raise BadCampaign("no kind of disturbance was chosen")
    if not reader.first <= wanted.first <= wanted.last < max(reader.over, reader.first + 1):
        raise BadCampaign(
            f"scans {wanted.first} to {wanted.last} cannot be disturbed: the run has scans {reader.first} to {reader.over - 1}"
        )
    if wanted.last - wanted.first >= MOST_SCANS:
        raise BadCampaign(f"{wanted.last - wanted.first + 1} scans are too many: at most {MOST_SCANS}")
    end = wanted.last + wanted.window + 1
    gap = gap_between(reader.recording.gaps, wanted.first, end)
    if gap is not None:
        raise BadCampaign(f"scans {wanted.first} to {end - 1} cannot be run again: {gap}")
    for each in reader.entries:
        if wanted.first < each.scan < end and isinstance(each.plan.effect, Swapped):
            raise BadCampaign(
                f"the program was changed before scan {each.scan}, and a campaign is about one program: let the disturbances "
                f"begin with scan {each.scan}, or end so early that the last window ends before it"
            )
