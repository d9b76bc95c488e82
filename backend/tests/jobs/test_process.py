"""The job process, as a process: reactions in runs that others write, sweeps, and bad questions."""

import io
import os
import select
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.debug import Listen
from scanbench.engines.engine import Reason
from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.detect import Detection
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reaction.reaction import Reaction
from scanbench.host.zygote import JOB
from scanbench.jobs import process as job_process
from scanbench.jobs import starting
from scanbench.jobs.starting import reaction_in
from scanbench.program.program import Program
from scanbench.recording.blocks import Codec
from scanbench.recording.reader import Unreadable
from scanbench.recording.recording import Recording
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.inside import HaltAt
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import Loaded, LoadedPrograms, NoProgram
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES, Splitter, pack, pack_body, unpack
from scanbench.wire.host import Sources
from scanbench.wire.jobs import (
    CellFound,
    FindReaction,
    JobDone,
    JobRefused,
    Reacted,
    RunSweep,
    StartPoint,
    SweepPlanned,
    Trying,
)
from tests.amounts import slow
from tests.faults.reacting import MAKES, ref
from tests.runtime.bench import model

MODEL = "CJ1M-CPU63"
SOURCE = """PROGRAM Main
VAR basic AT A402.12 : BOOL; lamp AT CIO 100.00 : BOOL; on : BOOL; n : DINT; END_VAR
  n := n + 1;
  IF on THEN lamp := basic; END_IF;
END_PROGRAM
"""
FORGOT = SOURCE.replace("lamp := basic", "lamp := FALSE").replace("n : DINT", "more : INT; n : DINT")


class Job:
    """A job process."""

    def __init__(self, cache: Path) -> None:
        self._sock, theirs = socket.socketpair()
        with theirs:
            fd = theirs.fileno()
            command = [sys.executable, "-m", "scanbench.host", str(fd), JOB, str(cache)]
            self.process = subprocess.Popen(command, pass_fds=(fd,))
        self._answers = self._sock.makefile("rb")

    def ask(self, message: object) -> None:
        self._sock.sendall(pack(message))

    def answer(self) -> object:
        """The next one that tells something."""
        while isinstance(found := self._message(), Trying):
            pass
        return found

    def _message(self) -> object:
        head = self._answers.read(4)
        assert len(head) == 4, "the process ended"
        return unpack(self._answers.read(struct.unpack("<I", head)[0]))

    def end(self) -> int:
        self._sock.shutdown(socket.SHUT_WR)
        self._answers.close()
        self._sock.close()
        return self.process.wait(30)


@pytest.fixture(scope="module")
def job(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Job]:
    """One process for all of them, as the server has: each question is answered as if it were the first."""
    made = Job(tmp_path_factory.mktemp("jobs") / "cache")
    yield made
    assert made.end() == 0


def sources(text: str = SOURCE, version: int = 1) -> Sources:
    return Sources(MODEL, {"main.st": text}, 10_000_000, version)


def loaded(of: Sources) -> Loaded:
    checked = check_sources(of.files, model(of.model), of.interval_ns)
    assert checked.program is not None, checked.problems
    return Loaded.make(checked.program, NativeEngine, of.version)


def program_of(wanted: Sources) -> Program:
    return loaded(wanted).program


def begun(path: Path, *versions: Sources) -> Timeline:
    """A live run on the first of these programs."""
    every = versions or (sources(),)
    programs = LoadedPrograms(*map(loaded, every))
    return Timeline.begin(path, programs, every[0].version, pack_body(every[0]), ENTRIES, "Ada", Detection())


def enter(timeline: Timeline, command: Command) -> Entry:
    entry = timeline.submit(command)
    assert isinstance(entry, Entry), entry
    return entry


def advance(timeline: Timeline, scans: int) -> None:
    end = timeline.live_scan + scans
    while timeline.live_scan < end and timeline.resource.runnable:
        timeline.run(end - timeline.live_scan)


def raised(path: Path) -> tuple[Timeline, Entry]:
    """A live run in which the lamp handler is on, and an error was raised."""
    timeline = begun(path)
    advance(timeline, 500)
    enter(timeline, Write("Ada", "Main.on", "TRUE"))
    advance(timeline, 777)
    entry = enter(timeline, Generate("Ada", (ref("basic-io-error"),)))
    advance(timeline, 300)
    timeline.note()
    return timeline, entry


