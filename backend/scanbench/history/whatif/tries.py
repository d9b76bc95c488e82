"""Goes on with a recorded run from a scan, with some inputs set to other values; again and again."""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from scanbench.check.typed.condition import BadCondition, Condition, compile_condition, without_value
from scanbench.faults.disturb.disturb import DISTURBED, told
from scanbench.history.bench import Bench, outputs_of
from scanbench.history.entered import Entering, begun_with, given_after
from scanbench.history.scenario import Expectation, Step, write_scenario
from scanbench.history.scenario_of_run import scenario_of
from scanbench.history.whatif.contract import (
    MOST_SCANS,
    MOST_SET,
    MOST_TRIES,
    MOST_WINDOW,
    BadWhatIf,
    SetValue,
    Try,
    WhatIf,
    WhatIfWanted,
)
from scanbench.history.whatif.search import Candidate, Change, Search, searchable
from scanbench.program.program import Program
from scanbench.recording.gaps import gap_between
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Refusal, Swapped
from scanbench.runtime.forces import Force
from scanbench.runtime.restart import Restart
from scanbench.runtime.trap import Trapped
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.symbols.whole import bytes_of, worth_text

AUTHOR = "what if"
_SPAN = re.compile(r"([+-]?\d+)\s*\.\.\s*([+-]?\d+)(?:\s*/\s*(\d+))?")
OnTry = Callable[[int, int], None]
"""Tries that are done, and at most how many; may raise to end it."""


def what_if(reader: RunReader, wanted: WhatIfWanted, bench: Bench, on_try: OnTry = lambda done, of: None) -> WhatIf:
    """All that is wanted. `BadWhatIf`, `Unreadable`. The reader has been followed."""
    return _Tries(reader, wanted, bench, on_try).all()


