"""Threads of DAP are the tasks of the program; they stop together, as one PLC."""

from collections.abc import Sequence

from scanbench.web.dap.shapes import Body

PLC = 1
"""The first task; the PLC itself as long as no task is known."""


class Threads:
    """Numbers for tasks, by name, in the order in which they become known. A task keeps its number even while a program runs
    that has no task of this name."""

    def __init__(self) -> None:
        self._tasks: list[str] = []

    def id(self, task: str) -> int:
        """The number of a task; where none runs, that of the first."""
        if not task:
            return PLC
        if task not in self._tasks:
            self._tasks.append(task)
        return self._tasks.index(task) + PLC

    def is_other(self, id: int, task: str) -> bool:
        """Whether this is the number of a task, and not of this one."""
        return PLC <= id < PLC + len(self._tasks) and id != self.id(task)

    def listed(self, tasks: Sequence[str]) -> Body:
        """The tasks of the program as DAP lists them; with none given, those that were known last."""
        names = tasks or self._tasks
        threads = [{"id": self.id(name), "name": name} for name in names]
        return {"threads": threads or [{"id": PLC, "name": "PLC"}]}
