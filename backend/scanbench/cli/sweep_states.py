"""The program states that `scanbench errors sweep --states FILE` begins from (docs/error-sweep.md): JSON -> points."""

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from scanbench.engines.observe import MakeObserved
from scanbench.faults.detect import Detection
from scanbench.faults.reaction.steps import Point
from scanbench.faults.schedule import Schedule
from scanbench.problems import perhaps
from scanbench.program.program import Program
from scanbench.recording.headless import HeadlessRun, run_headless
from scanbench.runtime.command import Command
from scanbench.testing.command_text import VERBS, read_command
from scanbench.testing.raising import BadCommand
from scanbench.testing.said import with_near

_RUN_KEYS, _FILE_KEYS = ("name", "scans", "do"), ("name", "run", "scan")
_DO = re.compile(r"\s*(\d+)\s*:\s*(.+)", re.DOTALL)
_SPOKEN = [verb for verb in VERBS if verb != "write"]
_HOW = 'write "SCAN: COMMAND", as in "10: Main.start=TRUE"'


class BadStates(Exception):
    """The file cannot be used; the message says where and why."""


@dataclass(frozen=True, slots=True)
class FromStart:
    """`scans` scans from a cold start, with commands on the way."""

    name: str
    scans: int = 100
    do: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class FromRun:
    """A moment of a recorded run; `scan` None is its end."""

    name: str
    run: str
    scan: int | None = None


State = FromStart | FromRun
START = FromStart("Start")
"""Where a sweep begins that nobody gave states."""


def while_present(error: str) -> FromStart:
    """The state of `--while`: as from the start, with this error present all the time."""
    return FromStart(f"{error} present", START.scans, (f"0: raise {error}",))


# ---- the file ------------------------------------------------------------------------------------------------------


def read_states(path: Path) -> list[State]:
    """The states of a file, checked as far as that is possible without a program."""
    try:
        told = json.loads(path.read_text("utf-8"))
    except OSError as error:
        raise BadStates(f"it cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise BadStates(f"it is no JSON: {error}") from error
    if not isinstance(told, list) or not told:
        raise BadStates('it has to be a list of states, as in [{"name": "Running", "scans": 100}]')
    states: list[State] = []
    for number, each in enumerate(told, 1):
        state = _read_state(number, each)
        if any(state.name == other.name for other in states):
            raise BadStates(f"state {number}: there are two states {state.name!r}; give each a name of its own")
        states.append(state)
    return states


def _read_state(number: int, told: object) -> State:
    where = f"state {number}"
    if not isinstance(told, dict):
        raise BadStates(f"{where} is {json.dumps(told)}; it has to be an object with a name")
    name = told.get("name")
    if not isinstance(name, str) or not name.strip():
        raise BadStates(f'{where} has no name; give it one, as in {{"name": "Running", ...}}')
    where += f" ({name})"
    known = _FILE_KEYS if "run" in told else _RUN_KEYS
    for key in told:
        if key not in known:
            near = get_close_matches(key, known, 1)
            hint = f".{perhaps(near)}" if near else f"; there are {', '.join(known)}"
            raise BadStates(f"{where} has {key!r}, which is nothing here{hint}")
    if "run" in told:
        run = told["run"]
        if not isinstance(run, str) or not run:
            raise BadStates(f"{where}: `run` has to be the name of a run file, not {json.dumps(run)}")
        return FromRun(name, run, _number(where, told, "scan") if told.get("scan") is not None else None)
    do = told.get("do", [])
    if not isinstance(do, list) or not all(isinstance(each, str) for each in do):
        raise BadStates(f"{where}: `do` has to be a list of texts; {_HOW}")
    scans = _number(where, told, "scans") if "scans" in told else START.scans
    return FromStart(name, scans, tuple(do))


def _number(where: str, told: Mapping[str, object], key: str) -> int:
    value = told[key]
    if not isinstance(value, int) or isinstance(value, bool) or value < 0:
        raise BadStates(f"{where}: `{key}` has to be a number of scans from 0 on, not {json.dumps(value)}")
    return value


# ---- states of a program ---------------------------------------------------------------------------------------------


def run_state(state: FromStart, program: Program, make: MakeObserved, version: int) -> Point:
    """Runs from a cold start to the state."""
    where = f"state {state.name}"
    commands = [_command(where, program, text) for text in state.do]
    for (scan, _), text in zip(commands, state.do, strict=True):
        if scan > state.scans:
            raise BadStates(f"{where}: `{text}` comes after its {state.scans} scans: give it more scans")
    result: HeadlessRun[None] = run_headless(
        program, state.scans, lambda each, memory: make(each, memory)[0], commands, detect=Detection(),
        agenda=Schedule(make),
    )  # fmt: skip
    for refused in result.refused:
        why = with_near(refused.refusal.message, refused.refusal.near)
        raise BadStates(f"{where}: refused before scan {refused.scan}: {why}")
    if result.resource.trap is not None:
        raise BadStates(f"{where}: the program trapped on the way: {result.resource.trap}")
    if not result.resource.runnable:
        raise BadStates(f"{where}: the program does not run there, so it cannot react: end in MONITOR or RUN")
    return Point(version, result.resource.state, result.resource.journal)


def _command(where: str, program: Program, text: str) -> tuple[int, Command]:
    match = _DO.fullmatch(text)
    if match is None:
        raise BadStates(f"{where}: `{text}` cannot be read; {_HOW}")
    at, body = int(match.group(1)), match.group(2).strip()
    verb, _, rest = body.partition(" ")
    named = verb.lower() in _SPOKEN and rest.strip() and not rest.lstrip().startswith("=")
    if not named and "=" not in body:
        raise BadStates(f"{where}: `{text}`: write PATH=VALUE, or one of {', '.join(_SPOKEN)} and what for")
    try:
        return at, read_command(program, verb.lower(), rest.strip()) if named else read_command(program, "write", body)
    except BadCommand as error:
        raise BadStates(f"{where}: `{text}`: {error}") from error
