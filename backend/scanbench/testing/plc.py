"""The PLC of one test: it runs when the test says so, on virtual time. Its run is recorded, for whoever looks at a failure."""

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.engine import Reason
from scanbench.faults.detect import Detection
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.faults.inject import ACTIVE, Generate, Recover, present_texts
from scanbench.faults.network_agenda import Network
from scanbench.faults.reference import parse_reference
from scanbench.program.program import Program
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Command, Refusal, RestartKind
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.joined import Joined
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.symbols.whole import Worth, worth, worth_text
from scanbench.testing.project import Project
from scanbench.wire.codec import ENTRIES, pack_body
from scanbench.wire.host import Sources

Value = str | int | float | bool
AUTHOR = "test"
NO_VALUE = "has no value (an index is outside, a divisor is 0 or a reference refers to nothing)"
_VERSION = 1
_NAMES = re.compile(r"[A-Za-z_][\w.]*(?:\[[^]]*\][\w.]*)*")
_SHOWN = 12


class PlcFailure(AssertionError):
    """The PLC did something else than the test asked for."""


class PlcRefused(Exception):
    """The PLC did not take a command, or a text means nothing to its program; the message says why."""


class Plc:
    """A virtual PLC from a cold start in MONITOR mode. Values are as they are typed: `TRUE`, `T#5s`, `'text'`; True, 5 and 1.5 too."""

    def __init__(self, project: Project, run: Path) -> None:
        """`run` is where its run file is to be."""
        self._project, self.run_file, self._closed = project, run, False
        self.ran = 0
        """Scans in which the program ran."""
        sources = Sources(project.model, project.files, project.loaded.program.interval_ns, _VERSION)
        self._timeline = Timeline.begin(
            run, LoadedPrograms(project.loaded), _VERSION, pack_body(sources), ENTRIES, AUTHOR, Detection(),
            agenda=Joined(DisturbanceSchedule(), Network()),
        )  # fmt: skip

    @property
    def _resource(self) -> Resource:
        return self._timeline.resource

    def close(self) -> None:
        """Its run file is whole; it runs no more."""
        if not self._closed:
            self._closed = True
            self._timeline.close()

    # ---- looking --------------------------------------------------------------------------------------------------

    @property
    def program(self) -> Program:
        """The program that runs."""
        return self._resource.program

    @property
    def scan(self) -> int:
        """The scan that runs next; the first is 0."""
        return self._resource.header.scan

    @property
    def time_s(self) -> float:
        """Seconds of virtual time since the start."""
        return self._resource.header.scan * self._resource.program.interval_ns / 1e9

    def read(self, path: str) -> str:
        """A variable or an address as a program writes it: `TRUE`, `42`, `T#5s`."""
        return worth_text(self._resource.program, self._resource.memory, self._find(path))

    def value(self, path: str) -> Worth:
        """The same as a value of Python; arrays are lists, structures dictionaries."""
        return worth(self._resource.program, self._resource.memory, self._find(path))

    def holds(self, condition: str) -> bool:
        """Whether a BOOL expression of ST holds now. `PlcFailure` where it has no value: an index is outside, a divisor is 0."""
        held = self.truth(condition)
        if held is None:
            raise PlcFailure(self.told(f"`{condition}` {NO_VALUE} before scan {self.scan}", condition))
        return held

    def truth(self, condition: str) -> bool | None:
        """Whether it holds now; None where it has no value."""
        return self._resource.engine.truth(self.condition(condition))

    @property
    def errors(self) -> tuple[str, ...]:
        """The errors that are present, as `raise_error` takes them."""
        return tuple(present_texts(self._resource.journal.derived(ACTIVE)))

    def _find(self, path: str) -> Symbol:
        try:
            return resolve(self._resource.program, path.strip())
        except UnknownPath as error:
            raise PlcRefused(_said(error.message, tuple(error.near))) from None

    def condition(self, text: str, unknown: bool = False) -> Condition:
        """A BOOL expression of ST about the program, and whether it holds where it has no value; `PlcRefused`."""
        known = self._project.conditions.get((text, unknown))
        if known is not None:
            return known
        made = compile_condition(self._resource.program, text)
        if not isinstance(made, Condition):
            raise PlcRefused(f"`{text}`: {_said(made.message, made.near)}")
        self._project.conditions[text, unknown] = made = replace(made, unknown=unknown)
        return made

    # ---- changing -------------------------------------------------------------------------------------------------

    def write(self, path: str, value: Value) -> None:
        """Writes once."""
        self.submit(Write(AUTHOR, path, _typed(value)))

    def force(self, path: str, value: Value) -> None:
        """Holds a variable until it is released."""
        self.submit(Force(AUTHOR, path, _typed(value)))

    def release(self, path: str | None = None) -> None:
        """Ends a force, or all."""
        self.submit(Release(AUTHOR, path))

    @contextmanager
    def forced(self, path: str, value: Value) -> Iterator[None]:
        """Forced inside of a `with`."""
        self.force(path, value)
        try:
            yield
        finally:
            self.release(path)

    def raise_error(self, error: str, **details: Value) -> None:
        """Raises an error of the model's catalogue: `raise_error("io-bus-error", rack=1, slot=3)`."""
        told = ",".join(f"{name}={value}" for name, value in details.items())
        reference = parse_reference(self._resource.program.layout.model, f"{error}:{told}" if told else error)
        if isinstance(reference, Refusal):
            raise PlcRefused(_said(reference.message, reference.near))
        self.submit(Generate(AUTHOR, (reference,)))

    def recover(self, *errors: str) -> None:
        """Recovers these errors, or all."""
        self.submit(Recover(AUTHOR, errors or None))

    def mode(self, mode: str) -> None:
        """`PROGRAM`, `MONITOR` or `RUN`."""
        self.submit(SetMode(AUTHOR, mode))

    def restart(self, kind: RestartKind = "warm") -> None:
        """`cold`, `warm` or `power` (off and on)."""
        self.submit(Restart(AUTHOR, kind))

    def submit(self, command: Command) -> None:
        """Enters any command; `PlcRefused`."""
        outcome = self._timeline.submit(command)
        if isinstance(outcome, Refusal):
            raise PlcRefused(_said(outcome.message, outcome.near))

    # ---- running --------------------------------------------------------------------------------------------------

    def run(self, scans: int = 1) -> None:
        """Runs so many scans; they pass without the program while it is stopped. `PlcFailure` when it traps."""
        self.run_to_one((), scans)

    def run_until(self, condition: str, most: int = 10_000) -> int:
        """Runs until a condition holds after a scan: how many scans that took. `PlcFailure` after so many."""
        return self.within_scans(most, condition)

    def within_scans(self, most: int, condition: str) -> int:
        """The condition holds now, or after one of the next `most` scans, where it stays: how many scans that took."""
        begin = self.scan
        if not self.truth(condition) and not self.run_to_one((self.condition(condition),), most):
            last = " In the last one it had no value." if self.truth(condition) is None else ""
            what = f"`{condition}` did not hold within {most} scans, {begin} to {self.scan - 1}"
            raise PlcFailure(self.told(f"{what}.{last}" if last else what, condition))
        return self.scan - begin

    def always(self, scans: int, condition: str) -> None:
        """Runs so many scans, at least 1, after each of which the condition holds.

        `PlcFailure` too where it has no value after one of them, and where the program ran in none of them: in mode PROGRAM, after an
        error that stops it.
        """
        self._watch(scans, condition, "NOT ({})", "did not hold any more")

    def never(self, scans: int, condition: str) -> None:
        """Runs so many scans, at least 1, after none of which the condition holds. `PlcFailure` otherwise as of `always`."""
        self._watch(scans, condition, "{}", "held")

    def _watch(self, scans: int, condition: str, wrong: str, what: str) -> None:
        if scans < 1:
            raise PlcRefused(f"`{condition}` is to be looked at after {scans} scans, so never; give 1 or more.")
        self.condition(condition)  # what is wrong with it is told of what was written
        begin, ran = self.scan, self.ran
        if self.run_to_one((self.condition(wrong.format(condition), unknown=True),), scans):
            last = self.scan - 1
            found = NO_VALUE if self.truth(condition) is None else what
            raise PlcFailure(
                self.told(f"`{condition}` {found} after scan {last}, the {last - begin + 1}. of {scans}", condition)
            )
        if self.ran == ran:
            raise PlcFailure(untested(condition, begin, self.scan))

    def run_to_one(self, conditions: Sequence[Condition], scans: int) -> bool:
        """Runs until one of these holds after a scan, at most so many scans; whether one does."""
        resource = self._resource
        end = resource.header.scan + scans
        resource.waiting.until = tuple(conditions)
        try:
            while resource.header.scan < end:
                before = resource.header.scan
                if not resource.runnable:
                    resource.idle(end - before)
                    if any(map(resource.engine.holds, conditions)):
                        return True
                    continue
                stop = self._timeline.run(end - before)
                self._timeline.note()
                _must_not_trap(resource)
                self.ran += resource.header.scan - before
                if conditions and stop.reason is Reason.CONDITION:
                    return True
        finally:
            resource.waiting.until = ()
        return False

    def told(self, what: str, condition: str) -> str:
        """A sentence about a condition, and what its variables are worth now."""
        return f"{what}. {_values(self._resource, condition)}".rstrip()


