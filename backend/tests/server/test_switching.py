"""A PLC is switched off by one person while it begins a new run for another."""

import asyncio
import threading
from dataclasses import replace
from pathlib import Path

import pytest

from scanbench.host import run_files
from scanbench.plcmodel.load import model_named
from scanbench.server.solo import Solo
from scanbench.session import instance
from tests.host.test_zygote import PATIENCE_S, sources


def test_switching_off_counts_while_a_new_run_begins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    reached, goes_on = threading.Event(), threading.Event()
    set_aside = run_files.set_aside

    def slowly(path: Path) -> None:
        reached.set()
        assert goes_on.wait(PATIENCE_S)
        set_aside(path)

    monkeypatch.setattr(instance, "set_aside", slowly)

    async def story() -> None:
        model = model_named("GENERIC-IEC")
        solo = await Solo.start("line", sources(), model, 1.0, tmp_path)
        session = solo.session
        begins = asyncio.create_task(session.new_run("Ann"))
        await asyncio.to_thread(reached.wait, PATIENCE_S)  # the old process has ended, the new one has not begun
        off = asyncio.create_task(session.change(replace(session.row, powered=False), "Bob"))
        await asyncio.sleep(0)
        goes_on.set()
        assert (await begins).ok
        await off
        assert (session.state.state, session.instance.on) == ("off", False)
        assert [line.text for line in session.log.lines][-1] == "switched off"
        await solo.close()

    asyncio.run(story())
