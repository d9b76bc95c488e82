"""The job process: reactions, sweeps, records of earlier scans, verifications, questions about the past; so that neither the server nor a PLC has to wait for them.

Forked from the zygote; see `wire/jobs.py`. Whatever goes wrong with a request is told in its answer.
"""

import logging
import os
import select
import signal
import socket
from collections import deque
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import BinaryIO, TypeVar

from scanbench.check import build as check
from scanbench.check.incremental import Checks
from scanbench.engines.available import flavours
from scanbench.engines.cache import BlobCache
from scanbench.engines.lifeline import end_with_parent
from scanbench.faults.raised_numbers import RaisedNumber, raised_numbers
from scanbench.faults.reaction.choices import Choices
from scanbench.faults.reaction.required_rules import problems_of, rules_of
from scanbench.faults.reaction.side_by_side import Died, cores, sweep_side_by_side
from scanbench.faults.reaction.steps import Point
from scanbench.faults.reference import ErrorRef, parse_reference
from scanbench.host.program_cache import keep, key_of, recall
from scanbench.host.run_files import programs_by
from scanbench.jobs import history as history_job
from scanbench.jobs import verification as verify_job
from scanbench.jobs.campaign import run_campaign
from scanbench.jobs.retrospective import record
from scanbench.jobs.starting import checked_program, model_of, point_in, reaction_in
from scanbench.jobs.whatif import run_what_if
from scanbench.plcmodel.user_errors import is_of_catalogue
from scanbench.problems import Problem, Severity
from scanbench.program.program import Program
from scanbench.recording.format import RunFileError
from scanbench.recording.programs import cached, observed, on
from scanbench.recording.reader import Unreadable
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Refusal
from scanbench.runtime.header import Header
from scanbench.runtime.programs import NoProgram
from scanbench.syntax.requirements import is_requirements
from scanbench.wire.campaigns import RunCampaign
from scanbench.wire.codec import BadMessage, Splitter, pack
from scanbench.wire.events import CheckOutcome
from scanbench.wire.host import Sources
from scanbench.wire.jobs import (
    CellFound,
    Check,
    Checked,
    FindReaction,
    JobDone,
    JobRefused,
    KeepProgram,
    Reacted,
    RunSweep,
    SweepPlanned,
    Trying,
)
from scanbench.wire.refused import Refused
from scanbench.wire.traces import RecordRetrospective, RetrospectiveAt
from scanbench.wire.verification import CompareRuns, FindChanges, FindWriter, MakeScenario, PastAt, RerunRun
from scanbench.wire.whatif import RunWhatIf

log = logging.getLogger("scanbench")
X = TypeVar("X")
Y = TypeVar("Y")
_NICENESS = 10
_TELL_EVERY_NS = 250_000_000
_PROGRAMS = 4
"""Checked programs that stay in memory."""
Request = (
    FindReaction
    | RunSweep
    | RecordRetrospective
    | Check
    | RunCampaign
    | RunWhatIf
    | verify_job.Request
    | history_job.Request
)
_REFUSALS = (Unreadable, NoProgram, RunFileError, Died, OSError)


