"""Options of `scanbench run` -> commands for the seam, and the variables to print."""

from dataclasses import astuple, dataclass

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.cli.inputs import usage
from scanbench.program.program import Program
from scanbench.runtime.command import Command
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.syntax.literals import duration
from scanbench.testing.command_text import before_scan, read_command
from scanbench.testing.raising import BadCommand
from scanbench.testing.said import with_near


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


def read_commands(program: Program, options: Options, scans: int) -> list[tuple[int, Command]]:
    """(scan, command) in the order of the scans; for one scan: sets, forces, errors raised, errors cleared. What comes after all
    of `scans` would never be applied, and is refused."""
    verbs = {
        "--set": "write",
        "--force": "force",
        "--raise": "raise",
        "--clear": "clear",
        "--mode": "mode",
        "--restart": "restart",
    }
    made: list[tuple[int, Command]] = []
    for (option, verb), texts in zip(verbs.items(), astuple(options), strict=True):
        for text in texts:
            body, scan = before_scan(text)
            if scan > scans:
                usage(f"{option} {text}: there are only {scans:,} scans, from 0, so it would never be applied")
            try:
                made.append((scan, read_command(program, verb, body)))
            except BadCommand as error:
                usage(f"{option} {text}: {error}")
    return made


def read_condition(program: Program, text: str) -> Condition:
    """The condition of --until."""
    condition = compile_condition(program, text)
    if not isinstance(condition, Condition):
        usage(f"--until {text}: {with_near(condition.message, condition.near)}")
    return condition


def find_symbol(program: Program, path: str) -> Symbol:
    try:
        return resolve(program, path)
    except UnknownPath as error:
        usage(with_near(error.message, error.near))
