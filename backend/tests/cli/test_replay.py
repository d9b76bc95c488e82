"""`scanbench run --record`, `replay`, and what a run can be told beside writes: modes, restarts, where to end."""

import json
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from xml.etree.ElementTree import parse

import pytest
from typer.testing import CliRunner, Result

from scanbench.cli.commands import app
from scanbench.cli.inputs import find_model_named
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.faults.inject import ACTIVE
from scanbench.host.run_files import sources_of
from scanbench.jobs.starting import checked_program
from scanbench.plcmodel.load import load_all, model_directory
from scanbench.recording import checkpoints
from scanbench.recording import format as runfile
from scanbench.recording.blocks import About
from scanbench.recording.recording import Recording
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry
from scanbench.runtime.forces import FORCED
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Loaded, LoadedPrograms
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES, pack_body
from scanbench.wire.host import Sources

SOURCE = """
PROGRAM Main
VAR n : DINT; kept AT D100 : INT; END_VAR
VAR RETAIN total : DINT; END_VAR
  n := n + 1;
  total := total + 1;
  kept := 7;
END_PROGRAM
"""


@pytest.fixture
def program(tmp_path: Path) -> str:
    file = tmp_path / "main.st"
    file.write_text(SOURCE)
    return str(file)


def call(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def run(program: str, *arguments: str) -> Result:
    return call("run", program, "--model", "CJ1M-CPU63", *arguments)


def test_a_recorded_run_replays_to_the_same_state(program: str, tmp_path: Path) -> None:
    record = str(tmp_path / "a.scanrun")
    ran = run(
        program, "--scans", "5000", "--set", "Main.n=40@100", "--restart", "warm@300",
        "--raise", "battery-error@400", "--mode", "PROGRAM@500", "--mode", "RUN@510", "--record", record, "--hash",
    )  # fmt: skip
    assert ran.exit_code == 0, ran.output
    hash = next(line.split()[1] for line in ran.output.splitlines() if line.startswith("sha256"))
    for engine in ("native", "both"):
        again = call("replay", record, "--engine", engine, "--json")
        assert again.exit_code == 0, again.output
        replayed = json.loads(again.stdout)
        assert (replayed["hash"], replayed["first_scan"], replayed["scan"]) == (hash, 0, 5000)
        assert replayed["entries"] == 5
    part = json.loads(call("replay", record, "--scans", "200", "--json").stdout)
    assert (part["scan"], part["entries"]) == (200, 1)
    assert part["hash"] != hash
    there = run(program, "--scans", "1", "--record", record)
    assert there.exit_code == 2
    assert "is there already" in there.output


@pytest.mark.parametrize("marks", [True, False])
def test_a_run_that_ends_without_its_mark_is_cut_off_unless_its_writer_left_none(
    program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, marks: bool
) -> None:
    of = About.of
    monkeypatch.setattr(About, "of", staticmethod(lambda program, by: replace(of(program, by), marks=marks)))
    record = tmp_path / "a.scanrun"
    assert run(program, "--scans", "500", "--record", str(record)).exit_code == 0
    with closing(runfile.RunFile.open(record, read_only=True)) as file:
        assert list(file.scan_blocks())
        end = file.end
    assert end < record.stat().st_size
    whole = call("replay", str(record))
    assert (whole.exit_code, "is not known" in whole.output) == (0, False)
    record.write_bytes(record.read_bytes()[:end])
    cut = call("replay", str(record))
    assert cut.exit_code == (4 if marks else 0), cut.output
    assert ("left no mark" in cut.output) != marks
    assert "Whether more than scan" in cut.output


def test_a_recorded_run_has_checkpoints_on_the_way(
    program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    record = tmp_path / "a.scanrun"
    arguments = ("--scans", "300", "--set", "Main.n=40@100", "--mode", "PROGRAM@150", "--mode", "RUN@160", "--every", "40",
                 "--print", "Main.n", "--until", "Main.n >= 160", "--json")  # fmt: skip
    ran, plain = run(program, *arguments, "--record", str(record)), run(program, *arguments)
    assert ran.exit_code == 0, ran.output
    assert ran.stdout == plain.stdout
    assert json.loads(ran.stdout)["scans"] == 230
    with Recording.open(record, ENTRIES, read_only=True) as recording:
        assert len({each.scan for each in recording.checkpoints}) > 150
        assert recording.last_scan == 230
    again = call("replay", str(record), "--json")
    assert again.exit_code == 0, again.output


def test_a_recorded_run_stays_within_its_limit(program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    monkeypatch.setattr("scanbench.cli.record.LIMIT", 60_000)
    record = tmp_path / "a.scanrun"
    ran = run(program, "--scans", "6000", "--force", "D200=7@3", "--raise", "battery-error@5", "--record", str(record))
    assert ran.exit_code == 0, ran.output
    assert record.stat().st_size < 80_000
    assert call("replay", str(record)).exit_code == 0
    with Recording.open(record, ENTRIES, read_only=True) as recording:
        assert recording.info.thinned_before > 0
        journal = Journal(recording.take_entries())
        assert (len(journal.derived(FORCED)), len(journal.derived(ACTIVE))) == (1, 1)


def test_a_recorded_run_has_the_names_of_its_project(program: str, tmp_path: Path) -> None:
    folder = Path(program).parent / "line"
    (folder / "plant").mkdir(parents=True)
    (folder / "main.st").write_text(SOURCE)
    (folder / "plant" / "inputs.csv").write_text("scan;D7\n3;5\n")
    record = tmp_path / "named.scanrun"
    ran = run(str(folder), "--scans", "10", "--print", "D7", "--record", str(record))
    assert ran.exit_code == 0, ran.output
    assert "D7 = 16#0005" in ran.output
    models, _ = load_all(model_directory())
    sources = sources_of(record, {model.name: model for model in models})
    assert set(sources.files) == {"main.st", "plant/inputs.csv"}


def test_a_file_that_is_no_run(program: str, tmp_path: Path) -> None:
    file = tmp_path / "a.scanrun"
    for content in (b"", b"something else", b"\0" * 5000):
        file.write_bytes(content)
        refused = call("replay", str(file))
        assert refused.exit_code == 2
        assert "a.scanrun" in refused.output
    assert call("replay", str(tmp_path / "none.scanrun")).exit_code == 2
    run(program, "--scans", "3000", "--set", "Main.n=5@7", "--record", str(tmp_path / "b.scanrun"))
    whole = (tmp_path / "b.scanrun").read_bytes()
    file.write_bytes(whole[:-20])
    torn = call("replay", str(file))
    assert torn.exit_code == 4, "it may have been cut off"
    assert "its last write did not come to its end, or the file was cut off" in torn.output
    assert "what is left of it is the same" in torn.output


def test_a_damaged_run_says_what_is_lost(program: str, tmp_path: Path) -> None:
    file = tmp_path / "a.scanrun"
    run(
        program,
        "--scans",
        "3000",
        "--set",
        "Main.n=5@7",
        "--set",
        "Main.n=9@20",
        "--set",
        "Main.n=1@30",
        "--record",
        str(file),
    )
    whole = file.read_bytes()
    opened = runfile.RunFile.open(file, read_only=True)
    hit = [each for each in opened.scan_blocks() if each.kind is runfile.Kind.ENTRY][1]
    opened.close()
    at = hit.offset + 40
    file.write_bytes(whole[:at] + bytes([whole[at] ^ 4]) + whole[at + 1 :])
    replayed = call("replay", str(file))
    assert replayed.exit_code == 4, replayed.output
    assert "all the same" not in replayed.output
    for command in (
        ("replay", str(file)),
        ("verify", str(file)),
        ("diff", str(file), str(file.with_name("b.scanrun"))),
    ):
        file.with_name("b.scanrun").write_bytes(file.read_bytes())
        result = call(*command)
        assert result.exit_code == 4, result.output
        assert f"is damaged at byte {hit.offset}" in result.output
        assert "Scans 7 to 2999 are lost" in result.output
    differ = call("diff", str(file), str(file.with_name("b.scanrun")))
    assert "The same in all 7 scans that could be compared, 0 to 6. Not all was compared: the run file" in differ.output
    file.write_bytes(whole[:20] + b"?" + whole[21:])  # what it is about: there is a second one
    replayed = call("replay", str(file))
    assert replayed.exit_code == 4, replayed.output
    assert "what is left of it is the same" in replayed.output
    assert "No scan is lost: all that was entered is there" in replayed.output
    file.write_bytes(whole[:20] + bytes(len(whole) - 20))
    for command in (
        ("replay", str(file)),
        ("verify", str(file)),
        ("diff", str(file), str(file.with_name("b.scanrun"))),
    ):
        assert call(*command).exit_code == 4, command


def test_a_gap_is_shown_and_nothing_is_said_of_it(program: str, tmp_path: Path) -> None:
    """Scans of which commands are lost are passed over: what comes after them is compared again."""
    file, other = tmp_path / "a.scanrun", tmp_path / "b.scanrun"
    timeline_with_states(program, file)
    whole = file.read_bytes()
    other.write_bytes(whole)
    opened = runfile.RunFile.open(file, read_only=True)
    hit = [each for each in opened.scan_blocks() if each.kind is runfile.Kind.ENTRY][1]
    opened.close()
    at = hit.offset + 40
    file.write_bytes(whole[:at] + bytes([whole[at] ^ 4]) + whole[at + 1 :])
    replayed = call("replay", str(file))
    assert replayed.exit_code == 4, replayed.output
    assert "lost  scans 10 to 19" in replayed.output
    assert "the same" in replayed.output
    assert "all the same" not in replayed.output
    verified = call("verify", str(file))
    assert verified.exit_code == 4, verified.output
    assert (
        "scans 0 to 59, 50 compared, 10 not compared (10 to 19): no difference in what was compared" in verified.output
    )
    report = tmp_path / "diff.xml"
    differ = call("diff", str(file), str(other), "--junit", str(report))
    assert differ.exit_code == 4, differ.output
    assert "The same in all 50 scans that could be compared, 0 to 59. Not all was compared" in differ.output
    assert "Not compared:\n  scans 10 to 19 are lost" in differ.output
    same, whole_run = parse(report).getroot().iter("testcase")
    assert [each.tag for each in same][:1] == ["skipped"], "the same is more than was looked at"
    assert [each.tag for each in whole_run][:1] == ["error"]
    told = json.loads(call("diff", "--json", str(file), str(other)).stdout)
    assert (told["same"], told["compared"]) == ("partly", 50)


def timeline_with_states(program: str, file: Path) -> None:
    """A run of 60 scans, with a command every tenth scan from 5 on, and a state every tenth from 0 on."""
    sources = Sources("CJ1M-CPU63", {"main.st": Path(program).read_text("utf-8")}, 10_000_000, 1)
    loaded = Loaded.make(checked_program(sources, find_model_named("CJ1M-CPU63")), ReferenceEngine, 1)
    timeline = Timeline.begin(file, LoadedPrograms(loaded), 1, pack_body(sources), ENTRIES, "Ada")
    for scan in range(60):
        if scan % 10 == 0:
            timeline.recording.checkpoint(scan, 1, timeline.resource.state)
        if scan % 10 == 5:
            assert isinstance(timeline.submit(Write("Ada", "Main.n", str(scan))), Entry)
        timeline.run(1)
    timeline.close()


def test_a_length_that_is_wrong_is_no_torn_end(program: str, tmp_path: Path) -> None:
    file = tmp_path / "a.scanrun"
    run(program, "--scans", "30", "--set", "Main.n=5@7", "--record", str(file))
    opened = runfile.RunFile.open(file, read_only=True)
    last = [each for each in opened.scan_blocks() if each.kind is runfile.Kind.ENTRY][-1]
    opened.close()
    data = bytearray(file.read_bytes()[: last.end])
    data[last.offset + 10] ^= 1  # of its length, 65,536 bytes more
    file.write_bytes(data)
    assert call("replay", str(file)).exit_code == 4


def test_a_run_ends_when_its_condition_holds(program: str, tmp_path: Path) -> None:
    ran = run(program, "--scans", "1000", "--until", "Main.n >= 5 AND NOT (Main.n = 6)", "--print", "Main.n", "--json")
    assert ran.exit_code == 0, ran.output
    assert json.loads(ran.stdout)["scans"] == 5
    never = run(program, "--scans", "10", "--until", "Main.n < 0")
    assert never.exit_code == 2
    assert "it was not so that Main.n < 0" in never.output
    report = tmp_path / "unvalued.xml"
    never = run(program, "--scans", "10", "--until", "10 / (Main.n - 3) = 99", "--junit", str(report))
    assert never.exit_code == 2
    assert "after scan 2 `10 / (Main.n - 3) = 99` has no value (an index is outside, a divisor is 0" in never.output
    assert "after scan 2 `10 / (Main.n - 3) = 99` has no value" in report.read_text()
    met = run(program, "--scans", "10", "--until", "10 / (Main.n - 3) = 99 OR Main.n = 5", "--json")
    assert met.exit_code == 0
    assert "after scan 2 `10 / (Main.n - 3) = 99 OR Main.n = 5` has no value" in met.stderr
    assert [json.loads(met.stdout)[each] for each in ("scans", "until_unvalued")] == [5, 2]
    wrong = run(program, "--scans", "10", "--until", "Main.m > 0")
    assert wrong.exit_code == 2
    assert "no member `m`" in wrong.output


@pytest.mark.parametrize(("kind", "total", "kept"), [("warm", 15, 7), ("power", 15, 7), ("cold", 5, 7)])
def test_restarts(program: str, kind: str, total: int, kept: int) -> None:
    ran = run(
        program, "--scans", "15", "--restart", f"{kind}@10",
        "--print", "Main.n", "--print", "Main.total", "--print", "D100", "--json",
    )  # fmt: skip
    assert ran.exit_code == 0, ran.output
    assert json.loads(ran.stdout)["values"] == {"Main.n": 5, "Main.total": total, "D100": kept}


def test_wrong_modes_and_restarts(program: str) -> None:
    refused = run(program, "--scans", "5", "--mode", "FAST@2")
    assert refused.exit_code == 2
    assert "there are PROGRAM, MONITOR, RUN" in refused.output
    wrong = run(program, "--scans", "5", "--restart", "hot")
    assert wrong.exit_code == 2
    assert "cold, warm, power" in wrong.output


def test_of_a_run_that_fails_no_file_is_left(
    program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    record = tmp_path / "a.scanrun"
    arguments = ("run", program, "--model", "CJ1M-CPU63", "--scans", "50", "--record", str(record))
    write = runfile._write

    def full(after: int) -> Callable[[int, bytes, int], None]:
        def limited(fd: int, data: bytes, offset: int) -> None:
            if offset + len(data) > after:
                raise OSError(28, "No space left on device")
            write(fd, data, offset)

        return limited

    assert call(*arguments).exit_code == 0
    file = runfile.RunFile.open(record, read_only=True)
    blocks = list(file.scan_blocks())
    file.close()
    for after in (
        0,
        *(each.end - 1 for each in blocks[:3]),
    ):  # the file, what it is about, the program, the first state
        record.unlink(missing_ok=True)
        monkeypatch.setattr(runfile, "_write", full(after))
        failed = call(*arguments)
        assert failed.exit_code == 2
        assert "No space left" in failed.output
        assert not record.exists()
    begun = [number for number, each in enumerate(blocks) if each.kind is runfile.Kind.PROGRAM][1]
    # the next file may be some bytes longer or shorter: the time in it is packed
    monkeypatch.setattr(runfile, "_write", full((blocks[begun].end + blocks[begun + 1].end) // 2))
    failed = call(*arguments)
    assert failed.exit_code == 2
    assert "could not be recorded whole" in failed.output
    assert not record.exists()


def test_a_replay_says_whose_run_it_was(program: str, tmp_path: Path) -> None:
    record = str(tmp_path / "a.scanrun")
    assert call("run", program, "--model", "CJ1M-CPU63", "--scans", "50", "--record", record).exit_code == 0
    assert json.loads(call("replay", record, "--json").stdout)["by"] == "command line"
    assert "begun by command line, 20" in call("replay", record).stdout