def untested(condition: str, begin: int, end: int) -> str:
    """What is said of a condition that was looked at in scans in none of which the program ran."""
    why = "mode PROGRAM, or an error that stops the program"
    return f"`{condition}` was not tested: no program ran in the scans {begin} to {end - 1} ({why})."


def _must_not_trap(resource: Resource) -> None:
    trap = resource.trap
    if trap is not None:
        raise PlcFailure(f"{trap.file}:{trap.line}:{trap.column}: trap {trap.kind} in scan {trap.scan}: {trap.message}")


def _values(resource: Resource, condition: str) -> str:
    """What the names in it are worth now."""
    told: dict[str, str] = {}
    for name in dict.fromkeys(_NAMES.findall(condition)):
        try:
            symbol = resolve(resource.program, name)
        except UnknownPath:
            continue
        told[symbol.path] = worth_text(resource.program, resource.memory, symbol)
    shown = [f"{path} = {text}" for path, text in told.items()][:_SHOWN]
    return f"Now {', '.join(shown)}" if shown else ""


def _typed(value: Value) -> str:
    """As somebody would type it."""
    return str(value).upper() if isinstance(value, bool) else str(value)


def _said(message: str, near: tuple[str, ...]) -> str:
    return f"{message} Near: {', '.join(near)}" if near and "id you mean" not in message else message
