"""Where comparisons begin: moments of run files, which may belong to a PLC that runs. Nothing is written to them."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from scanbench.check.build import check_sources
from scanbench.engines.observe import MakeObserved
from scanbench.faults.carried import why_not_carried
from scanbench.faults.inject import ACTIVE, Generate, present_texts
from scanbench.faults.reaction.react import react
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reaction.required_rules import rules_of
from scanbench.faults.reaction.steps import Point
from scanbench.faults.reaction.sweep import AUTHOR
from scanbench.faults.reference import covers
from scanbench.host.build import BuildFailed, find_model
from scanbench.host.run_files import ProgramOf, programs_by, sources_in
from scanbench.plcmodel.model import Model
from scanbench.problems import Severity
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.recording.programs import cached, observed
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.header import Halt, Mode
from scanbench.runtime.inside import front
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import NoProgram
from scanbench.runtime.resource import Resource
from scanbench.wire.codec import ENTRIES
from scanbench.wire.host import Sources


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
    """The reaction to an error that was raised before `scan` in the run of this file; `Unreadable` when there is none.

    The file may be replaced by a smaller one while it is read: then the new one is read.
    """
    read = _file_at(path)
    try:
        return _reaction_in(path, error, scan, end, window, program_of, make)
    except Unreadable:
        if _file_at(path) == read:
            raise
        return _reaction_in(path, error, scan, end, window, program_of, make)


def _file_at(path: Path) -> int | None:
    """Which file has this name now."""
    try:
        return path.stat().st_ino
    except OSError:
        return None


def _reaction_in(
    path: Path, error: str, scan: int, end: int, window: int, program_of: ProgramOf, make: MakeObserved
) -> Reaction:
    with RunReader(path, programs_by(program_of, observed(make)), ENTRIES) as reader:
        reader.follow()
        entries = reader.entries
        index = _raised(entries, error, scan)
        if index is None or scan < reader.first or index < reader.recording.checkpoints[0].entries:
            raise Unreadable(f"{path.name} does not have any more how {error} was raised before scan {scan}")
        resource = reader.at(scan, index)
        point = Point(resource.version, resource.state, resource.journal)
        with reader.reading():
            rules = rules_of(resource.program, sources_in(reader.kept[resource.version]).files)
            after, left = entries[index + 1 :], min(window, end - scan)
            found = react(point, entries[index], after, left, reader.programs, error, rules, window)
        if isinstance(found, Refusal):
            raise Unreadable(found.message)
        return found


def point_in(path: Path, scan: int | None, sources: Sources, program_of: ProgramOf, make: MakeObserved) -> Point:
    """The PLC before `scan`, or where the run ends, with the program of `sources`: carried over if it ran a different program.

    The version of the point is that of `sources`. `Unreadable` when there is no such scan, or nothing runs there.
    """
    with RunReader(path, programs_by(program_of, observed(make)), ENTRIES) as reader:
        reader.follow()
        until = reader.end if scan is None else scan
        if not reader.first <= until <= reader.end:
            raise Unreadable(f"{path.name} has scans {reader.first} to {reader.end}: scan {until} is none of them")
        resource = reader.at(until, front([each for each in reader.entries if each.scan <= until], until))
        with reader.reading():
            running = sources_in(reader.kept[resource.version])
            if replace(running, version=sources.version) != sources:
                resource = _carried_over(resource, program_of(sources), max(reader.kept) + 1, make)
        _must_run(resource)
        return Point(sources.version, resource.state, resource.journal)


def _raised(entries: Sequence[Entry], error: str, scan: int) -> int | None:
    """The index of the last entry that raised the error at this scan; None if there is none."""
    for index in range(len(entries) - 1, -1, -1):
        entry = entries[index]
        if entry.scan < scan:
            return None
        command = entry.command
        if entry.scan == scan and isinstance(command, Generate) and any(covers(error, each) for each in command.errors):
            return index
    return None


def _carried_over(resource: Resource, program: Program, version: int, make: MakeObserved) -> Resource:
    """The PLC with the program `program`, as after an online change. It may be in RUN, as nobody works with it here."""
    programs = cached({resource.version: resource.program, version: program}, observed(make))
    there = Resource(programs.get(resource.version), programs=programs)
    there.restore(there.loaded, resource.state, resource.journal)
    why_not = why_not_carried(there.journal.derived(ACTIVE), resource.program, program)
    if why_not:
        raise Unreadable(f"the program cannot take over there: {why_not}")
    view = there.view
    memory = bytearray(there.memory)
    memory[Layout.MODE] = Mode.MONITOR if there.header.mode is Mode.RUN else there.header.mode
    change = ProgramChange(AUTHOR, version)
    plan = change.plan(replace(view, memory=memory))
    if isinstance(plan, Refusal):
        raise Unreadable(f"the program cannot take over there: {plan.message}")
    there.reenter(Entry(there.header.scan, wall_time(), change, plan))
    return there


def _must_run(resource: Resource) -> None:
    if resource.runnable:
        return
    if resource.header.halt & Halt.FATAL_ERROR:
        present = resource.journal.derived(ACTIVE)
        raise Unreadable(
            f"the program is stopped there by a fatal error ({', '.join(present_texts(present))}): begin where it runs"
        )
    raise Unreadable("the program does not run there: begin where the PLC is in MONITOR or RUN, and has not trapped")
