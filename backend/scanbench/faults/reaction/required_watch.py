"""Requirements, watched in a run with an error: what each of them came to, and the values that decided it."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

from scanbench.engines.interpreter.evaluate import Evaluator, NoValue
from scanbench.engines.interpreter.memory import Value
from scanbench.faults.reaction.reaction import Outcome, RequiredResult, Unchecked, ValueThen, Verdict, fulfils
from scanbench.faults.reaction.required_rules import Condition, Made
from scanbench.program.program import Program
from scanbench.symbols.leaves import Leaf


def result(made: Made, outcome: Outcome, reason: Unchecked = "", note: str = "") -> RequiredResult:
    """Of one requirement, without evidence."""
    source = made.source
    return RequiredResult(source.text, source.span.line, outcome, source.recovery, reason=reason, note=note)


def not_checked(every: Iterable[Made], reason: Unchecked, note: str) -> tuple[RequiredResult, ...]:
    """The same for all that need a run. What is invalid says so first."""
    return tuple(
        result(made, "not_checked", "invalid", made.invalid)
        if made.invalid
        else result(made, "not_checked", reason, note)
        for made in every
        if made.condition is not None or made.invalid
    )


def graded(every: Iterable[Made], verdict: Verdict) -> tuple[RequiredResult, ...]:
    """The grades among them."""
    found = []
    for made in every:
        if made.grade is not None:
            passed = made.grade == "none" or fulfils(verdict, made.grade)
            found.append(
                replace(result(made, "passed" if passed else "failed"), values=(ValueThen("verdict", verdict),))
            )
    return tuple(found)


@dataclass(slots=True)
class _Open:
    """A requirement that is not decided yet."""

    made: Made
    holds: Callable[[int], Value]
    ends: Callable[[int], Value] | None
    over: bool = False
    """`until` was TRUE before scan 1 already: then it does not spare that scan."""
    met: bool = False
    """of `within ... until`: it came true in time, and has to stay so."""
    done: RequiredResult | None = None
    kept: RequiredResult | None = None
    """of `end`: what it is now, if this is the end."""


class Watch:
    """The requirements of one phase: since the error was raised, or since it was recovered."""

    def __init__(self, every: Sequence[Made], program: Program, memory: bytearray, window: int) -> None:
        self._window, self._kept = window, 0
        self._evaluator = Evaluator(program, memory)
        self._open = [
            _Open(made, self._evaluator.valued(made.condition.local),
                  None if made.until is None else self._evaluator.valued(made.until.local))
            for made in every if made.condition is not None and made.source.form != "may_restart"
        ]  # fmt: skip
        for each in self._open:
            each.over = each.made.source.form != "within" and each.ends is not None and _is_true(each.ends)

    def after(self, scan: int) -> None:
        """The image as it is after a scan."""
        for each in self._open:
            if each.done is None:
                try:
                    self._look(each, scan)
                except NoValue as why:
                    each.done = _valueless(each.made, scan, why)

    def keep(self, scan: int) -> None:
        """What requirements about the end come to, should the phase end after this scan."""
        if scan == self._kept:
            return
        self._kept = scan
        for each in self._open:
            if each.done is None and each.made.source.form == "end":
                each.kept = self._ended(each, scan)

    def close(self, scan: int) -> None:
        """The phase is over after this scan, as the error is gone: nothing is looked at any more."""
        self.keep(scan)
        for each in self._open:
            each.done = each.done or each.kept or self._closed(each, scan)

    def results(self, scan: int, ended: str = "") -> list[RequiredResult]:
        """What came of each, after the last scan; `ended` says what ended the run early."""
        return [each.done or self._at_the_end(each, scan, ended) for each in self._open]

    def _look(self, each: _Open, scan: int) -> None:
        source = each.made.source
        if source.form == "end" and scan < self._window:
            return
        if each.ends is not None and (source.form != "within" or each.met) and each.ends(0) and not each.over:
            each.done = self._decided(each, "passed", scan, "until came")
            return
        holds = bool(each.holds(0)) != (source.form == "never")
        if source.form == "within" and not each.met:
            each.met = holds
            if holds and each.ends is None:
                each.done = self._decided(each, "passed", scan)
            elif not holds and scan >= each.made.scans:
                each.done = self._decided(each, "failed", scan)
        elif source.form == "end":
            each.done = self._decided(each, "passed" if holds else "failed", scan)
        elif not holds:
            each.done = self._decided(each, "failed", scan)
        elif each.over and each.ends is not None and each.ends(0):
            each.done = self._decided(each, "passed", scan, "until came")
        each.over = False

    def _at_the_end(self, each: _Open, scan: int, ended: str) -> RequiredResult:
        source = each.made.source
        if ended:
            return replace(result(each.made, "not_checked", "ended", ended), scan=scan)
        if source.form == "within" and not each.met:
            note = f"it has {each.made.scans} scans, and the window has {scan}: use a longer window"
            return result(each.made, "not_checked", "window", note)
        if scan < self._window:
            note = f"only {scan} of {self._window} scans could be run"
            return result(each.made, "not_checked", "window", note)
        return self._decided(each, "passed", scan, "until did not come" if each.ends is not None else "")

    def _ended(self, each: _Open, scan: int) -> RequiredResult:
        try:
            return self._decided(each, "passed" if each.holds(0) else "failed", scan)
        except NoValue as why:
            return _valueless(each.made, scan, why)

    def _closed(self, each: _Open, scan: int) -> RequiredResult:
        if not scan:
            return result(each.made, "not_checked", "window", "no scan was run with the error")
        if each.made.source.form == "within" and not each.met:
            note = f"it has {each.made.scans} scans, and the error was present in {scan} only"
            return result(each.made, "not_checked", "window", note)
        return self._decided(each, "passed", scan, "until did not come" if each.ends is not None else "")

    def _decided(self, each: _Open, outcome: Outcome, scan: int, note: str = "") -> RequiredResult:
        conditions = [each.made.condition, each.made.until]
        values = tuple(value for one in conditions if one is not None for value in self._values(one))
        return replace(result(each.made, outcome, note=note), scan=scan, values=tuple(dict.fromkeys(values)))

    def _values(self, condition: Condition) -> Iterable[ValueThen]:
        for part in condition.parts:
            try:
                yield ValueThen(part.text, self._evaluator.text(part, 0))
            except NoValue as why:
                yield ValueThen(part.text, str(why))


def _valueless(made: Made, scan: int, why: NoValue) -> RequiredResult:
    note = f"it has no value in scan {scan}: {why}"
    return replace(result(made, "not_checked", "invalid", note), scan=scan)


def allows(every: Iterable[Made], leaf: Leaf, program: Program, memory: bytearray) -> str:
    """The requirement that lets this output go on again: one that says so, or one that it is needed for. Empty: none."""
    recovering = [made for made in every if made.source.recovery and made.condition is not None]
    off = bytearray(memory)
    for at in range(leaf.offset, leaf.offset + leaf.type.size):
        off[at] &= ~leaf.bits
    for made in recovering:
        assert made.condition is not None
        on, without = (_value(made.condition, program, each) for each in (memory, off))
        if (
            (made.source.form == "may_restart" and on != without)
            or (made.source.form in ("within", "end", "always") and on and not without)
            or (made.source.form == "never" and without and not on)
        ):
            return made.source.text
    return ""


def _is_true(holds: Callable[[int], Value]) -> bool:
    try:
        return bool(holds(0))
    except NoValue:
        return False


def _value(condition: Condition, program: Program, memory: bytearray) -> Value:
    try:
        return Evaluator(program, memory).value(condition.local, 0)
    except NoValue:
        return 0
