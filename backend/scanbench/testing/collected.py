"""Scenario files as tests of pytest."""

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from scanbench.history.scenario import ENDING, BadScenario, project_of, read_scenario
from scanbench.testing.chosen import named_project, read_project
from scanbench.testing.play import nothing_expected, play
from scanbench.testing.plc import Plc, PlcFailure

__all__ = ["ENDING", "ScenarioFile"]


class ScenarioFile(pytest.File):
    """A file with one scenario."""

    def collect(self) -> Iterator[pytest.Item]:
        """Its test."""
        yield ScenarioItem.from_parent(self, name=self.path.name.removesuffix(ENDING))


class ScenarioItem(pytest.Item):
    """Plays the scenario on a PLC of its own."""

    plc: Plc | None = None
    """That of the last time: a failure leaves its run."""
    _folder: "TemporaryDirectory[str] | None" = None

    def runtest(self) -> None:
        """`PlcFailure` says what was not as expected."""
        try:
            scenario = read_scenario(self.path.read_text("utf-8"))
        except BadScenario as error:
            pytest.fail(f"{self.path}: {error}", pytrace=False)
        # as a test does: what the file itself says, else the option, else pytest.ini, else its folder
        named = named_project(self.config) if scenario.project == "." else None
        path = project_of(self.path, scenario) if named is None else named.resolve()
        project = read_project(path, self.config.getoption("--scanbench-engine"))
        self._folder = TemporaryDirectory()
        self.plc = Plc(project, Path(self._folder.name) / "scenario.scanrun")
        failed = play(self.plc, scenario)
        if failed is not None:
            raise PlcFailure(failed.message)
        if not scenario.expect:
            pytest.skip(nothing_expected(scenario))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: object = None) -> str:
        """The sentence, without a traceback: there is no code of the user's."""
        if isinstance(excinfo.value, PlcFailure):
            return f"{self.path.name}: {excinfo.value}"
        return str(super().repr_failure(excinfo))

    def teardown(self) -> None:
        """Its run is not needed any more."""
        if self.plc is not None:
            self.plc.close()
        if self._folder is not None:
            self._folder.cleanup()

    def reportinfo(self) -> tuple[Path, int, str]:
        """Where it is."""
        return self.path, 0, self.name
