"""Where in the program something happened, for people."""

from collections.abc import Callable
from dataclasses import dataclass

from scanbench.engines.debug import Frame
from scanbench.program.program import Pou, Program
from scanbench.symbols.instances import instances_of, owner_of
from scanbench.symbols.names import names_of
from scanbench.symbols.sites import Sites
from scanbench.verify.contract import Place

Line = Callable[[str, int], str]
"""A line of a source file, trimmed; empty where it is not known."""
FramesAt = Callable[[int], tuple[Frame, ...]]
"""The open calls before the statement of a count, innermost first."""


@dataclass
class Places:
    """Of one program."""

    program: Program
    sites: Sites
    line: Line

    def __post_init__(self) -> None:
        self._pous = {pou.name: pou for pou in self.sites.bodies}
        self._paths: dict[tuple[Pou, int], str] = {}

    def of(self, site: int, frames: tuple[Frame, ...]) -> Place:
        """The place of a statement, with these calls open."""
        statement = self.sites.statements[site]
        frame = next((each for each in frames if each.pou.name == statement.pou), None)
        pou = self._pous.get(statement.pou)
        path = self.path(frame.pou, frame.instance) if frame is not None else self._only(pou)
        span = statement.span
        return Place(
            self.task(frames), path or statement.pou, statement.pou, span.file, span.line, self.line(span.file, span.line)
        )  # fmt: skip

    def of_trap(self, trap: int, frames: tuple[Frame, ...] = ()) -> Place:
        """The place of a run-time error, by its number, and the calls that were open."""
        site = self.program.traps[trap - 1]
        frame = next((each for each in frames if each.pou.name == site.pou), None)
        path = self.path(frame.pou, frame.instance) if frame is not None else self._only(self._pous.get(site.pou))
        span = site.span
        line = self.line(span.file, span.line)
        return Place(self.task(frames), path or site.pou, site.pou, span.file, span.line, line)

    def path(self, pou: Pou | None, instance: int) -> str:
        """`Main.belt[3]`; of a FUNCTION its name."""
        if pou is None:
            return ""
        known = self._paths.get((pou, instance))
        if known is None:
            record = owner_of(pou)
            known = pou.name if record is None else names_of(self.program).instance(instance, record.name)
            self._paths[pou, instance] = known
        return known

    def task(self, frames: tuple[Frame, ...]) -> str:
        """The task that runs, by the outermost frame; where there is one task only, that."""
        tasks = self.program.tasks
        if frames:
            root = frames[-1]
            for task in tasks:
                if any(each.pou is root.pou and each.offset == root.instance for each in task.programs):
                    return task.name
        return tasks[0].name if len(tasks) == 1 else ""

    def _only(self, pou: Pou | None) -> str:
        """The path of the instance, where there is no other."""
        record = None if pou is None else owner_of(pou)
        found = [] if record is None else instances_of(self.program, record.name, 2)
        return found[0].path if len(found) == 1 else ""
