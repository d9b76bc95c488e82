"""What tasks there are, for the explorer."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import ClassVar

from scanbench.problems import Span
from scanbench.program.program import Program
from scanbench.program.tasks import Task
from scanbench.public import Public
from scanbench.syntax import tree


@dataclass(frozen=True, slots=True)
class TaskProgram(Public):
    """What a task runs."""

    PUBLIC: ClassVar = "TaskProgram"

    name: str
    """The path of the instance."""
    pou: str
    """What it is an instance of: a program, or a function block that the task runs by itself."""


@dataclass(frozen=True, slots=True)
class TaskInfo(Public):
    """A task of the CONFIGURATION; without one there is a single task, which runs every program."""

    PUBLIC: ClassVar = "Task"

    name: str
    interval_ns: int
    """0 where only an event starts it."""
    event: bool
    """A rising edge starts it (SINGLE)."""
    priority: int
    """0 is the highest."""
    file: str
    """Where it is declared; empty where it is not."""
    line: int
    programs: tuple[TaskProgram, ...]


def task_infos(program: Program, files: Iterable[tree.File]) -> tuple[TaskInfo, ...]:
    """The tasks of a program, the highest priority first."""
    places = dict(_places(files))
    return tuple(_info(task, places.get(task.name.upper())) for task in program.tasks)


def _info(task: Task, place: Span | None) -> TaskInfo:
    runs = tuple(TaskProgram(each.name, each.pou.name) for each in task.programs)
    file, line = ("", 0) if place is None else (place.file, place.line)
    return TaskInfo(task.name, task.interval_ns, task.single is not None, task.priority, file, line, runs)


def _places(files: Iterable[tree.File]) -> Iterator[tuple[str, Span]]:
    """Each declaration under the name that the program may have it by: with its resource where there are several."""
    for file in files:
        for configuration in file.configurations:
            yield from ((task.name.upper(), task.span) for task in configuration.tasks)
            for resource in configuration.resources:
                for task in resource.tasks:
                    yield task.name.upper(), task.span
                    yield f"{resource.name}.{task.name}".upper(), task.span
