"""A PLC whose model file is gone: it stays, says why, loses nothing, and lives again when the file is back."""

import asyncio
import shutil
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

import pytest

from scanbench.host.run_files import run_path
from scanbench.plcmodel.load import model_directory
from scanbench.runtime.restart import Restart
from scanbench.server.workbench import Workbench
from scanbench.store.records import HistoryRow, NotFound
from scanbench.store.store import Store
from scanbench.wire.refused import Refused

NOON = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
ROW = HistoryRow(
    "battery-error", 1, "generated", "00F7", "", NOON, None, 7, None, "Ada", "simulator", 1, "recording", None, ""
)
SOURCE = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"


@pytest.fixture
def directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Of models, without any."""
    made = tmp_path / "models"
    (made / "omron").mkdir(parents=True)
    shutil.copy(model_directory() / "model.xsd", made)
    monkeypatch.setenv("SCANBENCH_MODELS", str(made))
    return made


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    """One PLC that is on, with a run and a history."""
    opened = Store(f"sqlite:///{tmp_path / 'bench.db'}")
    project = opened.projects.create("line", "CJ1M-CPU63").id
    opened.files.save(project, "main.st", SOURCE, 0, "Ada")
    opened.builds.accept(project, {"main.st": SOURCE}, "Ada")
    instance = opened.instances.create(project, "line-1").id
    opened.errors.keep(instance, [ROW])
    runs = tmp_path / "runs"
    runs.mkdir()
    run_path(runs, instance).write_bytes(b"the run")
    run_path(runs, instance).with_suffix(".run.previous").write_bytes(b"the run before")
    yield opened
    opened.close()


def test_it_stays_with_the_reason_and_nothing_of_it_is_lost(store: Store, directory: Path, tmp_path: Path) -> None:
    async def main() -> None:
        bench = Workbench(store, tmp_path)
        await bench.start()
        try:
            [session] = bench.sessions
            assert (session.name, session.model.name, session.state.state) == ("line-1", "CJ1M-CPU63", "failed")
            assert not session.state.startable
            reason = session.state.message
            assert reason.startswith(f"the model CJ1M-CPU63 is missing: no file in {directory} describes it. Put the")
            for refused in (
                await session.new_run("Ada"),
                await session.submit(Restart("Ada", "cold")),
            ):
                assert (refused.ok, refused.message) == (False, reason)
            for refusing in (
                bench.change_instance(session.id, "Ada", None, True, None),
                bench.records.of_instance(session, None, "Ada", "en"),
                bench.sweeps.begin(session, None, [], 200, "Ada"),
                bench.create_instance(session.project_id, "line-2"),
                bench.delete_project(session.project_id),
            ):
                with pytest.raises(Refused):
                    await refusing
            renamed = await bench.change_instance(session.id, "Ada", "the old one", None, None)
            assert (renamed.name, renamed.state.state) == ("the old one", "failed")
        finally:
            await bench.close()

    asyncio.run(main())
    [row] = store.instances.all()
    assert row.powered
    assert store.errors.history(row.id) == [ROW]
    path = run_path(tmp_path / "runs", row.id)
    assert path.read_bytes() == b"the run"
    assert path.with_suffix(".run.previous").read_bytes() == b"the run before"


def test_it_lives_again_when_the_file_is_back(
    store: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, directory: Path
) -> None:
    [row] = store.instances.all()
    store.instances.change(row.id, powered=False)  # so that no process is needed

    async def shown() -> tuple[str, str]:
        bench = Workbench(store, tmp_path)
        await bench.start()
        try:
            [session] = bench.sessions
            return session.state.state, session.state.message
        finally:
            await bench.close()

    (directory / "omron" / "CJ1M-CPU63.xml").write_text("<Plc")
    state, message = asyncio.run(shown())
    assert state == "failed"
    assert message.startswith("the model CJ1M-CPU63 cannot be used: omron/CJ1M-CPU63.xml:1:")
    monkeypatch.delenv("SCANBENCH_MODELS")
    assert asyncio.run(shown())[0] == "off"
    assert store.errors.history(row.id) == [ROW]


def test_it_can_be_deleted(store: Store, directory: Path, tmp_path: Path) -> None:
    async def main() -> None:
        bench = Workbench(store, tmp_path)
        await bench.start()
        try:
            [session] = bench.sessions
            await bench.delete_instance(session.id)
            await bench.delete_project(session.project_id)
            with pytest.raises(NotFound):
                bench.session(session.id)
        finally:
            await bench.close()

    asyncio.run(main())
    assert not store.instances.all()
    assert not list((tmp_path / "runs").iterdir())
