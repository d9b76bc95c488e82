"""Generate and Recover: details, error code, code word, flag and log record, all in one seam.

The code word shows the most serious error present, by the model's priority; it falls back to the next one when that is
recovered, and to 0 when none is left. A fatal error stops the program and switches the outputs off; where memory is held
(hold bit, FALS) that of the outputs keeps its values, as on the device.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

from scanbench.faults.details import Chosen, choose
from scanbench.faults.errorlog import log_patches, time_patches
from scanbench.faults.present import NOTHING, Active, Instances, Origin, Present, Raised, Way, instances_in
from scanbench.faults.reference import ErrorRef, find_error, parse_reference
from scanbench.faults.standby import is_repaired, restored, taken_over, takes_over
from scanbench.faults.switch import switch
from scanbench.faults.trap_errors import error_of
from scanbench.plcmodel.hardware import HARDWARE_FILE, can_be_absent, is_fitted
from scanbench.plcmodel.model import Model
from scanbench.program.layout import Layout
from scanbench.program.sites import TrapKind
from scanbench.runtime.command import Category, Command, Entry, Patch, Plan, Refusal, View
from scanbench.runtime.header import Halt, Mode
from scanbench.runtime.journal import Fold
from scanbench.runtime.modes import held, outputs_off, volatile_cleared
from scanbench.runtime.trap import TRAPPED

Choices = Mapping[str, list[Chosen]]
"""The errors that are present with all their details, by id."""


@dataclass(frozen=True, slots=True)
class Generate(Command):
    """Raises errors, all or none of them.

    An instance that somebody raises at the simulator must not be present, unless `again` says that it is raised again, with
    these details. Of a kind that the device has a place for one of, none must be. An error that the PLC finds takes new
    details; what the program raises is present beside what was there, as on the device.
    """

    category: ClassVar[Category] = "error"

    errors: tuple[ErrorRef, ...]
    origin: Origin = "simulator"
    again: bool = False
    arm: int | None = None
    """The armed fault that this is a step of, and which."""
    step: int = 0
    replaces: tuple[ErrorRef, ...] | None = None
    """What was present and gives way, as it is in `ACTIVE`; `settled` says it. None, of a run of before: the whole kind, unless
    the program raised it."""
    anyway: bool = False
    """Although it is not fitted: of what the device reports although it is not there."""
    standby: bool = False
    """The standby CPU Unit takes over, so they do not stop the program; `settled` says it."""

    def settled(self, view: View) -> "Generate":
        """With what tells its instances apart, and with what gives way."""
        chosen = choose_all(view, self.errors)
        if isinstance(chosen, Refusal):
            return self
        present = view.derived(ACTIVE)
        known = present_choices(view, present)
        gone = (self._gives_way(one, present, known) for one in chosen)
        refs = tuple(raised.ref for each in gone for raised, _ in each)
        fatal = _fatal(chosen)
        stops = self._stops(fatal, present, known)
        standby = self.origin == "simulator" and bool(fatal) and (not stops or takes_over(view, stops))
        return replace(self, errors=tuple(map(settled_ref, self.errors, chosen)), replaces=refs, standby=standby)

    def plan(self, view: View) -> Plan | Refusal:
        """Everything that the device would set."""
        present = view.derived(ACTIVE)
        chosen = choose_all(view, self.errors)
        if isinstance(chosen, Refusal):
            return chosen
        known = present_choices(view, present)
        others = {id: list(several) for id, several in known.items()}
        changed: list[Chosen] = []
        for one in chosen:
            by_hand = self.origin == "simulator" and self.arm is None
            if by_hand and (unfit := unfitted(view.model, one, self.anyway)) is not None:
                return unfit
            before = self._in_the_way(one, present, known)
            if before:
                return _already(one, *before[-1])
            for _, each in self._gives_way(one, present, known):
                others[one.error.id].remove(each)
                changed.append(each)
        patches = list(switch(view, off=changed, on=chosen, others=_flat(others)))
        patches += log_patches(view, chosen)
        patches += time_patches(view, chosen)
        fatal, follows = self._stops(_fatal(chosen), present, known), ""
        if self.origin == "simulator" and takes_over(view, fatal):
            more, said = taken_over(view, fatal)
            patches += more
            follows = f"; {said}"
        elif fatal:
            # Stopping comes first: clearing memory must not take back what the error sets.
            patches[:0] = _stop(view, fatal)
            follows = f"; the program is stopped{_what_is_held(view, fatal)}"
        absent = [one for one in chosen if not is_fitted(view.model.fitted, one.error, one.instance.details)]
        although = f"; {HARDWARE_FILE} does not have {', '.join(str(one.instance) for one in absent)}" if absent else ""
        return Plan(tuple(patches), "generated " + ", ".join(map(describe, chosen)) + although + follows)

    def _in_the_way(self, one: Chosen, present: Mapping[str, Active], others: Choices) -> list[tuple[Raised, Chosen]]:
        """What is present so that it cannot be raised."""
        if self.origin == "simulator":
            return [] if self.again else _rivals(one, present, others)
        return [each for each in _of_kind(one, present, others) if each[1].details == one.details]

    def _stops(self, fatal: Iterable[Chosen], present: Mapping[str, Active], others: Choices) -> list[Chosen]:
        """Of fatal errors, those that would stop the program: an error that the standby took over for may change its details."""
        return [one for one in fatal if not any(raised.standby for raised, _ in self._gives_way(one, present, others))]

    def _gives_way(self, one: Chosen, present: Mapping[str, Active], others: Choices) -> list[tuple[Raised, Chosen]]:
        """What is present and is so no more when it is raised."""
        return [] if self.origin == "program" else _rivals(one, present, others)


@dataclass(frozen=True, slots=True)
class Recover(Command):
    """Takes errors back; None is all that are present. Of a kind all instances, or with details (`io-bus-error:rack=1`) those that
    have them."""

    category: ClassVar[Category] = "recover"

    ids: tuple[str, ...] | None
    arm: int | None = None
    """The armed fault that this is a step of, and which."""
    step: int = 0
    numbers: tuple[ErrorRef, ...] = ()
    """Single instances, written as they are in `ACTIVE`."""
    way: Way = "simulator"
    """Who does it, and so whether the cause goes, too."""

    def settled(self, view: View) -> "Recover":
        """With its instances as they are present."""
        meant = _meant(view, self.ids or ())
        if isinstance(meant, Refusal) or self.ids is None:
            return self
        present = view.derived(ACTIVE)
        single = tuple(id for id in meant[0] if len(present[id].raised) == 1)
        whole = (each.ref for id in meant[0] if id not in single for each in present[id].raised)
        numbers = dict.fromkeys((*self.numbers, *whole, *meant[1]))
        return replace(self, ids=single, numbers=tuple(each for each in numbers if each.id not in single))

    def plan(self, view: View) -> Plan | Refusal:
        """Details off, flag off, code word recomputed."""
        present = view.derived(ACTIVE)
        meant = _meant(view, self.ids or ())
        if isinstance(meant, Refusal):
            return meant
        settled = self.settled(view)
        others = present_choices(view, present)
        ids = tuple(present) if settled.ids is None else settled.ids
        if not ids and not settled.numbers:
            back, said = restored(view) if self.ids is None and self.way == "simulator" else ([], "")
            return Plan(tuple(back), said or "no error is generated")
        survived = _survived(present, others)
        off = [one for id in ids for one in others.pop(id)]
        named = list(ids)
        for ref in settled.numbers:
            one = choose_all(view, (ref,))
            if isinstance(one, Refusal) or ref.id not in others or one[0] not in others[ref.id]:
                return Refusal(
                    f"{ref.id} is not generated with this number: there is nothing to recover", present_texts(present)
                )
            others[ref.id].remove(one[0])
            off += one
            named.append(f"{ref.id} ({one[0]})")
        patches = list(switch(view, off=off, on=[], others=_flat(others)))
        patches += time_patches(view, (), nothing_left=not _flat(others))
        message = _what_went(self.way, ", ".join(named))
        left = _flat(others)
        halt = _halt_after(view, off, left, survived)
        if halt != view.header.halt:
            patches.append(Patch.whole(Layout.FATAL, bytes((halt,))))
            if not halt:
                patches.append(Patch.whole(Layout.MODE, bytes((Mode.PROGRAM,))))
                message += "; the program stays stopped: change to MONITOR or RUN, or restart"
        if halt and _any_fatal(_without(off, survived)):
            message += f"; the program stays stopped: {_why_stopped(view, halt, _without(left, survived))}"
        if self.way == "simulator" and (self.ids is None or is_repaired(view.model, off, left)):
            back, said = restored(view)
            patches += back
            message += f"; {said}" if said else ""
        return Plan(tuple(patches), message)


def _what_went(way: Way, names: str) -> str:
    if way == "tool":
        return f"cleared by the tool: {names}"
    return f"cleared by the program: {names}" if way == "program" else f"recovered {names}"


def present_after(present: Mapping[str, Active], command: Command, scan: int) -> Mapping[str, Active]:
    """The errors that are present after a command; the very same where it does not touch them."""
    before = instances_in(present)
    after = _after(before, command, scan)
    return present if after is before else Present(after)


def takes_back(command: Recover, ref: ErrorRef) -> bool:
    """Whether a command that is in a journal recovers this error, written as it is in `ACTIVE`."""
    return command.ids is None or ref.id in command.ids or ref in command.numbers


def _after(instances: Instances, command: Command, scan: int) -> Instances:
    if isinstance(command, Generate):
        changed = {text: raised for text, raised in instances.items() if not _replaced(raised.ref, command)}
        for ref in command.errors:
            changed.pop(str(ref), None)
            changed[str(ref)] = Raised(ref, command.author, scan, command.origin, command.standby)
        return changed
    if isinstance(command, Recover):
        return {text: raised for text, raised in instances.items() if not takes_back(command, raised.ref)}
    return instances


def _replaced(ref: ErrorRef, command: Generate) -> bool:
    if command.replaces is None:
        return command.origin != "program" and any(ref.id == each.id for each in command.errors)
    return ref in command.replaces


def _step(instances: Instances, entry: Entry) -> Instances:
    return {} if entry.plan.starts_fresh else _after(instances, entry.command, entry.scan)


def _kinds(present: Mapping[str, Active], entry: Entry) -> Mapping[str, Active]:
    before = instances_in(present)
    after = _step(before, entry)
    return present if after is before else Present(after)


def _raised(known: Mapping[str, int], entry: Entry) -> Mapping[str, int]:
    command = entry.command
    return {**known, **{str(ref): entry.scan for ref in command.errors}} if isinstance(command, Generate) else known


RAISED: Fold[Mapping[str, int]] = Fold({}, _raised)
"""Before which scan each instance was raised last, by its text, whether it is still present or not: whoever sees it may have
something to say of it later. Not for good: a run file that drops its beginning keeps no error for it that is gone."""
INSTANCES: Fold[Instances] = Fold({}, _step)
"""The instances that are present, by their text, the oldest first: the journal is the only state there is, so a replay knows it
too."""
ACTIVE: Fold[Mapping[str, Active]] = Fold(NOTHING, _kinds)
"""The same by id."""


def present_texts(present: Mapping[str, Active]) -> tuple[str, ...]:
    """The instances that are present, in the notation in which they are recovered."""
    return tuple(str(raised.ref) for active in present.values() for raised in active.raised)


def settled_ref(ref: ErrorRef, chosen: Chosen) -> ErrorRef:
    """The error with the details that were given and those that tell it apart: what names it without its model."""
    wanted = {*(name for name, _ in ref.details), *(name for name, _ in chosen.instance.details)}
    return ErrorRef(ref.id, tuple(each for each in chosen.details if each[0] in wanted))


def present_choices(view: View, present: Mapping[str, Active]) -> dict[str, list[Chosen]]:
    """The errors that are present with all their details, by id; in the order of `ACTIVE`."""
    found: dict[str, list[Chosen]] = {}
    for id, error in present.items():
        for ref in error.refs:
            chosen = choose_all(view, (ref,))
            if isinstance(chosen, Refusal):
                raise ValueError(f"the journal holds an error that the model does not take: {chosen.message}")
            found.setdefault(id, []).extend(chosen)
    return found


def in_the_way(view: View, ref: ErrorRef) -> ErrorRef | None:
    """What is present so that this error cannot be raised beside it."""
    chosen, present = choose_all(view, (ref,)), view.derived(ACTIVE)
    rivals = [] if isinstance(chosen, Refusal) else _rivals(chosen[0], present, present_choices(view, present))
    return rivals[-1][0].ref if rivals else None


def describe(chosen: Chosen) -> str:
    """An error with code and details, for people."""
    details = f" ({chosen})" if chosen.details else ""
    if not chosen.error.coded:
        return f"{chosen.error.id}{details}, no code"
    return f"{chosen.error.id}{details}, code {chosen.code_text}"


def choose_all(view: View, refs: Iterable[ErrorRef]) -> list[Chosen] | Refusal:
    """These errors with their details, in the same order; a refusal where one is unknown, or two exclude each other."""
    all_: list[Chosen] = []
    for ref in refs:
        entry = find_error(view.model, ref.id)
        if isinstance(entry, Refusal):
            return entry
        chosen = choose(entry, dict(ref.details), view.program.layout)
        if isinstance(chosen, Refusal):
            return chosen
        if any(_clash(chosen, other) for other in all_):
            return Refusal(f"{entry.id} is there twice: one error can be present only once")
        all_.append(chosen)
    return all_


def _clash(one: Chosen, other: Chosen) -> bool:
    """Whether the device cannot have both: they are one instance, or of a kind that it has a place for one of."""
    return one.error is other.error and (not one.error.several or one.instance == other.instance)


def unfitted(model: Model, one: Chosen, anyway: bool = False) -> Refusal | None:
    """Why an error is not raised when the hardware that it is of is not there; None where it is, or nobody says."""
    if is_fitted(model.fitted, one.error, one.instance.details) or (anyway and can_be_absent(one.error)):
        return None
    where = f"{one.instance} is not fitted: {HARDWARE_FILE} does not have it"
    if can_be_absent(one.error):
        return Refusal(
            f"{where}. Add it there; at the error simulator, and by REST with anyway, it can be raised all the same, as the device can report it"
        )
    return Refusal(f"{where}. Add it there, and build: the device reports no such error of what is not there")


def _of_kind(one: Chosen, present: Mapping[str, Active], others: Choices) -> list[tuple[Raised, Chosen]]:
    """What is present of the same kind."""
    active = present.get(one.error.id)
    return [] if active is None else list(zip(active.raised, others[one.error.id], strict=True))


def _rivals(one: Chosen, present: Mapping[str, Active], others: Choices) -> list[tuple[Raised, Chosen]]:
    """What is present and cannot be so together with it."""
    return [each for each in _of_kind(one, present, others) if _clash(one, each[1])]


def _meant(view: View, texts: Iterable[str]) -> tuple[tuple[str, ...], tuple[ErrorRef, ...]] | Refusal:
    """What is to be recovered: kinds, of which all instances go, and single instances as they are in `ACTIVE`."""
    present = view.derived(ACTIVE)
    ids: dict[str, None] = {}
    refs: dict[ErrorRef, None] = {}
    for text in texts:
        ref = parse_reference(view.model, text)
        if isinstance(ref, Refusal):
            return ref
        if ref.id not in present:
            return Refusal(f"{text} is not generated: there is nothing to recover", present_texts(present))
        if not ref.details:
            ids[ref.id] = None
            continue
        chosen = choose_all(view, (ref,))
        if isinstance(chosen, Refusal):
            return chosen
        given = {name: value for name, value in chosen[0].details if name in dict(ref.details)}
        several = present_choices(view, {ref.id: present[ref.id]})[ref.id]
        pairs = zip(present[ref.id].raised, several, strict=True)
        found = [raised.ref for raised, one in pairs if given.items() <= dict(one.details).items()]
        if not found:
            return Refusal(f"{text} is not generated: there is nothing to recover", present_texts(present))
        refs.update(dict.fromkeys(found))
    return tuple(ids), tuple(refs)


def _already(one: Chosen, raised: Raised, before: Chosen) -> Refusal:
    error = before.error
    details = f" ({before})" if before.details else ""
    only = (
        ""
        if one.same_instance(before)
        else f"; {error.id} can be present only once, as the device has one place for it"
    )
    other = ", or generate it again to change its details" if before.details else ""
    return Refusal(
        f"{error.id}: already generated by {raised.by}{details}{only}. Recover it first{other}", (str(raised.ref),)
    )


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


def _halt_after(view: View, off: Sequence[Chosen], left: Sequence[Chosen], survived: Sequence[Chosen]) -> Halt:
    """What still keeps the program stopped. A trap ends with its error, whoever raised that again meanwhile."""
    halt = view.header.halt
    last = _any_fatal(_without(off, survived)) and not _any_fatal(_without(left, survived))
    if last:
        halt &= ~Halt.FATAL_ERROR
    info = view.derived(TRAPPED)
    if halt & Halt.TRAP and info is not None:
        error = error_of(view.model, info)
        by_instruction = info.kind == TrapKind.FATAL
        if (last and by_instruction) or any(one.error is error for one in off):
            halt &= ~Halt.TRAP
    return halt


def _fatal(errors: Iterable[Chosen]) -> list[Chosen]:
    return [one for one in errors if one.error.severity == "fatal"]


def _survived(present: Mapping[str, Active], choices: Choices) -> list[Chosen]:
    """The errors that are present, and do not stop the program as the standby took over."""
    return [
        one
        for id, several in choices.items()
        for raised, one in zip(present[id].raised, several, strict=True)
        if raised.standby and one.error.severity == "fatal"
    ]


def _without(errors: Iterable[Chosen], others: Sequence[Chosen]) -> list[Chosen]:
    return [one for one in errors if one not in others]


def _any_fatal(errors: Iterable[Chosen]) -> bool:
    return any(one.error.severity == "fatal" for one in errors)


def _why_stopped(view: View, halt: Halt, left: Iterable[Chosen]) -> str:
    if halt & Halt.FATAL_ERROR:
        ids = dict.fromkeys(one.error.id for one in left if one.error.severity == "fatal")
        return f"{', '.join(ids)} {'is' if len(ids) == 1 else 'are'} still present"
    return f"{view.derived(TRAPPED)}. Change to PROGRAM, or restart"
