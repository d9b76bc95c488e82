"""Golden run files: a newer program replays what an older one recorded, to the same bytes. See docs/formats.md."""

import json
import shutil
from dataclasses import asdict
from pathlib import Path

import pytest

from scanbench.engines.available import Flavours, Reference, flavours
from scanbench.recording.format import FORMAT
from scanbench.recording.programs import on
from scanbench.recording.replay_file import replay_file
from scanbench.recording.timeline import Timeline
from scanbench.wire.codec import ENTRIES
from tests.recording.golden_run import GOLDEN, SCANS, commands, expected, make, programs_on

FILES = sorted(GOLDEN.glob("format-*.run"))
NAMES = [path.stem for path in FILES]


def kept(path: Path) -> dict[str, object]:
    """What it came to when it was made."""
    found: dict[str, object] = json.loads(path.with_suffix(".json").read_text("utf-8"))
    return found


@pytest.mark.parametrize("path", FILES, ids=NAMES)
@pytest.mark.parametrize("code", [Reference(), flavours()], ids=("reference", "native"))
def test_a_golden_run_replays_to_the_same_bytes(path: Path, code: Flavours) -> None:
    replayed = replay_file(path, programs_on(on(code)), ENTRIES)
    was = kept(path)
    assert (replayed.scan, replayed.hash, replayed.entries, replayed.checkpoints) == (
        was["scan"], was["hash"], was["entries"], was["checkpoints"],
    )  # fmt: skip
    assert list(commands(path)) == was["commands"]


@pytest.mark.parametrize("path", FILES, ids=NAMES)
def test_a_golden_run_is_gone_on_with(path: Path, tmp_path: Path) -> None:
    shutil.copy(path, tmp_path / "run")
    timeline = Timeline.resume(tmp_path / "run", programs_on(on(Reference())), ENTRIES)
    assert timeline.live_scan == SCANS
    assert timeline.goto(SCANS // 2) is None
    timeline.return_live()
    timeline.run(10)
    assert timeline.live_scan == SCANS + 10
    timeline.close()


def test_there_is_one_of_the_format_of_today(tmp_path: Path) -> None:
    """Whoever raises the format makes another one: `python -m tests.recording.golden_run`. It comes to the same each time, but
    for checkpoints: of them there are more where scans take longer."""
    make(tmp_path / "run")
    now, then = json.loads(json.dumps(asdict(expected(tmp_path / "run")))), kept(GOLDEN / f"format-{FORMAT}.run")
    assert now.pop("checkpoints") >= 1
    assert now == {name: value for name, value in then.items() if name != "checkpoints"}
