"""Generate and Recover: details, error code, code word, flag and log record, all in one seam.

The code word shows the most serious error present, by the model's priority; it falls back to the next one when that is
recovered, and to 0 when none is left. A fatal error stops the program and switches the outputs off; where memory is held
(hold bit, FALS) that of the outputs keeps its values, as on the device.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.faults.details import Chosen, choose
from scanbench.faults.errorlog import log_patches, time_patches
from scanbench.faults.reference import ErrorRef, find_error
from scanbench.faults.switch import switch
from scanbench.faults.trap_errors import error_of
from scanbench.program.layout import Layout
from scanbench.program.sites import TrapKind
from scanbench.runtime.command import Category, Command, Entry, Patch, Plan, Refusal, View
from scanbench.runtime.header import Halt, Mode
from scanbench.runtime.journal import Fold
from scanbench.runtime.modes import held, outputs_off, volatile_cleared
from scanbench.runtime.trap import TRAPPED

Origin = Literal["simulator", "plc", "program"]
"""Who raised an error: somebody at the error simulator, the PLC that found it itself, an instruction of the program."""


@dataclass(frozen=True, slots=True)
class Raised:
    """An error with its details, as somebody raised it."""

    ref: ErrorRef
    by: str
    scan: int
    origin: Origin


@dataclass(frozen=True, slots=True)
class Active:
    """An error that is present."""

    raised: tuple[Raised, ...]
    """One; several where the program raised it too, with other numbers or details (FAL 1 and FAL 2). The latest last."""

    @property
    def refs(self) -> tuple[ErrorRef, ...]:
        """With all details that it is present with."""
        return tuple(each.ref for each in self.raised)

    @property
    def by(self) -> str:
        """Who raised it last."""
        return self.raised[-1].by

    @property
    def scan(self) -> int:
        """When it was raised last."""
        return self.raised[-1].scan

    @property
    def origin(self) -> Origin:
        """Whence it came last."""
        return self.raised[-1].origin


@dataclass(frozen=True, slots=True)
class Generate(Command):
    """Raises errors, all or none of them.

    What somebody raises at the simulator must not be present, unless `again` says that it is raised again, with these
    details. An error that the PLC finds takes new details; several numbers that the program raises are present together, as on the device.
    """

    category: ClassVar[Category] = "error"

    errors: tuple[ErrorRef, ...]
    origin: Origin = "simulator"
    again: bool = False
    arm: int | None = None
    """The armed fault that this is a step of, and which."""
    step: int = 0

    def plan(self, view: View) -> Plan | Refusal:
        """Everything that the device would set."""
        present = view.derived(ACTIVE)
        chosen = _choose_all(view, self.errors)
        if isinstance(chosen, Refusal):
            return chosen
        others = present_choices(view, present)
        changed: list[Chosen] = []
        for one in chosen:
            before = others.get(one.error.id, [])
            if before and not self._takes(one, before):
                return _already(present[one.error.id].by, before)
            if self.origin != "program":
                changed += others.pop(one.error.id, [])
        patches = list(switch(view, off=changed, on=chosen, others=_flat(others)))
        patches += log_patches(view, chosen)
        patches += time_patches(view, chosen)
        fatal = [one for one in chosen if one.error.severity == "fatal"]
        if fatal:
            # Stopping comes first: clearing memory must not take back what the error sets.
            patches[:0] = _stop(view, fatal)
        stops = f"; the program is stopped{_what_is_held(view, fatal)}" if fatal else ""
        return Plan(tuple(patches), "generated " + ", ".join(map(describe, chosen)) + stops)

    def _takes(self, one: Chosen, before: Sequence[Chosen]) -> bool:
        """Whether it may be raised although it is present."""
        if self.origin == "simulator":
            return self.again
        return all(each.details != one.details for each in before)


@dataclass(frozen=True, slots=True)
class Recover(Command):
    """Takes errors back; None is all that are present."""

    category: ClassVar[Category] = "recover"

    ids: tuple[str, ...] | None
    arm: int | None = None
    """The armed fault that this is a step of, and which."""
    step: int = 0
    numbers: tuple[ErrorRef, ...] = ()
    """Of errors that are present with several numbers and stay so: only these, written as they are in `ACTIVE`."""

    def plan(self, view: View) -> Plan | Refusal:
        """Details off, flag off, code word recomputed."""
        present = view.derived(ACTIVE)
        for id in self.ids or ():
            entry = find_error(view.model, id)
            if isinstance(entry, Refusal):
                return entry
            if id not in present:
                return Refusal(f"{id} is not generated: there is nothing to recover", tuple(present))
        others = present_choices(view, present)
        ids = tuple(present) if self.ids is None else tuple(dict.fromkeys(self.ids))
        if not ids and not self.numbers:
            return Plan((), "no error is generated")
        off = [one for id in ids for one in others.pop(id)]
        named = list(ids)
        for ref in self.numbers:
            one = _choose_all(view, (ref,))
            if isinstance(one, Refusal) or ref.id not in others or one[0] not in others[ref.id]:
                return Refusal(
                    f"{ref.id} is not generated with this number: there is nothing to recover", tuple(present)
                )
            others[ref.id].remove(one[0])
            off += one
            named.append(f"{ref.id} ({one[0]})")
        patches = list(switch(view, off=off, on=[], others=_flat(others)))
        patches += time_patches(view, (), nothing_left=not _flat(others))
        message = "recovered " + ", ".join(named)
        halt = _halt_after(view, off, _flat(others))
        if halt != view.header.halt:
            patches.append(Patch.whole(Layout.FATAL, bytes((halt,))))
            if not halt:
                patches.append(Patch.whole(Layout.MODE, bytes((Mode.PROGRAM,))))
                message += "; the program stays stopped: change to MONITOR or RUN, or restart"
        if halt and _any_fatal(off):
            message += f"; the program stays stopped: {_why_stopped(view, halt, _flat(others))}"
        return Plan(tuple(patches), message)


def present_after(present: Mapping[str, Active], command: Command, scan: int) -> Mapping[str, Active]:
    """The errors that are present after a command; the same mapping where it does not touch them."""
    if isinstance(command, Generate):
        changed = dict(present)
        for ref in command.errors:
            before = changed.pop(ref.id, None)
            stay = before.raised if before is not None and command.origin == "program" else ()
            changed[ref.id] = Active((*stay, Raised(ref, command.author, scan, command.origin)))
        return changed
    if isinstance(command, Recover):
        gone = present if command.ids is None else command.ids
        left = {id: error for id, error in present.items() if id not in gone}
        for ref in command.numbers:
            if ref.id in left:
                left[ref.id] = Active(tuple(each for each in left[ref.id].raised if each.ref != ref))
        return left
    return present


def _step(present: Mapping[str, Active], entry: Entry) -> Mapping[str, Active]:
    return {} if entry.plan.starts_fresh else present_after(present, entry.command, entry.scan)


ACTIVE: Fold[Mapping[str, Active]] = Fold({}, _step)
"""The errors that are present, by id, the oldest first: the journal is the only state there is, so a replay knows it too."""


def present_choices(view: View, present: Mapping[str, Active]) -> dict[str, list[Chosen]]:
    """The errors that are present with all their details, by id."""
    found: dict[str, list[Chosen]] = {}
    for id, error in present.items():
        for ref in error.refs:
            chosen = _choose_all(view, (ref,))
            if isinstance(chosen, Refusal):
                raise ValueError(f"the journal holds an error that the model does not take: {chosen.message}")
            found.setdefault(id, []).extend(chosen)
    return found


def describe(chosen: Chosen) -> str:
    """An error with code and details, for people."""
    details = f" ({chosen})" if chosen.details else ""
    return f"{chosen.error.id}{details}, code {chosen.code_text}"


def _choose_all(view: View, refs: Iterable[ErrorRef]) -> list[Chosen] | Refusal:
    all_: list[Chosen] = []
    for ref in refs:
        entry = find_error(view.model, ref.id)
        if isinstance(entry, Refusal):
            return entry
        chosen = choose(entry, dict(ref.details), view.program.layout)
        if isinstance(chosen, Refusal):
            return chosen
        if any(entry is other.error for other in all_):
            return Refusal(f"{entry.id} is there twice: one error can be present only once")
        all_.append(chosen)
    return all_


def _already(by: str, before: Sequence[Chosen]) -> Refusal:
    error, shown = before[-1].error, before[-1]
    details = f" ({shown})" if shown.details else ""
    other = ", or generate it again to change its details" if shown.details else ""
    return Refusal(f"{error.id}: already generated by {by}{details}. Recover it first{other}", (error.id,))


def _flat(choices: Mapping[str, list[Chosen]]) -> list[Chosen]:
    return [one for several in choices.values() for one in several]


def _stop(view: View, fatal: list[Chosen]) -> list[Patch]:
    """Outputs go off in any case; their memory is held where the rest is, so that it is the state that says so."""
    patches = [Patch.whole(Layout.FATAL, bytes((view.header.halt | Halt.FATAL_ERROR,)))]
    if not _keep_memory(fatal):
        patches += (*volatile_cleared(view), *outputs_off(view))
    return patches


def _keep_memory(fatal: list[Chosen]) -> bool:
    return all(one.error.keeps_memory for one in fatal)


def _what_is_held(view: View, fatal: list[Chosen]) -> str:
    if not held(view) and not _keep_memory(fatal):
        return ""
    return ", outputs off; memory is held, that of the outputs too"


def _halt_after(view: View, off: Sequence[Chosen], left: Sequence[Chosen]) -> Halt:
    """What still keeps the program stopped. A trap ends with its error, whoever raised that again meanwhile."""
    halt = view.header.halt
    last = _any_fatal(off) and not _any_fatal(left)
    if last:
        halt &= ~Halt.FATAL_ERROR
    info = view.derived(TRAPPED)
    if halt & Halt.TRAP and info is not None:
        error = error_of(view.model, info)
        by_instruction = info.kind == TrapKind.FATAL
        if (last and by_instruction) or any(one.error is error for one in off):
            halt &= ~Halt.TRAP
    return halt


def _any_fatal(errors: Iterable[Chosen]) -> bool:
    return any(one.error.severity == "fatal" for one in errors)


def _why_stopped(view: View, halt: Halt, left: Iterable[Chosen]) -> str:
    if halt & Halt.FATAL_ERROR:
        ids = dict.fromkeys(one.error.id for one in left if one.error.severity == "fatal")
        return f"{', '.join(ids)} {'is' if len(ids) == 1 else 'are'} still present"
    return f"{view.derived(TRAPPED)}. Change to PROGRAM, or restart"