class Job:
    """Answers requests, one after the other."""

    def __init__(self, cache: Path | None, answers: BinaryIO, asked: Callable[[], bool] = lambda: False) -> None:
        """`asked`: whether a further request waits."""
        self._cache = BlobCache(cache) if cache is not None else None
        self._asked = asked
        self._verify: verify_job.VerifyJob | None = None
        self._past: history_job.HistoryJob | None = None
        self._answers = answers
        self._flavours = flavours(self._cache)
        self._checks = Checks(limit=4)
        """What was checked last."""
        self._programs: dict[str, Program] = {}

    def on_request(self, request: object) -> None:
        """Answers a request. Nothing that is wrong with it ends the process."""
        if isinstance(request, KeepProgram):
            try:
                self._keep(request.sources)
            except Exception:  # hosts check for themselves what is not kept
                log.exception("a program could not be kept")
            return
        if not isinstance(request, Request):
            raise BadMessage(f"{type(request).__name__} is no request to a job process")
        try:
            answer = self._answer(request)
        except Refused as why:
            answer = JobRefused(request.ref, why.message, why.near)
        except _REFUSALS as why:
            answer = JobRefused(request.ref, _words(why), getattr(why, "near", ()))
        except Exception as error:  # whatever it is, somebody waits for the answer
            answer = JobRefused(request.ref, _unexpected(error))
        self._say(answer)

    def _answer(self, request: Request) -> object:
        match request:
            case FindReaction():
                return self._reacted(request)
            case RunSweep():
                return self._swept(request)
            case Check():
                return self._checked(request)
            case RecordRetrospective():
                return record(
                    request, programs_by(self._program, on(self._flavours)), self._telling(RetrospectiveAt, request.ref)
                )
            case RunCampaign():
                programs = programs_by(self._program, on(self._flavours))
                return run_campaign(request, programs, self._flavours.observed, self._say)
            case RunWhatIf():
                programs = programs_by(self._program, on(self._flavours))
                return run_what_if(request, programs, self._flavours.observed, self._say)
            case FindWriter() | FindChanges() | CompareRuns() | RerunRun() | MakeScenario():
                if self._past is None:
                    self._past = history_job.HistoryJob(self._program, self._cache, self._flavours.observed)
                return self._past.answer(request, self._telling(PastAt, request.ref))
            case _:
                if self._verify is None:
                    self._verify = verify_job.VerifyJob(self._program, self._cache, self._say, self._asked)
                return self._verify.answer(request)

    def _checked(self, ask: Check) -> Checked:
        sources = ask.sources
        found = self._checks.diagnose(sources.files, model_of(sources), sources.interval_ns)
        required = self._required(sources, found)
        numbers = self._numbers(sources) if ask.numbers else None
        problems = (*found.problems, *required)
        return Checked(ask.ref, CheckOutcome(problems, found.pous, found.checks, numbers, found.tasks))

    def _numbers(self, sources: Sources) -> tuple[RaisedNumber, ...] | None:
        """Those that the program raises errors with, whatever is wrong with what is fitted."""
        files = {name: text for name, text in sources.files.items() if not is_of_catalogue(name)}
        program = self._checks.check(files, model_of(sources), sources.interval_ns).program
        return None if program is None else raised_numbers(program)

    def _required(self, sources: Sources, found: check.Checked) -> list[Problem]:
        """What is wrong with the requirements of a project; their names need the whole program."""
        if not any(map(is_requirements, sources.files)):
            return []
        program = found.program
        if program is None and all(each.severity is not Severity.ERROR for each in found.problems):
            program = self._checks.check(sources.files, model_of(sources), sources.interval_ns).program
        return problems_of(program, sources.files)

    def _keep(self, sources: Sources) -> None:
        """Writes the program from a copy of this process, so that the next check need not wait."""
        model = model_of(sources)
        program = self._checks.check(sources.files, model, sources.interval_ns).program
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # nobody asks how the copy ended
        if program is None or self._cache is None or os.fork():
            return
        try:
            most = os.sysconf("SC_OPEN_MAX")
            os.closerange(
                3, most if most > 0 else 1 << 20
            )  # what is said is not its own: it must not hold the link open
            os.nice(_NICENESS)
            keep(self._cache, key_of(sources, model), program)
        finally:
            os._exit(0)

    def _reacted(self, ask: FindReaction) -> Reacted:
        found = reaction_in(
            Path(ask.run), ask.error, ask.scan, ask.end, ask.window, self._program, self._flavours.observed
        )
        return Reacted(ask.ref, found)

    def _swept(self, ask: RunSweep) -> JobDone:
        for cell in self._cells(ask):
            self._say(cell)
        return JobDone(ask.ref)

    def _cells(self, ask: RunSweep) -> Iterator[CellFound]:
        program = self._program(ask.sources)
        asked = [parse_reference(program.layout.model, each) for each in ask.errors]
        for each in asked:
            if isinstance(each, Refusal):
                raise Refused(each.message, each.near)
        rules = rules_of(program, ask.sources.files)
        refs = [each for each in asked if isinstance(each, ErrorRef)]
        errors = rules.raised(Choices(program).expand(refs), {each.id for each in refs})
        points = {each.name: self._point(each.name, Path(each.run), ask.sources) for each in ask.points}
        scans = {name: Header(point.state).scan for name, point in points.items()}
        programs = cached({ask.sources.version: program}, observed(self._flavours.observed))
        self._say(SweepPlanned(ask.ref, tuple(map(str, errors)), tuple(rules.problems)))
        on_try = self._telling(Trying, ask.ref)
        cells = sweep_side_by_side(
            points, errors, ask.window, programs, _sweeping(), rules, set(ask.done), ask.known, on_try
        )
        for cell in cells:
            yield CellFound(ask.ref, cell.error, cell.point, scans[cell.point], cell.reaction, cell.note, cell.untried)

    def _point(self, name: str, run: Path, sources: Sources) -> Point:
        try:
            return point_in(run, None, sources, self._program, self._flavours.observed)
        except Unreadable as why:
            raise Unreadable(f"the state {name} cannot be used: {why}") from why

    def _program(self, sources: Sources) -> Program:
        """The checked program: from memory, from the disk, or checked now."""
        model = model_of(sources)
        key = key_of(sources, model)
        program = self._programs.pop(key, None)
        if program is None and self._cache is not None:
            program = recall(self._cache, key)
        if program is None:
            program = checked_program(sources, model)
        self._programs[key] = program  # the dict keeps the order of use: the last one used is last
        while len(self._programs) > _PROGRAMS:
            del self._programs[next(iter(self._programs))]
        return program

    def _telling(self, part: Callable[[int, X, Y], object], ref: int) -> Callable[[X, Y], None]:
        """Tells how far it is, a few times a second at most."""
        told = 0

        def tell(done: X, of: Y) -> None:
            nonlocal told
            if monotonic_ns() - told > _TELL_EVERY_NS:
                told = monotonic_ns()
                self._say(part(ref, done, of))

        return tell

    def _say(self, message: object) -> None:
        self._answers.write(pack(message))
        self._answers.flush()


