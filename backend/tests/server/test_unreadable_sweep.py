"""A sweep that only a newer version can read: it stops nothing else, and nothing of it is lost."""

import asyncio
import shutil
import sqlite3
from collections.abc import Iterator
from pathlib import Path

import pytest

from scanbench.plcmodel.load import model_directory
from scanbench.server.workbench import Workbench
from scanbench.store.records import StoreError, SweptError
from scanbench.store.store import Store

BATTERY = SweptError("battery-error", "Battery error", "00F7", "nonfatal", "PLC")
SOURCE = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Store]:
    """One PLC that nothing is needed for, and two sweeps of it."""
    (tmp_path / "models").mkdir()
    shutil.copy(model_directory() / "model.xsd", tmp_path / "models")
    monkeypatch.setenv("SCANBENCH_MODELS", str(tmp_path / "models"))
    opened = Store(f"sqlite:///{tmp_path / 'bench.db'}")
    project = opened.projects.create("line", "CJ1M-CPU63").id
    opened.builds.accept(project, {"main.st": SOURCE}, "Ada")
    opened.instances.create(project, "line-1")
    for _ in range(2):
        opened.sweeps.create(
            project, instance_id=None, instance="line-1", model="CJ1M-CPU63", program_version=1, by="ada", window=200,
            states=("filled", "empty"), errors=(BATTERY,),
        )  # fmt: skip
    yield opened
    opened.close()


@pytest.mark.parametrize(
    ("column", "content"), [("errors", '[{"id": "x"}]'), ("errors", '["x"]'), ("states", '{"of": "a newer version"}')]
)
def test_it_is_left_out_with_a_line_in_the_log(
    store: Store, tmp_path: Path, caplog: pytest.LogCaptureFixture, column: str, content: str
) -> None:
    with sqlite3.connect(tmp_path / "bench.db") as database:
        database.execute(f"UPDATE sweep SET {column} = ? WHERE id = 1", (content,))
    states = tmp_path / "states"
    states.mkdir()
    kept = ["sweep-1-0.run", "sweep-1-7.run", "sweep-2-0.run"]
    for name in (*kept, "sweep-3-0.run", "9.run"):
        (states / name).write_bytes(b"a run")

    async def main() -> None:
        bench = Workbench(store, tmp_path)
        await bench.start()
        try:
            [session] = bench.sessions
            assert [each.id for each in await bench.sweeps.of_project(session.project_id)] == [2]
            with pytest.raises(StoreError, match=r"sweep 1 cannot be read: .*Use the version"):
                await bench.sweeps.row(1)
        finally:
            await bench.close()

    asyncio.run(main())
    assert "sweep 1 cannot be read: " in caplog.text
    assert sorted(path.name for path in states.iterdir()) == kept
