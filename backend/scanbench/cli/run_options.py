"""Options of `scanbench run` -> commands for the seam, and the variables to print."""

import re
from dataclasses import dataclass
from typing import get_args

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.cli.inputs import usage, with_near
from scanbench.cli.raising import read_raise
from scanbench.faults.inject import Recover
from scanbench.faults.reference import parse_reference
from scanbench.program.program import Program
from scanbench.runtime.command import Command, Refusal, RestartKind
from scanbench.runtime.forces import Force
from scanbench.runtime.modes import SetMode
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.syntax.literals import duration

AT = re.compile(r"(.*)@(\d+)", re.DOTALL)
AUTHOR = "command line"


@dataclass(frozen=True, slots=True)
class Options:
    """What was asked for, as typed."""

    set: list[str]
    force: list[str]
    generate: list[str]
    clear: list[str]
    mode: list[str]
    restart: list[str]


def read_interval(text: str) -> int:
    try:
        interval = duration(text.upper().removeprefix("T#").removeprefix("TIME#"))
    except ValueError as error:
        usage(f"--interval {text}: {error}")
    if interval < 1_000:
        usage(f"--interval {text}: a task runs at most every microsecond")
    return interval


def read_commands(program: Program, options: Options) -> list[tuple[int, Command]]:
    """(scan, command) in the order of the scans; for one scan: sets, forces, errors raised, errors cleared."""
    made: list[tuple[int, Command]] = []
    for text in options.set:
        path, value, scan = _assignment(program, "--set", text)
        made.append((scan, Write(AUTHOR, path, value)))
    for text in options.force:
        path, value, scan = _assignment(program, "--force", text)
        made.append((scan, Force(AUTHOR, path, value)))
    for text in options.generate:
        made.append(read_raise(program, AUTHOR, text))
    for text in options.clear:
        reference, scan = _at(text)
        if reference.lower() == "all":
            made.append((scan, Recover(AUTHOR, None)))
            continue
        error = parse_reference(program.layout.model, reference)
        if isinstance(error, Refusal):
            usage(f"--clear {text}: {error.message}")
        made.append((scan, Recover(AUTHOR, (error.id,))))
    for text in options.mode:
        wanted, scan = _at(text)
        made.append((scan, SetMode(AUTHOR, wanted.upper())))
    for text in options.restart:
        made.append(_restart(text))
    return made


def read_condition(program: Program, text: str) -> Condition:
    """The condition of --until."""
    condition = compile_condition(program, text)
    if not isinstance(condition, Condition):
        usage(f"--until {text}: {with_near(condition.message, condition.near)}")
    return condition


def _restart(text: str) -> tuple[int, Command]:
    wanted, scan = _at(text)
    kinds: dict[str, RestartKind] = {kind: kind for kind in get_args(RestartKind)}
    if wanted.lower() not in kinds:
        usage(f"--restart {text}: there are {', '.join(kinds)}")
    return scan, Restart(AUTHOR, kinds[wanted.lower()])


def _at(text: str) -> tuple[str, int]:
    match = AT.fullmatch(text)
    return (match.group(1), int(match.group(2))) if match else (text, 0)


def _assignment(program: Program, option: str, text: str) -> tuple[str, str, int]:
    body, scan = _at(text)
    path, equals, value = body.partition("=")
    if not equals:
        usage(f"{option} {text}: write PATH=VALUE, or PATH=VALUE@SCAN")
    return find_symbol(program, path.removesuffix(":").strip()).path, value.strip(), scan


def find_symbol(program: Program, path: str) -> Symbol:
    try:
        return resolve(program, path)
    except UnknownPath as error:
        usage(with_near(error.message, error.near))
