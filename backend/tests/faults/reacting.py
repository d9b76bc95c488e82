"""Points and reactions for tests."""

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.engines.observe import MakeObserved
from scanbench.faults.detect import Detection
from scanbench.faults.inject import Generate
from scanbench.faults.reaction.react import react
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reaction.steps import Point
from scanbench.faults.reference import ErrorRef, parse_reference
from scanbench.program.program import Program
from scanbench.recording.programs import ProgramCache, cached, observed
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.resource import Resource
from tests.runtime.bench import model

MAKES: dict[str, MakeObserved] = {"reference": observed_engine, "native": ObservedBuilds(None).engine}


def checked(sources: dict[str, str], model_name: str = "CJ1M-CPU63") -> Program:
    found = check_sources(sources, model(model_name))
    assert found.program is not None, found.problems
    return found.program


def programs(program: Program, make: MakeObserved) -> ProgramCache:
    return cached({1: program}, observed(make))


def standing(program: Program, make: MakeObserved, scans: int = 10) -> Resource:
    """A live PLC of its own."""
    made = programs(program, make)
    resource = Resource(made.get(1), programs=made, detect=Detection())
    _advance(resource, scans)
    return resource


def point_of(resource: Resource) -> Point:
    return Point(resource.version, resource.state, resource.journal.prefix(len(resource.journal)))


def ref(text: str, model_name: str = "CJ1M-CPU63") -> ErrorRef:
    found = parse_reference(model(model_name), text)
    assert isinstance(found, ErrorRef), found
    return found


def reaction(
    source: str, error: str, make: MakeObserved, window: int = 50, before: tuple[Command, ...] = (), scans: int = 10
) -> Reaction:
    """To an error raised alone, in scan 10 of a live run."""
    found = attempt(checked({"main.st": source}), (error,), make, window, before=before, scans=scans)
    assert isinstance(found, Reaction), found
    return found


def attempt(
    program: Program,
    errors: tuple[str, ...],
    make: MakeObserved,
    window: int = 50,
    later: tuple[tuple[int, Command], ...] = (),
    before: tuple[Command, ...] = (),
    scans: int = 10,
) -> Reaction | Refusal:
    """A live run with these errors in one batch, with commands so many scans later; the reaction to the first error."""
    live = standing(program, make, scans)
    for command in before:
        assert isinstance(live.submit(command), Entry)
    point = point_of(live)
    refs = tuple(ref(each, program.layout.model.name) for each in errors)
    entry = live.submit(Generate("Ada", refs))
    assert isinstance(entry, Entry), entry
    entered, begin = len(live.journal), live.header.scan
    for at, command in later:
        _advance(live, begin + at - live.header.scan)
        live.submit(command)
    _advance(live, begin + window - live.header.scan)
    return react(point, entry, live.journal[entered:], window, programs(program, make), refs[0].id)


def _advance(resource: Resource, scans: int) -> None:
    end = resource.header.scan + scans
    while resource.header.scan < end and resource.trap is None:
        if resource.runnable:
            resource.run(end - resource.header.scan)
        else:
            resource.pass_time(1)
