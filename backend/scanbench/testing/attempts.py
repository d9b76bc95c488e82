"""Plays scenarios of one project, one after the other, each from a cold start."""

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from types import TracebackType

from scanbench.history.scenario import Scenario
from scanbench.testing.play import Failed, play
from scanbench.testing.plc import Plc
from scanbench.testing.project import Project


class Attempts:
    """For a `with`, which gives what plays a scenario."""

    def __init__(self, project: Project) -> None:
        self._project = project
        self._folder = TemporaryDirectory()
        self._count = 0

    def __enter__(self) -> Callable[[Scenario], Failed | None]:
        return self._play

    def _play(self, scenario: Scenario) -> Failed | None:
        run = Path(self._folder.name) / f"{self._count}.scanrun"
        self._count += 1
        plc = Plc(self._project, run)
        try:
            return play(plc, scenario)
        finally:
            plc.close()
            run.unlink()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._folder.cleanup()
