"""The tasks of a program in a comparison: which had no turn in it, and which look at bits of an error by themselves."""

from collections.abc import Iterator

from scanbench.faults.reaction.error_memory import Watched
from scanbench.faults.reaction.reaction import What
from scanbench.problems import Span
from scanbench.program.program import Base, Program
from scanbench.program.tasks import Task
from scanbench.symbols.values import format_time


class Turns:
    """Which tasks with an interval had their turn."""

    def __init__(self, program: Program) -> None:
        self._waiting = [task for task in program.tasks if task.programs and task.every and task.single is None]

    def ran(self, scan: int) -> None:
        """The program ran in this scan."""
        if self._waiting:
            self._waiting = [task for task in self._waiting if scan % task.every]

    @property
    def idle(self) -> tuple[Task, ...]:
        """Those that had none until now."""
        return tuple(self._waiting)

    def notes(self, scans: int) -> Iterator[str]:
        """About those that had none in so many scans."""
        for task in self._waiting:
            every = format_time(task.interval_ns).removeprefix("T#")
            yield f"task {task.name} (every {every}) did not run in the {scans} scans: a longer window would tell"


def triggers(program: Program, watched: Watched) -> Iterator[tuple[str, Span, What]]:
    """Tasks whose SINGLE is a bit of the error: name, the span of SINGLE, and what the bit is."""
    for task in program.tasks:
        bits = _looked_at(task)
        if bits is not None and task.single_span is not None:
            for what in watched.kinds(*bits):
                yield task.name, task.single_span, what


def _looked_at(task: Task) -> tuple[int, int] | None:
    """Byte and mask."""
    place = task.single
    if place is None or place.base is not Base.IMAGE or place.indices or place.slot or place.reference:
        return None
    return place.offset, 1 << (place.bit or 0)
