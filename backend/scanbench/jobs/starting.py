"""Where comparisons begin: moments of run files, which may belong to a PLC that runs. Nothing is written to them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from scanbench.check.build import check_sources
from scanbench.engines.observe import MakeObserved
from scanbench.faults.carried import why_not_carried
from scanbench.faults.inject import ACTIVE, Generate
from scanbench.faults.reaction.observed import ObservedPrograms
from scanbench.faults.reaction.react import Point, react
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reaction.sweep import AUTHOR
from scanbench.host.build import BuildFailed, find_model
from scanbench.host.run_files import sources_in
from scanbench.plcmodel.model import Model
from scanbench.problems import Severity
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.format import RunFileError
from scanbench.recording.recording import Recording
from scanbench.recording.replay import Diverged, replay
from scanbench.recording.thinning import Checkpoint
from scanbench.recording.timeline import NOT_AS_RECORDED, KeptPrograms, open_at
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.header import Halt, Mode
from scanbench.runtime.inside import front
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import NoProgram
from scanbench.runtime.resource import Resource
from scanbench.wire.codec import ENTRIES
from scanbench.wire.host import Sources

T = TypeVar("T")
ProgramOf = Callable[[Sources], Program]
"""Builds a program; `NoProgram` says why it cannot be built."""


class NoStart(Exception):
    """Nothing can begin there; the message says why."""


def model_of(sources: Sources) -> Model:
    """The model that a program is for; `NoProgram` when it is not there any more."""
    try:
        return find_model(sources.model)
    except BuildFailed as error:
        raise NoProgram(str(error)) from error


def checked_program(sources: Sources, model: Model) -> Program:
    """The program that these sources are; `NoProgram` with the first error."""
    checked = check_sources(sources.files, model, sources.interval_ns)
    if checked.program is None:
        errors = [each for each in checked.problems if each.severity is Severity.ERROR]
        raise NoProgram(f"the program cannot be built: {errors[0] if errors else 'nothing to run'}")
    return checked.program


def reaction_in(
    path: Path, error: str, scan: int, end: int, window: int, program_of: ProgramOf, make: MakeObserved
) -> Reaction:
    """The reaction to an error that was raised in front of `scan` in the run of this file; `NoStart` when there is none.

    The file may be replaced by a smaller one while it is read: then the new one is read.
    """
    read = _file_at(path)
    try:
        return _reaction_in(path, error, scan, min(window, end - scan), program_of, make)
    except NoStart:
        if _file_at(path) == read:
            raise
        return _reaction_in(path, error, scan, min(window, end - scan), program_of, make)


def _file_at(path: Path) -> int | None:
    """Which file has this name now."""
    try:
        return path.stat().st_ino
    except OSError:
        return None


def _reaction_in(path: Path, error: str, scan: int, window: int, program_of: ProgramOf, make: MakeObserved) -> Reaction:
    def find(recording: Recording, programs: ObservedPrograms) -> Reaction:
        entries = recording.take_entries()
        index = _raised(entries, error, scan)
        before = [each for each in recording.checkpoints if each.scan <= scan and each.entries <= (index or 0)]
        if index is None or not before:
            raise NoStart(f"{path.name} does not have any more how {error} was raised before scan {scan}")
        resource = _replayed(recording, programs, before[-1], entries[:index], scan)
        point = Point(resource.version, resource.state, resource.journal)
        found = react(point, entries[index], entries[index + 1 :], window, programs, error)
        if isinstance(found, Refusal):
            raise NoStart(found.message)
        return found

    return _read(path, program_of, make, find)


def point_in(path: Path, scan: int | None, sources: Sources, program_of: ProgramOf, make: MakeObserved) -> Point:
    """The PLC before `scan`, or where the run ends, with the program of `sources`: carried over where it had another.

    The version of the point is that of `sources`. `NoStart` when there is no such scan, or nothing runs there.
    """

    def find(recording: Recording, programs: ObservedPrograms) -> Point:
        entries = recording.take_entries()
        until = recording.last_scan if scan is None else scan
        checkpoint = recording.before(until)
        if checkpoint is None or until > recording.last_scan:
            raise NoStart(
                f"{path.name} has scans {recording.first_scan} to {recording.last_scan}: scan {until} is none of them"
            )
        entries = [each for each in entries if each.scan <= until]
        entries = entries[: front(entries, until)]
        resource = _replayed(recording, programs, checkpoint, entries, until)
        running = sources_in(recording.programs[resource.version])
        if replace(running, version=sources.version) != sources:
            resource = _carried_over(resource, program_of(sources), max(recording.programs) + 1, make)
        _must_run(resource)
        return Point(sources.version, resource.state, resource.journal)

    return _read(path, program_of, make, find)


def _read(path: Path, program_of: ProgramOf, make: MakeObserved, use: Callable[[Recording, ObservedPrograms], T]) -> T:
    """Opens a run file; whatever is wrong with it is a `NoStart`."""
    try:
        with Recording.open(path, ENTRIES, read_only=True) as recording:
            return use(recording, ObservedPrograms(_of_file(recording.programs, program_of), make))
    except OSError as error:
        raise NoStart(f"{path.name} cannot be read: {error.strerror or error}") from error
    except RunFileError as error:
        raise NoStart(str(error)) from error
    except NoProgram as error:
        raise NoStart(str(error)) from error


def _replayed(
    recording: Recording, programs: ObservedPrograms, checkpoint: Checkpoint, entries: Sequence[Entry], scan: int
) -> Resource:
    """The PLC in front of `scan`, when these entries are all that was entered."""
    try:
        resource = open_at(recording, KeptPrograms(recording, programs), checkpoint, entries)
        replay(resource, entries[checkpoint.entries :], scan)
    except (Diverged, *NOT_AS_RECORDED) as error:
        raise NoStart(f"{recording.path.name} cannot be replayed: {error}") from error
    return resource


def _of_file(kept: Mapping[int, KeptProgram], program_of: ProgramOf) -> Callable[[int], Program]:
    def get(version: int) -> Program:
        if version not in kept:
            raise NoProgram(f"there is no program version {version} in the run")
        return program_of(sources_in(kept[version]))

    return get


def _raised(entries: list[Entry], error: str, scan: int) -> int | None:
    """Where the journal has it; the last one, as that is what stands."""
    for index in range(len(entries) - 1, -1, -1):
        entry = entries[index]
        if entry.scan < scan:
            return None
        command = entry.command
        if entry.scan == scan and isinstance(command, Generate) and any(each.id == error for each in command.errors):
            return index
    return None


def _carried_over(resource: Resource, program: Program, version: int, make: MakeObserved) -> Resource:
    """The PLC with another program, as an online change leaves it. It may be in RUN: here nobody works with it."""
    programs = ObservedPrograms({resource.version: resource.program, version: program}.__getitem__, make)
    there = Resource(programs.get(resource.version), programs=programs)
    there.restore(there.loaded, resource.state, resource.journal)
    why_not = why_not_carried(there.journal.derived(ACTIVE), resource.program, program)
    if why_not:
        raise NoStart(f"the program cannot take over there: {why_not}")
    view = there.view
    memory = bytearray(there.memory)
    memory[Layout.MODE] = Mode.MONITOR if there.header.mode is Mode.RUN else there.header.mode
    change = ProgramChange(AUTHOR, version)
    plan = change.plan(replace(view, memory=memory))
    if isinstance(plan, Refusal):
        raise NoStart(f"the program cannot take over there: {plan.message}")
    there.reenter(Entry(there.header.scan, wall_time(), change, plan))
    return there


def _must_run(resource: Resource) -> None:
    if resource.runnable:
        return
    if resource.header.halt & Halt.FATAL_ERROR:
        present = resource.journal.derived(ACTIVE)
        raise NoStart(f"the program is stopped there by a fatal error ({', '.join(present)}): begin where it runs")
    raise NoStart("the program does not run there: begin where the PLC is in MONITOR or RUN, and has not trapped")
