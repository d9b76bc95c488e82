"""What is entered when a run is repeated with one error changed: where the copy of the original ends, and what follows."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from scanbench.faults.arm import Arm, Disarm, Missed
from scanbench.faults.disturb.fire import Firing
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef, covers, error_of, find_error
from scanbench.faults.shapes import Start
from scanbench.history.contract import RerunChange
from scanbench.recording.gaps import gap_between
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.command import Command, Entry, Numbered, Refusal
from scanbench.runtime.trap import Trapped

_ITSELF = ("PLC", "program")
"""Who enters what the PLC finds and the program asks for."""


@dataclass(frozen=True, slots=True)
class Given:
    """A command, and before which scan it is entered."""

    scan: int
    command: Command
    number: int | None = None
    """What it was given in the original: of an armed fault or a disturbance."""
    inside: bool = False
    """It was entered inside of that scan, and is entered before it this time."""


@dataclass(frozen=True, slots=True)
class Planned:
    """The original ends before `scan`, with its first `cut` entries."""

    scan: int
    cut: int
    given: tuple[Given, ...]
    notes: tuple[str, ...]


def planned(reader: RunReader, change: RerunChange) -> Planned:
    """What is to be entered. `Unreadable` says why the change is impossible."""
    _check(reader, change)
    entries = reader.entries
    raised = _raised(reader, change)
    index = _changed(reader, raised)
    entry = entries[index]
    scan, command = entry.scan, _changed_command(entry, entries[raised], change)
    if command is not None:
        scan = _moved_to(entry, entries[raised], change)
    first = min(scan, entry.scan)
    if first < reader.first:
        raise Unreadable(f"scan {first} is not kept: the run begins with scan {reader.first}")
    if first > reader.end:
        raise Unreadable(f"scan {first} has not come yet: the run ends at scan {reader.end}")
    gap = gap_between(reader.recording.gaps, first, reader.end)
    if gap is not None:
        raise Unreadable(f"not all that was entered from scan {first} on is known: {gap}")
    cut = (
        index
        if first == entry.scan and not entry.step
        else sum(each.scan <= first and not (each.scan == first and each.step) for each in entries)
    )
    begin = [] if command is None else [Given(scan, command, number_of(entry))]
    rest, notes = _rest(entries, cut, index, raised, change)
    given = sorted((*begin, *rest), key=lambda each: each.scan)
    return Planned(first, cut, tuple(given), tuple(notes))


def _check(reader: RunReader, change: RerunChange) -> None:
    if change.leave_out and (change.by or change.instead):
        raise Unreadable("the error cannot be left out and be changed too: choose one of them")
    if not (change.leave_out or change.by or change.instead):
        raise Unreadable("nothing would change: say how many scans later, which error instead, or leave it out")
    if change.instead:
        found = find_error(reader.timeline.resource.program.layout.model, change.instead)
        if isinstance(found, Refusal):
            raise Unreadable(found.message, found.near)


def _raised(reader: RunReader, change: RerunChange) -> int:
    """The entry that raised the error."""
    of = [
        (index, each)
        for index, each in enumerate(reader.entries)
        if isinstance(each.command, Generate) and _raises(each.command, change)
    ]
    found = [(index, each) for index, each in of if each.scan == change.scan]
    if not found:
        scans = ", ".join(str(each.scan) for _, each in of[:5])
        where = f"it was before scan {scans}" if of else "it was not raised in this run at all"
        raise Unreadable(f"{change.error} was not raised before scan {change.scan}: {where}")
    index, entry = found[0]
    if isinstance(entry.command, Generate) and entry.command.origin != "simulator":
        by = "the PLC" if entry.command.origin == "plc" else "the program"
        raise Unreadable(
            f"{by} raised {change.error} itself in scan {change.scan}: that is what it does, so change the program, or "
            "what it is given"
        )
    return index


def _changed(reader: RunReader, raised: int) -> int:
    """The entry that changes: for an armed fault the one that armed it."""
    entries, command = reader.entries, reader.entries[raised].command
    assert isinstance(command, Generate)
    index = raised
    if command.arm is not None:
        armed = (
            at for at, each in enumerate(entries[:raised])
            if isinstance(each.command, Arm) and number_of(each) == command.arm
        )  # fmt: skip
        index = next(armed, -1)
    if index < reader.timeline.recording.checkpoints[0].entries:
        raise Unreadable(f"how fault {command.arm} was armed is not kept any more: it was before scan {reader.first}")
    return index


def _changed_command(entry: Entry, raised: Entry, change: RerunChange) -> Command | None:
    """The command as it is to be this time; None: not at all."""
    match entry.command:
        case Arm(wanted=wanted) as command:
            errors = _errors(wanted.errors, change)
            start = wanted.start
            if change.by:
                start = Start("scan", _began(entry, raised, change))
            return replace(command, wanted=replace(wanted, errors=errors, start=start)) if errors else None
        case Generate(errors=refs) as command:
            errors = _errors(refs, change)
            return replace(command, errors=errors) if errors else None
    raise AssertionError(entry)


def _errors(refs: Sequence[ErrorRef], change: RerunChange) -> tuple[ErrorRef, ...]:
    if change.leave_out:
        return tuple(each for each in refs if not covers(change.error, each))
    if not change.instead:
        return tuple(refs)
    return tuple(ErrorRef(change.instead) if covers(change.error, each) else each for each in refs)


def _began(entry: Entry, raised: Entry, change: RerunChange) -> int:
    """Before which scan an armed fault is to begin, so that this error comes so much earlier or later."""
    command = entry.command
    assert isinstance(command, Arm)
    index = [covers(change.error, each) for each in command.wanted.errors].index(True)
    began = raised.scan - index * command.wanted.gap
    step = raised.command.step if isinstance(raised.command, Generate) else 0
    if step and command.wanted.start.kind in ("now", "scan"):
        began = entry.scan if command.wanted.start.kind == "now" else command.wanted.start.scan or entry.scan
    elif step:
        raise Unreadable(
            "it came back as an armed fault that waited for a condition or a line: move the first time that it came, or arm "
            "it again"
        )
    return began + change.by


def _moved_to(entry: Entry, raised: Entry, change: RerunChange) -> int:
    """Before which scan the command is entered."""
    if not isinstance(entry.command, Arm):
        return entry.scan + change.by
    return min(entry.scan, _began(entry, raised, change)) if change.by else entry.scan


def _rest(
    entries: Sequence[Entry], cut: int, index: int, raised: int, change: RerunChange
) -> tuple[list[Given], list[str]]:  # fmt: skip
    """Everything after the cut that somebody entered, but for what is changed itself."""
    given, notes, goes_with = [], [], True
    for at in range(cut, len(entries)):
        entry, command = entries[at], entries[at].command
        if at == index or comes_by_itself(command):
            continue
        scan = entry.scan
        if at > raised and isinstance(command, Generate) and _raises(command, change):
            goes_with = False  # it was raised again: what follows is about that
        if at > raised and goes_with and isinstance(command, Recover) and _recovers(command, change):
            moved = _recovery(command, change)
            if moved is None:
                continue
            command, scan = moved, scan + change.by * (len(command.ids or ()) + len(command.numbers) == 1)
        if entry.step:
            notes.append(
                f"{type(command).__name__} by {command.author} was entered inside of scan {entry.scan}, and is entered "
                "before it this time"
            )
        given.append(Given(scan, command, number_of(entry)))
    return given, notes


def _recovery(command: Recover, change: RerunChange) -> Recover | None:
    """The recovery of the error, of what is raised this time."""
    ids, numbers = tuple(command.ids or ()), command.numbers
    if change.leave_out or change.instead:
        ids = tuple(each for each in ids if each != error_of(change.error))
        numbers = tuple(each for each in numbers if not covers(change.error, each))
    if change.instead:
        ids = (*ids, change.instead)
    return replace(command, ids=ids, numbers=numbers) if ids or numbers else None


def _recovers(command: Recover, change: RerunChange) -> bool:
    return error_of(change.error) in (command.ids or ()) or any(covers(change.error, each) for each in command.numbers)


def comes_by_itself(command: Command) -> bool:
    """Whether nobody entered this: the PLC finds it, the program asks for it, or it is a step of what is under way."""
    match command:
        case Trapped() | Missed() | Firing():
            return True
        case Generate(arm=arm, origin=origin):
            return arm is not None or origin != "simulator"
        case Recover(arm=arm, author=author):
            return arm is not None or author in _ITSELF
        case Disarm(why=why):
            return bool(why)
    return False


def number_of(entry: Entry) -> int | None:
    """What an armed fault or a disturbance was given as its number."""
    effect = entry.plan.effect
    return effect.number if isinstance(effect, Numbered) else None


def _raises(command: Generate, change: RerunChange) -> bool:
    return any(covers(change.error, each) for each in command.errors)
