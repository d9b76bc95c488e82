"""A client that writes again and again: what it writes takes few bytes, and neither file nor memory grow without end."""

from pathlib import Path

import pytest

from bench.heartbeat import run_heartbeat
from scanbench.recording import smaller
from scanbench.recording.recording import DEFAULT_LIMIT
from tests.amounts import amount, nightly


@nightly
def test_the_journal_stays_within_its_bound(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    limit = amount(smaller.ENTRY_LIMIT, 1_000)
    monkeypatch.setattr(smaller, "ENTRY_LIMIT", limit)
    days = 3 * limit / (24 * 60 * 60 * 10)
    found = run_heartbeat(tmp_path / "run", days)
    assert found.writes > 2.9 * limit
    assert found.bytes_a_write <= 20
    assert found.most_entries <= 1.25 * limit + 2_500, "it is cut at a checkpoint, which is taken each 2,000 entries"
    assert found.most_file_mib < DEFAULT_LIMIT / (1 << 20)
    assert found.gone_on