class _Tries:
    def __init__(self, reader: RunReader, wanted: WhatIfWanted, bench: Bench, on_try: OnTry) -> None:
        wanted = replace(wanted, tried=spread(wanted.tried))
        _check(reader, wanted)
        self._reader, self._wanted, self._bench, self._on_try = reader, wanted, bench, on_try
        self._end = wanted.scan + wanted.window
        self._begin(disturbed=True)
        with reader.reading():
            self._program = reader.programs.get(reader.version(wanted.scan)).program
        self._condition = None if not wanted.condition else _condition(self._program, wanted.condition)
        self._watch = [_symbol(self._program, each) for each in wanted.watch]
        for path in (*(each.path for each in wanted.values), *filter(None, [wanted.vary])):
            _symbol(self._program, path)
        self._outputs: dict[int, bytes] = {}
        """After each scan of the recorded run a digest."""
        self._recorded = self._run((), self._outputs)
        self._undisturbed: Try | None = None
        self._disturbed = self._first_disturbed()
        if self._disturbed is not None:
            self._begin(disturbed=False)
            self._undisturbed = self._run((), {})
        self._tries: list[Try] = []

    def _begin(self, disturbed: bool) -> None:
        """All that is run from now on has the disturbances of the recorded run, or has none."""
        reader, scan = self._reader, self._wanted.scan
        self._bench.begin(reader, scan, AUTHOR, disturbed)
        self._given = [each for each in given_after(reader, scan, disturbed) if each.scan < self._end]

    def _first_disturbed(self) -> int | None:
        """The first of the scans to which a disturbance of the recorded run does anything, if there is one."""
        entries, scan = self._reader.entries, self._wanted.scan
        count = begun_with(self._reader, scan)
        if any(each.active for each in DISTURBED.over(entries[:count]).values()):
            return scan
        return next((each.scan for each in entries[count:] if each.scan < self._end and told(each)), None)

    def all(self) -> WhatIf:
        """What came of it."""
        wanted = self._wanted
        best, note = None, ""
        if wanted.search and wanted.values:
            self._try(())
        if wanted.search:
            best, note = self._search()
        elif wanted.vary:
            for value in wanted.tried:
                self._try(((wanted.vary, value),))
        else:
            self._try(())
        kept = (
            self._tries[best]
            if best is not None
            else next((each for each in self._tries if each.met is not None), None)
        )
        text, why = self._scenario(kept) if kept is not None else ("", "")
        notes = "; ".join(filter(None, (note, why, *self._notes())))
        return WhatIf(wanted, self._recorded, tuple(self._tries), best, notes, text, self._undisturbed)

    def _notes(self) -> Iterator[str]:
        """Why a try, or even the first row, may differ from the recorded run."""
        if self._disturbed is not None:
            yield f"the tries are without the disturbances, which come from scan {self._disturbed} on"
        inside = next((each for each in self._given if each.inside), None)
        if inside is not None:
            name, author = type(inside.command).__name__, inside.command.author
            yield f"{name} by {author} was entered inside of scan {inside.scan}, and is entered before it here"
        without = [
            each for each in (self._recorded, self._undisturbed, *self._tries) if each and each.unvalued is not None
        ]
        if without:
            told = without_value(self._wanted.condition, min(each.unvalued or 0 for each in without))
            yield f"{told}, which counts as not met (in {len(without)} of the runs)"
        if self._end > self._reader.over:
            yield f"the run has scans up to {self._reader.over - 1}: from there on the first row goes on like the tries"

    # ---- a search -------------------------------------------------------------------------------------------------

    def _search(self) -> tuple[int | None, str]:
        """The index of the smallest change, and what was not looked at."""
        before = self._tries[0] if self._tries else self._undisturbed or self._recorded
        if before.met is not None:
            return None, f"`{self._wanted.condition}` holds after scan {before.met} without any change"
        left: list[str] = []
        candidates = []
        memory = self._reader.at(self._wanted.scan).memory
        for path in self._wanted.candidates:
            symbol = _symbol(self._program, path)
            data = bytes_of(memory, symbol)
            if data is None or not searchable(symbol.type):
                left.append(path)
            else:
                candidates.append(Candidate(symbol.path, symbol.type, data))
        most = min(MOST_TRIES, max(1, MOST_SCANS // self._wanted.window))
        search = Search(candidates, lambda change: self._try(change, of=most).met is not None, most)
        found, whole = search.run()
        notes = [f"{', '.join(left)}: no values are tried of such a type"] if left else []
        if not whole:
            notes.append(f"it ended after {search.asked} tries: there may be a smaller change")
        elif not found:
            notes.append("no change of one of them, or of two that are BOOL, was found with which it holds")
        if any(each.counts for each in candidates):
            notes.append(
                "of numbers only some are tried, at distances that double and then between two of them: another one may do"
            )
        refused = [each.refused[0] for each in self._tries if each.refused and not each.ran]
        if refused and len(refused) == len(self._tries):
            return None, f"nothing could be tried: {refused[0]}"
        if not found:
            return None, "; ".join(notes)
        best = tuple(SetValue(*each) for each in found[0])
        return next(at for at, each in enumerate(self._tries) if each.values[-len(best) :] == best), "; ".join(notes)

    # ---- one try --------------------------------------------------------------------------------------------------

    def _try(self, change: Change, of: int = 0) -> Try:
        values = (*self._wanted.values, *(SetValue(*each) for each in change))
        done = self._run(values, {})
        self._tries.append(done)
        self._on_try(len(self._tries), of or max(1, len(self._wanted.tried)))
        return done

    def _run(self, values: tuple[SetValue, ...], outputs: dict[int, bytes]) -> Try:
        timeline = self._bench.gone_on()
        try:
            if timeline.resource.header.halted_by_trap:
                raise BadWhatIf(
                    f"a run-time error has stopped the program in scan {timeline.live_scan}: begin with an earlier scan, "
                    f"{max(timeline.live_scan - 1, 0)} at the latest"
                )
            entering = Entering(self._given)
            entering.enter(timeline)
            refused = self._set(timeline, values)
            if refused:
                return Try(values, refused=refused)
            return self._through(timeline, entering, values, outputs)
        finally:
            timeline.close()

    def _set(self, timeline: Timeline, values: tuple[SetValue, ...]) -> tuple[str, ...]:
        refused = []
        for each in values:
            made = (Force if self._wanted.hold else Write)(AUTHOR, each.path, each.value)
            outcome = timeline.submit(made)
            if isinstance(outcome, Refusal):
                refused.append(f"{each.path} := {each.value}: {outcome.message}")
        return tuple(refused)

    def _through(
        self, timeline: Timeline, entering: Entering, values: tuple[SetValue, ...], outputs: dict[int, bytes]
    ) -> Try:
        resource = timeline.resource
        met: int | None = None
        unvalued: int | None = None
        differs: int | None = None
        compared = 0
        while timeline.live_scan < self._end and not resource.header.halted_by_trap:
            scan = timeline.live_scan
            entering.enter(timeline)
            if resource.runnable:
                timeline.run(1)
            else:
                resource.idle(1)
            if timeline.live_scan == scan:  # a run-time error ended it
                break
            outputs[scan] = outputs_of(resource)
            known = self._outputs.get(scan)
            compared += known is not None
            if differs is None and known is not None and outputs[scan] != known:
                differs = scan
            if met is None and self._condition is not None:
                truth = resource.engine.truth(self._condition)
                met = scan if truth else None
                unvalued = scan if truth is None and unvalued is None else unvalued
        trap = resource.trap
        return Try(
            values, met, unvalued, differs, tuple(worth_text(resource.program, resource.memory, each) for each in self._watch),
            "" if trap is None else f"scan {trap.scan}, {trap.file}:{trap.line}: {trap.message}",
            tuple(entering.refused.values()), timeline.live_scan - self._wanted.scan, compared,
        )  # fmt: skip

    # ---- a test of it ---------------------------------------------------------------------------------------------

    def _scenario(self, kept: Try) -> tuple[str, str]:
        """The text of the file, or why there is none."""
        wanted = self._wanted
        if not wanted.condition:
            return "", ""
        try:
            made = scenario_of(self._reader, min(self._end, self._reader.end), [])
        except Unreadable as error:
            return "", f"no test can be made of it: {error}"
        verb = "force" if wanted.hold else "write"
        steps = [*made.steps, *(Step(wanted.scan, f"{verb} {each.path}={each.value}") for each in kept.values)]
        steps.sort(key=lambda each: each.at)
        expected = Expectation("holds", wanted.condition, wanted.scan + 1, self._end)
        return write_scenario(replace(made, scans=self._end, steps=tuple(steps), expect=(expected,))), ""


def _symbol(program: Program, path: str) -> Symbol:
    try:
        return resolve(program, path)
    except UnknownPath as error:
        raise BadWhatIf(error.message, tuple(error.near)) from None


def _condition(program: Program, text: str) -> Condition:
    found = compile_condition(program, text)
    if isinstance(found, BadCondition):
        raise BadWhatIf(f"{text}: {found.message}", found.near)
    return found


def spread(tried: Sequence[str]) -> tuple[str, ...]:
    """Each value; `A..B` and `A..B/STEP` are whole numbers, both ends included. `BadWhatIf`."""
    found: list[str] = []
    for text in tried:
        span = _SPAN.fullmatch(text.strip())
        if span is None:
            found.append(text.strip())
            continue
        first, last, step = int(span[1]), int(span[2]), int(span[3] or 1)
        if step == 0:
            raise BadWhatIf(f"{text}: the step is 0")
        if abs(last - first) // step >= MOST_TRIES:
            raise BadWhatIf(f"{text}: at most {MOST_TRIES} values can be tried: write a larger step, as in 0..1000/10")
        found += map(str, range(first, last + 1, step) if first <= last else range(first, last - 1, -step))
    return tuple(found)


def _check(reader: RunReader, wanted: WhatIfWanted) -> None:
    """`BadWhatIf` where it makes no sense."""
    if not reader.first <= wanted.scan < max(reader.over, reader.first + 1):
        raise BadWhatIf(f"scan {wanted.scan} is not in the run: it has scans {reader.first} to {reader.over - 1}")
    if not 1 <= wanted.window <= MOST_WINDOW:
        raise BadWhatIf(f"{wanted.window} scans cannot be gone on: 1 to {MOST_WINDOW} can")
    if max(len(wanted.values), len(wanted.candidates), len(wanted.watch)) > MOST_SET:
        raise BadWhatIf(f"at most {MOST_SET} variables can be set, searched among or watched")
    if len(wanted.tried) > MOST_TRIES:
        raise BadWhatIf(f"{len(wanted.tried)} values are too many: at most {MOST_TRIES}")
    if len(wanted.tried) * wanted.window > MOST_SCANS:
        raise BadWhatIf(
            f"{len(wanted.tried)} values with {wanted.window} scans each are too much: try fewer values, or fewer scans"
        )
    if wanted.vary and not wanted.tried:
        raise BadWhatIf(f"say which values of {wanted.vary} are to be tried")
    if wanted.search and not (wanted.candidates and wanted.condition):
        raise BadWhatIf("a search needs a condition, and the variables that may change")
    if wanted.search and wanted.vary:
        raise BadWhatIf("either the values of one variable are tried, or a change is looked for")
    if not (wanted.values or wanted.vary or wanted.search):
        raise BadWhatIf("say which variable is to have some other value")
    twice = {each.path.upper() for each in wanted.values} & {each.upper() for each in wanted.candidates}
    if twice:
        raise BadWhatIf(f"{min(twice)} cannot have a fixed value and be searched among")
    gap = gap_between(reader.recording.gaps, wanted.scan, wanted.scan + wanted.window)
    if gap is not None:
        raise BadWhatIf(f"scan {wanted.scan} and what follows cannot be run again: {gap}")
    trapped = next(
        (each.scan for each in reader.entries if isinstance(each.command, Trapped) and each.scan >= wanted.scan), None
    )
    for each in reader.entries:
        if (
            trapped is not None
            and trapped <= each.scan < wanted.scan + wanted.window
            and isinstance(each.command, Restart)
        ):
            raise BadWhatIf(
                f"a run-time error stopped the program in scan {trapped}, and it was restarted there: go on for at most "
                f"{trapped - wanted.scan} scans"
                if trapped > wanted.scan
                else f"a run-time error stopped the program in scan {trapped}, and it was restarted there: begin with scan {trapped + 1}"
            )
        if wanted.scan < each.scan < wanted.scan + wanted.window and isinstance(each.plan.effect, Swapped):
            raise BadWhatIf(
                f"the program was changed before scan {each.scan}: go on for at most {each.scan - wanted.scan} scans, "
                f"or begin with scan {each.scan}"
            )
