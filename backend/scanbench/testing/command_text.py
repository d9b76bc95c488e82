"""Commands as people type them, for options of `scanbench run` and `verify`, and for the states of a sweep: text -> command."""

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import get_args

from scanbench.faults.inject import Recover
from scanbench.faults.line_faults import LINE_NAMES, BreakLine, FaultKind, LineFault, LineKind, MendLine, lines_of
from scanbench.program.program import Program
from scanbench.runtime.command import Command, RestartKind
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.header import Mode
from scanbench.runtime.modes import SetMode
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import UnknownPath, resolve
from scanbench.symbols.values import parse_value
from scanbench.testing.raising import BadCommand, read_error, read_raise
from scanbench.testing.said import with_near

AUTHOR = "command line"
_AT = re.compile(r"(.*)@(\d+)\s*", re.DOTALL)


def before_scan(text: str) -> tuple[str, int]:
    """The command, and the scan before which it is applied: `start=TRUE@5`. Scan 0 where none is named."""
    match = _AT.fullmatch(text)
    return (match.group(1), int(match.group(2))) if match else (text, 0)


def read_command(program: Program, verb: str, text: str) -> Command:
    """The command of one of `VERBS`; `BadCommand`."""
    return VERBS[verb](program, text)


def _write(program: Program, text: str) -> Command:
    return Write(AUTHOR, *_assignment(program, text))


def _force(program: Program, text: str) -> Command:
    return Force(AUTHOR, *_assignment(program, text))


def _assignment(program: Program, text: str) -> tuple[str, str]:
    path, equals, value = text.partition("=")
    if not equals:
        raise BadCommand("write PATH=VALUE")
    try:
        symbol = resolve(program, path.removesuffix(":").strip())
    except UnknownPath as error:
        raise BadCommand(with_near(error.message, error.near)) from error
    try:
        parse_value(symbol.type, value.strip())
    except ValueError as error:
        raise BadCommand(str(error)) from error
    return symbol.path, value.strip()


def _release(program: Program, text: str) -> Command:
    try:
        return Release(AUTHOR, resolve(program, text).path)
    except UnknownPath as error:
        raise BadCommand(with_near(error.message, error.near)) from error


def _raise(program: Program, text: str) -> Command:
    return read_raise(program, AUTHOR, text)


def _clear(program: Program, text: str) -> Command:
    return Recover(AUTHOR, None if text.lower() == "all" else (str(read_error(program, text)),))


def _mode(_: Program, text: str) -> Command:
    if text.upper() not in Mode.__members__:
        raise BadCommand(f"there are {', '.join(Mode.__members__)}")
    return SetMode(AUTHOR, text.upper())


def _restart(_: Program, text: str) -> Command:
    kinds: dict[str, RestartKind] = {kind: kind for kind in get_args(RestartKind)}
    if text.lower() not in kinds:
        raise BadCommand(f"there are {', '.join(kinds)}")
    return Restart(AUTHOR, kinds[text.lower()])


_FAULT = re.compile(r"(?P<kind>[\w-]+)(?:\s+(?P<late>\d+))?(?:\s+for\s+(?P<scans>\d+)(?:\s+of\s+(?P<period>\d+))?)?")


def _break(program: Program, text: str) -> Command:
    server, equals, told = text.partition("=")
    found = _FAULT.fullmatch(told.strip())
    if not equals or found is None:
        raise BadCommand(
            "break SERVER=FAULT, as in break fins=cut, break modbus=late 500 (ms), break fins=silent for 20 (scans), or break fins=silent for 20 of 100"
        )
    known = {each.kind: each for each in map(LineFault, _FAULTS)}
    if found["kind"] not in known:
        raise BadCommand(f"there is no fault {found['kind']!r} of a line: they are {', '.join(known)}")
    fault = known[found["kind"]]
    late, scans, period = (int(found[each]) if found[each] else None for each in ("late", "scans", "period"))
    wanted = replace(fault, late_ms=fault.late_ms if late is None else late, scans=scans, period=period)
    return _possible(program, BreakLine(AUTHOR, _server(server), wanted))


def _mend(program: Program, text: str) -> Command:
    return _possible(program, MendLine(AUTHOR, _server(text)))


def _possible(program: Program, command: BreakLine | MendLine) -> Command:
    """`BadCommand` where the model does not speak that."""
    if command.server not in lines_of(program.layout.model):
        raise BadCommand(f"{program.layout.model.name} does not speak {LINE_NAMES[command.server]}")
    return command


def _server(text: str) -> LineKind:
    kinds: dict[str, LineKind] = {kind: kind for kind in get_args(LineKind)}
    if text.strip().lower() not in kinds:
        raise BadCommand(f"there is no line {text.strip()!r}: they are {', '.join(kinds)}")
    return kinds[text.strip().lower()]


_FAULTS: tuple[FaultKind, ...] = ("silent", "late", "cut", "refused", "node")
VERBS: Mapping[str, Callable[[Program, str], Command]] = {
    "write": _write, "force": _force, "release": _release, "raise": _raise, "clear": _clear, "mode": _mode,
    "restart": _restart, "break": _break, "mend": _mend,
}  # fmt: skip