def test_a_reaction_in_a_run_that_goes_on(job: Job, tmp_path: Path) -> None:
    timeline, entry = raised(tmp_path / "1.run")
    size = (tmp_path / "1.run").stat().st_size
    job.ask(FindReaction(7, str(tmp_path / "1.run"), "basic-io-error", entry.scan, entry.scan + 200, 200))
    answer = job.answer()
    assert isinstance(answer, Reacted)
    assert answer.ref == 7
    found = answer.reaction
    assert (found.verdict, found.window, found.first_effect) == ("acted", 200, 1)
    assert [(each.file, each.line) for each in found.readers] == [("main.st", 4)]
    assert [each.path for each in found.differences] == ["Main.lamp"]
    assert (tmp_path / "1.run").stat().st_size == size
    advance(timeline, 100)  # nobody was in its way
    enter(timeline, Recover("Ada", None))
    again = enter(timeline, Generate("Ada", (ref("battery-error"),)))
    advance(timeline, 50)
    timeline.note()
    job.ask(FindReaction(8, str(tmp_path / "1.run"), "battery-error", again.scan, again.scan + 50, 200))
    assert job.answer() == Reacted(8, Reaction("never_read", 50, basis="exact"))
    timeline.close()


def test_a_reaction_before_which_the_program_changed(job: Job, tmp_path: Path) -> None:
    timeline = begun(tmp_path / "1.run", sources(FORGOT, 1), sources(SOURCE, 2))
    advance(timeline, 10)
    assert timeline.add_program(2, pack_body(sources(SOURCE, 2))) is None
    enter(timeline, Write("Ada", "Main.on", "TRUE"))
    enter(timeline, ProgramChange("Ada", 2))
    advance(timeline, 10)
    entry = enter(timeline, Generate("Ada", (ref("basic-io-error"), ref("battery-error"))))
    advance(timeline, 30)
    for error, verdict in (("basic-io-error", "acted"), ("battery-error", "never_read")):
        job.ask(FindReaction(1, str(tmp_path / "1.run"), error, entry.scan, entry.scan + 30, 200))
        answer = job.answer()
        assert isinstance(answer, Reacted), answer
        assert (answer.reaction.verdict, answer.reaction.window) == (verdict, 30)
    timeline.close()


@pytest.mark.parametrize("content", [None, b"", b"no run at all", b"scanbench run\n\1\0" + bytes(100)])
def test_a_bad_file_is_told_in_words(job: Job, tmp_path: Path, content: bytes | None) -> None:
    path = tmp_path / "bad.run"
    if content is not None:
        path.write_bytes(content)
    job.ask(FindReaction(1, str(path), "battery-error", 10, 20, 10))
    answer = job.answer()
    assert isinstance(answer, JobRefused)
    assert answer.message.startswith("bad.run ")
    job.ask(RunSweep(2, sources(), (StartPoint("A", str(path)),), ("battery-error",), 10, ()))
    done = job.answer()
    assert isinstance(done, JobRefused)
    assert done.message.startswith("the state A cannot be used: bad.run ")


def test_an_error_that_is_not_there(job: Job, tmp_path: Path) -> None:
    timeline, entry = raised(tmp_path / "1.run")
    for error, scan in (("battery-error", entry.scan), ("basic-io-error", entry.scan - 1), ("basic-io-error", 10**6)):
        job.ask(FindReaction(1, str(tmp_path / "1.run"), error, scan, scan + 5, 5))
        answer = job.answer()
        assert isinstance(answer, JobRefused)
        assert answer.message == f"1.run does not have any more how {error} was raised before scan {scan}"
    timeline.close()


