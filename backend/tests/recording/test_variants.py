"""Run files with one changed number: opened or refused, with an amount of work that has nothing to do with the number."""

from itertools import islice
from pathlib import Path

import pytest

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.faults.detect import Detection
from scanbench.recording.format import RunFileError
from scanbench.recording.reader import Unreadable
from scanbench.recording.replay import Diverged
from scanbench.recording.replay_file import replay_file
from scanbench.recording.timeline import Timeline
from scanbench.runtime.resource import Resource
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount, nightly
from tests.recording.recorded import spare
from tests.recording.variants import agenda, records, variants, write

MOST = 10_000
"""Scans: a few more than the file has are no harm."""


class TooMuch(BaseException):
    """Nobody catches it on the way."""


@nightly
def test_no_number_in_a_run_file_is_believed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every variant is opened as a PLC does it, and run on for some scans; every tenth one is replayed too."""
    whole = records(tmp_path)
    monkeypatch.setattr("scanbench.recording.replay.BETWEEN", 1_000)
    run, reenter = Resource._run, Resource.reenter
    left = 0

    def spend(work: int) -> None:
        nonlocal left
        left -= work
        if left < 0:
            raise TooMuch

    def counted_run(self: Resource, engine: object, scans: int, *others: object) -> object:
        spend(scans)
        return run(self, engine, scans, *others)  # type: ignore[arg-type]

    def counted_reenter(self: Resource, entry: object) -> None:
        spend(1)
        reenter(self, entry)  # type: ignore[arg-type]

    monkeypatch.setattr(Resource, "_run", counted_run)
    monkeypatch.setattr(Resource, "reenter", counted_reenter)
    programs = spare(ReferenceEngine)
    outcomes = {"opened": 0, "refused": 0}
    for number, (name, changed) in enumerate(islice(variants(whole), 0, None, amount(1, 9))):
        path = write(tmp_path / "variant", changed)
        left = MOST
        try:
            if number % 10 == 0:
                replay_file(path, lambda kept: programs, ENTRIES)
            timeline = Timeline.resume(path, lambda kept: programs, ENTRIES, 0, Detection(), agenda=agenda())
            if timeline.resource.runnable:
                timeline.run(2)
            timeline.goto(timeline.recording.first_scan)
            timeline.close()
            outcomes["opened"] += 1
        except (RunFileError, Unreadable, Diverged):
            outcomes["refused"] += 1
        except TooMuch:
            pytest.fail(f"{name}: more than {MOST} scans and entries")
    assert min(outcomes.values()) > amount(100, 10), outcomes
