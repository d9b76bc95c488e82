"""The steps of a run that is compared: where it begins, what it is given, a scan."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from scanbench.engines.observe import Observer
from scanbench.faults.detect import Detection
from scanbench.faults.reaction.error_memory import Words, words_of
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Programs
from scanbench.runtime.resource import Resource


@dataclass(frozen=True, slots=True)
class Point:
    """A PLC before a scan, where a comparison begins."""

    version: int
    state: bytes
    journal: Journal


class Given(NamedTuple):
    """A command from outside that both runs get, and the scan before which it was entered."""

    scan: int
    entry: Entry


def resource_at(point: Point, programs: Programs) -> Resource:
    """A PLC at the point. There is only one at a time, as the memory of a program is one."""
    loaded = programs.get(point.version)
    resource = Resource(loaded, programs=programs, detect=Detection())
    resource.restore(loaded, point.state, point.journal.prefix(len(point.journal)))
    resource.lenient = True
    return resource


def observer_of(programs: Programs, point: Point) -> Observer:
    """What notes the statements that run at the point."""
    observer = programs.get(point.version).observer
    assert observer is not None, "what is compared runs on observed code"
    return observer


def reenter(resource: Resource, entry: Entry) -> None:
    """As it was recorded: in the seam, or inside of the scan that is next."""
    if entry.step:
        resource.await_step(entry)
    else:
        resource.reenter(entry)


def give(resource: Resource, command: Command | Entry) -> None:
    """A command, or what came inside of a scan, before the next one."""
    if isinstance(command, Entry):
        resource.await_step(command)
    else:
        resource.submit(command)


def enter(resource: Resource, waiting: list[Given]) -> None:
    """What was entered before the scan that is next, each once."""
    while waiting and waiting[0].scan <= resource.header.scan:
        reenter(resource, waiting.pop(0).entry)


def advance(resource: Resource) -> None:
    """One scan, or the time of one where no program runs."""
    if resource.runnable:
        resource.run(1)
    else:
        resource.pass_time(1)


def state_words(resource: Resource) -> Words:
    """The state as it is now; not a copy."""
    return np.frombuffer(resource.memory, np.uint64, words_of(resource.program))
