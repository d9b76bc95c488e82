"""Threads of DAP are the tasks of the program; they stop together, as one PLC."""

from collections.abc import Iterable

from scanbench.web.dap.shapes import Body

PLC = 1
"""The first task; the PLC itself as long as no task is known."""


class Threads:
    """Numbers for tasks, by name, in the order in which they become known."""

    def __init__(self) -> None:
        self._tasks: list[str] = []

    def id(self, task: str) -> int:
        """The number of a task; where none runs, that of the first."""
        if not task:
            return PLC
        if task not in self._tasks:
            self._tasks.append(task)
        return self._tasks.index(task) + 1

    def learn(self, tasks: Iterable[str]) -> None:
        """The tasks of the program, as far as somebody said."""
        for task in tasks:
            self.id(task)

    @property
    def body(self) -> Body:
        """As DAP lists them."""
        names = self._tasks or ["PLC"]
        return {"threads": [{"id": number, "name": name} for number, name in enumerate(names, PLC)]}
