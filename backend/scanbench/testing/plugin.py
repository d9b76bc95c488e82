"""The plugin of pytest. Fixtures: `project`, compiled once, and `plc`, a fresh one for each test.

    pytest --scanbench-project plant/            or `scanbench_project = plant` in pytest.ini
    pytest --scanbench-engine both               both engines, compared after every scan
    pytest --scanbench-runs runs/                where the run of a failed test is left

A test that failed says where its run file is. With SCANBENCH_SERVER (the address that `scanbench serve` prints, with its token) the run is
taken to that server, and the failure has a link that opens the browser at the scan.
"""

import os
import re
import shutil
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from scanbench.testing.chosen import named_project, read_project

if TYPE_CHECKING:  # what is not asked for must not make the start of other tests slow
    from scanbench.testing.plc import Plc
    from scanbench.testing.project import Project

_ENGINES = ("native", "reference", "both")
_SERVER = "SCANBENCH_SERVER"
_RUNS = "scanbench-runs"


def pytest_addoption(parser: pytest.Parser) -> None:
    """What can be said on the command line, or in pytest.ini."""
    group = parser.getgroup("scanbench", "PLC programs")
    group.addoption("--scanbench-project", metavar="DIR", help="folder or file with the program to test")
    group.addoption("--scanbench-engine", choices=_ENGINES, default="native", help="what runs the program")
    group.addoption("--scanbench-runs", metavar="DIR", default=_RUNS, help="where the runs of failed tests are left")
    parser.addini("scanbench_project", "folder or file with the program to test, from the folder of this file")


def pytest_configure(config: pytest.Config) -> None:
    """The mark that names a project for single tests."""
    config.addinivalue_line("markers", "scanbench(project): the folder or file with the program that this test needs")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """A scenario file is a test."""
    if file_path.suffix != ".yaml":
        return None
    from scanbench.testing.collected import ENDING, ScenarioFile

    return ScenarioFile.from_parent(parent, path=file_path) if file_path.name.endswith(ENDING) else None


@pytest.fixture
def project(request: pytest.FixtureRequest) -> "Project":
    """The program: that of the mark `scanbench(project=...)`, else of the option, else of pytest.ini, else the folder of the test."""
    config, mark = request.config, request.node.get_closest_marker("scanbench")
    if mark is not None:
        path = request.path.parent / (mark.args[0] if mark.args else mark.kwargs["project"])
    else:
        path = named_project(config) or request.path.parent
    return read_project(path.resolve(), config.getoption("--scanbench-engine"))


@pytest.fixture
def plc(project: "Project", tmp_path: Path) -> Iterator["Plc"]:
    """A PLC at a cold start, with the program of the project."""
    from scanbench.testing.plc import Plc

    made = Plc(project, tmp_path / "test.scanrun")
    yield made
    made.close()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: "pytest.CallInfo[None]"
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Leaves the run of a test that failed, and says where it is."""
    report = yield
    plc: Plc | None = getattr(item, "plc", None) or getattr(item, "funcargs", {}).get("plc")
    if call.when == "call" and report.failed and plc is not None and hasattr(plc, "run_file"):
        report.sections.append(("run of the PLC", _left(item, plc)))
    return report  # as pytest wants it of a wrapper


def _left(item: pytest.Item, plc: "Plc") -> str:
    folder = item.config.invocation_params.dir / str(item.config.getoption("--scanbench-runs"))
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / (re.sub(r"[^\w.-]+", "_", item.nodeid).strip("_") + ".scanrun")
    scan = max(0, plc.scan - 1)
    plc.close()
    shutil.copyfile(plc.run_file, path)
    said = f"{path}\nfailed after scan {scan}: import the file in the browser, and go to that scan"
    address = os.environ.get(_SERVER, "")
    return (
        f"{said}\n{_link(address, path, item.name, scan)}"
        if address
        else f"{said}. With {_SERVER} set there is a link here"
    )


def _link(address: str, run: Path, name: str, scan: int) -> str:
    from scanbench.client import Refused, connect

    try:
        return connect(address).take_run(run.read_bytes(), name).link(scan)
    except (OSError, Refused) as error:
        return f"{address} does not take the run: {error}"