def _sweeping() -> int:
    """So many processes try errors. All have the niceness of this one, so a PLC that wakes up for a scan takes its core from them at once:
    two of them do no harm to a PLC on two cores. Where there are more, one core stays free of them: niceness does not give back
    what they take of caches and memory."""
    return max(2, cores() - 1) if cores() > 1 else 1


def _words(why: Exception) -> str:
    return why.strerror or str(why) if isinstance(why, OSError) else str(why)


def _unexpected(error: Exception) -> str:
    log.exception("a job failed")
    if isinstance(error, MemoryError):
        return "it takes more memory than there is"
    return (
        f"it failed, which is a fault of Scanbench ({type(error).__name__}: {error}): the log of the server says more"
    )


def serve(sock: socket.socket, cache: Path | None, parent: int) -> int:
    """Answers on the socket until the process `parent` closes it, or is gone; the exit code."""
    os.nice(_NICENESS)
    return serve_checks(sock, cache, parent)


def serve_checks(sock: socket.socket, cache: Path | None, parent: int) -> int:
    """As `serve`, for what people wait for while they type: it gives way to nobody."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's business
    with sock:
        fd = sock.fileno()
        return _served(fd, os.fdopen(os.dup(fd), "wb"), cache, parent)


def _served(requests: int, answers: BinaryIO, cache: Path | None, parent: int) -> int:
    splitter, waiting, adopted = Splitter(), deque[object](), False

    def asked() -> bool:
        return bool(waiting) or bool(select.select([requests], [], [], 0)[0])

    job = Job(cache, answers, asked)
    try:
        while data := os.read(requests, 1 << 16):
            if not adopted:  # the parent has spoken, so it has adopted this process
                adopted = True
                end_with_parent(parent)
            waiting.extend(splitter.feed(data))
            while waiting:
                job.on_request(waiting.popleft())
    except BadMessage as error:
        log.error("a job process was asked what it does not understand: %s", error)
        return 1
    except (BrokenPipeError, ConnectionResetError):
        return 0
    return 0
