"""What the journal has after an error: what came from outside and is given to both runs, and how long they can be compared."""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace

from scanbench.faults.inject import Generate, Recover, takes_back
from scanbench.faults.reaction.steps import Given, Point, advance, reenter, resource_at
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.command import Command, Entry, Swapped
from scanbench.runtime.programs import Programs
from scanbench.runtime.trap import Trapped


@dataclass(frozen=True, slots=True)
class Following:
    """What came after an error from outside, and how long it can be compared."""

    given: tuple[Given, ...]
    window: int
    note: str


def following_of(
    point: Point, generate: Entry, following: Sequence[Entry], window: int, programs: Programs
) -> Following:
    """Runs it once more as it was: what is entered again by itself came from the PLC or its program, the rest from outside."""
    resource = resource_at(point, programs)
    reenter(resource, generate)
    begin = resource.header.scan
    end, note = begin + window, ""
    left: list[Entry] = []
    for entry in following:
        if entry.scan >= end or isinstance(entry.command, Trapped):  # after a trap nothing is compared
            break
        if entry.plan.cuts:
            end = entry.scan
            note = "the program was changed" if isinstance(entry.plan.effect, Swapped) else "the program was restarted"
            break
        left.append(entry)
    given: list[Given] = []
    while resource.header.scan < end and resource.trap is None:
        while left and left[0].scan <= resource.header.scan:
            given.append(Given(left[0].scan, left.pop(0)))
            reenter(resource, given[-1].entry)
        entered = len(resource.journal)
        advance(resource)
        for made in resource.journal[entered:]:
            same = [each for each in left if each.scan <= resource.header.scan and each.command == made.command]
            if same:
                left.remove(same[0])
    return Following(tuple(given), end - begin, note)


def commands_without(
    generate: Entry, given: Iterable[Given], errors: Collection[ErrorRef]
) -> list[tuple[int, Command | Entry]]:
    """The commands that the run without these errors gets. What is left of one inside of a scan comes after that."""
    found: list[tuple[int, Command | Entry]] = []
    for scan, entry in ((generate.scan, generate), *given):
        left = spared(entry.command, errors)
        if left is not None and entry.step:
            found.append((scan, entry) if left is entry.command else (scan + 1, left))
        elif left is not None:
            found.append((scan, left))
    return found


def spared(command: Command, errors: Collection[ErrorRef]) -> Command | None:
    """What is left of a command of a journal when it is not to touch these errors."""
    if isinstance(command, Generate):
        left = tuple(each for each in command.errors if each not in errors and not _moved(command, each, errors))
        return replace(command, errors=left) if left else None
    if isinstance(command, Recover) and command.ids is not None:
        ids = tuple(id for id in command.ids if all(each.id != id for each in errors))
        numbers = tuple(each for each in command.numbers if each not in errors)
        return replace(command, ids=ids, numbers=numbers) if ids or numbers else None
    return command


def _moved(command: Generate, ref: ErrorRef, errors: Collection[ErrorRef]) -> bool:
    """Whether raising this only changes what one of these errors says."""
    return any(each.id == ref.id and each in errors for each in command.replaces or ())


def is_about(command: Command, error: ErrorRef) -> bool:
    """Whether a command of a journal raises or recovers this error."""
    if isinstance(command, Generate):
        return error in command.errors or any(_moved(command, each, (error,)) for each in command.errors)
    return isinstance(command, Recover) and takes_back(command, error)