def test_a_file_that_is_replaced_while_it_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As the PLC does when its file is over its bounds: what was read first may lack what came meanwhile."""
    before, path = tmp_path / "before.run", tmp_path / "1.run"
    timeline = begun(before)
    advance(timeline, 10)
    timeline.close()
    timeline, entry = raised(tmp_path / "after.run")
    timeline.close()
    before.replace(path)
    opened = Recording.open

    def replaced(path: Path, codec: Codec, read_only: bool) -> Recording:
        recording = opened(path, codec, read_only=read_only)
        if (path.parent / "after.run").exists():
            (path.parent / "after.run").replace(path)
        return recording

    monkeypatch.setattr(Recording, "open", replaced)

    found = reaction_in(path, "basic-io-error", entry.scan, entry.scan + 20, 200, program_of, MAKES["native"])
    assert (found.verdict, found.window) == ("acted", 20)
    with pytest.raises(Unreadable, match="does not have any more"):
        reaction_in(path, "basic-io-error", entry.scan + 1, entry.scan + 20, 200, program_of, MAKES["native"])


def test_only_a_file_that_was_replaced_is_read_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    timeline, entry = raised(tmp_path / "1.run")
    timeline.close()
    opened, times = Recording.open, []

    def counted(path: Path, codec: Codec, read_only: bool) -> Recording:
        times.append(path)
        return opened(path, codec, read_only=read_only)

    monkeypatch.setattr(Recording, "open", counted)
    with pytest.raises(Unreadable, match="does not have any more"):
        reaction_in(
            tmp_path / "1.run", "basic-io-error", entry.scan + 1, entry.scan + 20, 200, program_of, MAKES["native"]
        )
    assert len(times) == 1


@pytest.mark.parametrize(
    "error", [KeyError(3), IndexError("list index out of range"), ValueError("x"), NotImplementedError()]
)
def test_a_fault_of_our_own_is_logged_and_told_as_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, error: Exception
) -> None:
    """It was "3", as if a KeyError were the reason why the file cannot be used."""
    timeline, entry = raised(tmp_path / "1.run")
    timeline.close()

    def broken(*_: object) -> None:
        raise error

    monkeypatch.setattr(starting, "react", broken)
    monkeypatch.setattr(job_process, "sweep_side_by_side", broken)
    answers = io.BytesIO()
    process = job_process.Job(None, answers)
    process.on_request(FindReaction(1, str(tmp_path / "1.run"), "basic-io-error", entry.scan, entry.scan + 20, 20))
    point = StartPoint("A", str(tmp_path / "1.run"))
    process.on_request(RunSweep(2, sources(), (point,), ("battery-error",), 10, ()))
    reacted, _, done = Splitter().feed(answers.getvalue())
    assert isinstance(reacted, JobRefused)
    assert isinstance(done, JobRefused)
    assert (reacted.ref, done.ref) == (1, 2)
    for told in (reacted.message, done.message):
        assert told.startswith(f"it failed, which is a fault of Scanbench ({type(error).__name__}: ")
    traces = [record.exc_info[1] for record in caplog.records if record.exc_info is not None]
    assert traces == [error, error]


def test_why_there_is_no_program_is_told_and_a_fault_in_its_build_is_none_of_these(tmp_path: Path) -> None:
    timeline, entry = raised(tmp_path / "1.run")
    timeline.close()
    asked = (tmp_path / "1.run", "basic-io-error", entry.scan, entry.scan + 20, 200)

    def failing(error: Exception) -> Callable[[Sources], Program]:
        def build(wanted: Sources) -> Program:
            raise error

        return build

    with pytest.raises(Unreadable, match="is wrong"):
        reaction_in(*asked, failing(NoProgram("main.st:2 is wrong")), MAKES["native"])
    with pytest.raises(KeyError):
        reaction_in(*asked, failing(KeyError(3)), MAKES["native"])


@slow
def test_a_sweep_over_states(job: Job, tmp_path: Path) -> None:
    """One with the program that is swept, one of an older version, carried over as an online change does."""
    new = begun(tmp_path / "new.run")
    advance(new, 20)
    enter(new, Write("Ada", "Main.on", "TRUE"))
    advance(new, 5)
    new.close()
    old = begun(tmp_path / "old.run", sources(FORGOT, 4))
    advance(old, 33)
    enter(old, Write("Ada", "Main.on", "TRUE"))
    enter(old, SetMode("Ada", "RUN"))
    advance(old, 3)
    old.close()
    points = (StartPoint("New", str(tmp_path / "new.run")), StartPoint("Old", str(tmp_path / "old.run")))
    errors = ("basic-io-error", "battery-error", "memory-error")
    job.ask(RunSweep(3, sources(SOURCE, 9), points, errors, 40, (("battery-error", "Old"),)))
    assert job.answer() == SweepPlanned(3, errors)
    cells = []
    while isinstance(answer := job.answer(), CellFound):
        cells.append(answer)
    assert answer == JobDone(3)
    assert [(each.error, each.point, each.scan) for each in cells] == [
        ("basic-io-error", "New", 25), ("basic-io-error", "Old", 36), ("battery-error", "New", 25),
        ("memory-error", "New", 25), ("memory-error", "Old", 36),
    ]  # fmt: skip
    verdicts = [each.reaction.verdict for each in cells if each.reaction is not None]
    assert verdicts == ["acted", "acted", "never_read", "stopped", "stopped"]


def test_a_sweep_that_cannot_be(job: Job, tmp_path: Path) -> None:
    run = begun(tmp_path / "1.run")
    advance(run, 5)
    enter(run, SetMode("Ada", "PROGRAM"))
    run.close()
    point = (StartPoint("Off", str(tmp_path / "1.run")),)
    for of, words in (
        (sources(), "the state Off cannot be used: the program does not run there"),
        (sources("PROGRAM Main\n  x := 1;\nEND_PROGRAM\n"), "the program cannot be built: main.st:2"),
        (Sources("NO-SUCH", {}, 10_000_000, 1), "there is no model NO-SUCH"),
    ):
        job.ask(RunSweep(4, of, point, ("battery-error",), 10, ()))
        answer = job.answer()
        assert isinstance(answer, JobRefused)
        assert answer.message.startswith(words), answer.message


@slow
def test_it_ends_with_its_parent(tmp_path: Path) -> None:
    """Also while it computes."""
    timeline, _ = raised(tmp_path / "1.run")
    timeline.close()
    code = (
        "import os, socket, subprocess, sys\n"
        "ours, theirs = socket.socketpair()\n"
        "command = [sys.executable, '-m', 'scanbench.host', str(theirs.fileno()), 'scanbench.jobs.process:serve', sys.argv[1]]\n"
        "process = subprocess.Popen(command, pass_fds=(theirs.fileno(),))\n"
        "ours.sendall(sys.stdin.buffer.read())\n"
        "ours.recv(1)\n"
        "print(process.pid, flush=True)\n"
        "os.kill(os.getpid(), 9)\n"
    )
    errors = tuple(each.id for each in model(MODEL).errors() if each.severity == "nonfatal")
    ask = pack(RunSweep(1, sources(), (StartPoint("A", str(tmp_path / "1.run")),), errors, 100_000, ()))
    parent = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "cache")], input=ask, capture_output=True, timeout=120, check=False
    )
    assert parent.returncode == -signal.SIGKILL, parent.stderr
    pid = int(parent.stdout)
    try:
        handle = os.pidfd_open(pid)
    except ProcessLookupError:
        return
    poll = select.poll()
    poll.register(handle, select.POLLIN)
    ended = poll.poll(30_000)
    os.close(handle)
    assert ended


@slow
def test_what_a_debugger_entered_inside_of_scans_belongs_to_both_runs(job: Job, tmp_path: Path) -> None:
    timeline = begun(tmp_path / "1.run")
    advance(timeline, 20)
    entry = enter(timeline, Generate("Ada", (ref("basic-io-error"),)))
    advance(timeline, 5)
    inside(timeline, 2, Write("Ada", "Main.on", "TRUE"))
    advance(timeline, 10)
    inside(timeline, 1, Write("Ada", "Main.n", "500"))
    advance(timeline, 20)
    timeline.note()
    job.ask(FindReaction(1, str(tmp_path / "1.run"), "basic-io-error", entry.scan, entry.scan + 30, 200))
    answer = job.answer()
    assert isinstance(answer, Reacted), answer
    found = answer.reaction
    assert (found.verdict, found.first_effect) == ("acted", 6), "it is read once the lamp handler is on"
    assert [each.path for each in found.differences] == ["Main.lamp"]
    begin = StartPoint("here", str(tmp_path / "1.run"))
    job.ask(RunSweep(2, sources(), (begin,), ("battery-error",), 10, ()))
    assert job.answer() == SweepPlanned(2, ("battery-error",))
    cell = job.answer()
    assert isinstance(cell, CellFound), cell
    assert cell.reaction is not None, cell.note
    assert cell.reaction.verdict == "never_read"
    assert job.answer() == JobDone(2)
    timeline.close()


def inside(timeline: Timeline, count: int, command: Command) -> None:
    """Enters a command before the statement with this count in the next scan."""
    resource = timeline.resource
    resource.listening.attach(HaltAt(count), Listen(count=count))
    while timeline.run(1).reason is not Reason.HALTED:
        pass
    resource.listening.attach(None)
    assert enter(timeline, command).step == count
