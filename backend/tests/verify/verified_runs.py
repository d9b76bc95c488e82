"""Runs to be verified."""

from collections.abc import Callable, Sequence
from pathlib import Path

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.fingerprints import program_digest
from scanbench.recording.headless import HeadlessRun, run_headless
from scanbench.recording.programs import Make, programs_of, reference
from scanbench.recording.reader import RunReader
from scanbench.recording.recording import Recording
from scanbench.runtime.agenda import Agenda
from scanbench.runtime.command import Command
from scanbench.runtime.detect import Detect
from scanbench.runtime.programs import EngineFactory, Programs
from scanbench.verify.contract import DEFAULT_LIMIT, Mismatch, Row
from scanbench.verify.ranges import parse_range
from scanbench.verify.run_subject import RunSubject
from scanbench.verify.verifier import Verifier
from scanbench.wire.codec import ENTRIES


def record(
    path: Path, program: Program, scans: int, commands: Sequence[tuple[int, Command]] = (), *,
    engine: EngineFactory = ReferenceEngine, agenda: Agenda | None = None, programs: Programs | None = None,
    more: Sequence[tuple[int, Program]] = (), detect: Detect | None = None,
) -> Path:  # fmt: skip
    """A run file; a run-time error ends it."""
    with Recording.begin(path, program, 1, b"1", ENTRIES, "Ada") as recording:
        for version, each in more:
            recording.program(version, str(version).encode(), program_digest(each))
        result: HeadlessRun[None] = run_headless(
            program, scans, engine, commands, agenda=agenda, recording=recording, programs=programs, detect=detect
        )
        assert not result.refused, result.refused
    return path


def verifier(
    path: Path, program: Program, range: str = "", *, make: Make = reference, limit: int = DEFAULT_LIMIT,
    others: dict[int, Program] | None = None,
) -> Verifier:  # fmt: skip
    """Of a run of one program, or of these by version."""
    programs = {1: program, **(others or {})}
    made = opened(path, lambda kept: programs[kept.version], make)
    made.begin(parse_range(range), limit)
    return made


def opened(path: Path, program_of: Callable[[KeptProgram], Program], make: Make) -> Verifier:
    """Of a run file."""
    return Verifier(RunSubject(RunReader(path, programs_of(program_of, make), ENTRIES)))


def rows(verifier: Verifier) -> list[Row]:
    """Of all scans."""
    return [row for scan in range(verifier.first, verifier.end) for row in verifier.verify(scan).rows]


def differences(found: Sequence[Row]) -> list[Mismatch]:
    """All of them."""
    return [each for row in found for each in row.differences]
