"""`scanbench run`: a program headless, on virtual time: the same call prints the same on every machine."""

import hashlib
import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

import typer

from scanbench.check.build import check_sources
from scanbench.check.program import Program
from scanbench.check.symbols import Symbol, UnknownPath, members, resolve
from scanbench.check.types import ArrayType, Record
from scanbench.check.values import format_value, python_value
from scanbench.cli.inputs import find_model, problem_json, read_sources, usage
from scanbench.engines.engine import Engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.pair import Differs, PairEngine
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import parse_reference
from scanbench.runtime.command import Command, Refusal
from scanbench.runtime.forces import Force
from scanbench.runtime.headless import HeadlessRun, run_headless
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.syntax.literals import duration

AT = re.compile(r"(.*)@(\d+)", re.DOTALL)
AUTHOR = "command line"
Json = bool | int | float | str | None | list["Json"] | dict[str, "Json"]


class EngineChoice(StrEnum):
    """Which engine runs the program."""

    NATIVE = "native"
    REFERENCE = "reference"
    BOTH = "both"


ENGINES: dict[EngineChoice, Callable[[Program, bytearray], Engine]] = {
    EngineChoice.NATIVE: NativeEngine,
    EngineChoice.REFERENCE: ReferenceEngine,
    EngineChoice.BOTH: PairEngine,
}


@dataclass(frozen=True, slots=True)
class Options:
    """What was asked for on the command line."""

    set: list[str]
    force: list[str]
    generate: list[str]
    clear: list[str]
    print: list[str]


def run(
    path: Path = typer.Argument(metavar="FILE|DIR", help="An ST file, or a folder with .st files."),
    scans: int = typer.Option(..., min=0, help="How many scans to run."),
    model: str | None = typer.Option(None, metavar="NAME", help="PLC model; else project.json's, else GENERIC-IEC."),
    interval: str = typer.Option("10ms", help="Task interval where no CONFIGURATION says another."),
    set: list[str] = typer.Option([], "--set", metavar="PATH=VALUE[@SCAN]", help="Write before a scan (0 if none is named)."),
    force: list[str] = typer.Option([], "--force", metavar="PATH=VALUE[@SCAN]", help="Force from a scan on."),
    generate: list[str] = typer.Option([], "--raise", metavar="ERROR[@SCAN]", help="Raise an error of the model, e.g. io-bus-error:rack=1,slot=3@5"),
    clear: list[str] = typer.Option([], "--clear", metavar="ERROR|all[@SCAN]", help="Recover an error."),
    show: list[str] = typer.Option([], "--print", metavar="PATH", help="Print this variable or address at the end."),
    every: int = typer.Option(0, min=0, metavar="K", help="Print the variables every K scans too."),
    engine: EngineChoice = typer.Option(EngineChoice.NATIVE, help="both: run both and compare whole images every scan."),
    hash: bool = typer.Option(False, "--hash", help="Print the SHA-256 of the image."),
    as_json: bool = typer.Option(False, "--json", help="Print one JSON object."),
) -> None:  # fmt: skip
    """Run a program. A command @SCAN is applied before that scan; scans count from 0.

    Exit 0 when it ran; 1: it does not compile; 2: wrong usage, or a command was refused; 3: the engines differ;
    4: the PLC trapped.
    """
    sources = read_sources([path])
    plc = find_model(model, sources)
    checked = check_sources(sources.texts, plc, _interval(interval))
    problems = [problem_json(problem) for problem in checked.problems]
    if checked.program is None:
        if as_json:
            typer.echo(json.dumps({"scans": 0, "time_ns": 0, "values": {}, "problems": problems, "trap": None}))
        for problem in checked.problems:
            typer.echo(str(problem), err=True)
        raise typer.Exit(1)
    program = checked.program
    commands = _commands(program, Options(set, force, generate, clear, show))
    symbols = [_symbol(program, each) for each in show]
    try:
        result = run_headless(
            program, scans, ENGINES[engine], commands, every, lambda resource: _values(resource, symbols)
        )
    except Differs as difference:
        typer.echo(f"scanbench: {difference}", err=True)
        raise typer.Exit(3) from None
    _report(result, symbols, problems, hash, as_json)
    _end(result)


def _report(
    result: HeadlessRun[dict[str, Json]],
    symbols: list[Symbol],
    problems: list[dict[str, str | int]],
    with_hash: bool,
    as_json: bool,
) -> None:
    resource = result.resource
    interval = resource.program.interval_ns
    digest = hashlib.sha256(resource.state).hexdigest()
    if as_json:
        shown: dict[str, object] = {
            "scans": result.scans,
            "time_ns": result.scans * interval,
            "values": _values(resource, symbols),
            "rows": [{"scan": scan, "time_ns": scan * interval, "values": row} for scan, row in result.rows],
            **({"hash": digest} if with_hash else {}),
            "problems": problems,
            "trap": _trap_json(resource),
        }
        typer.echo(json.dumps(shown, ensure_ascii=False))
        return
    for scan, row in result.rows:
        typer.echo(f"{scan}: " + ", ".join(f"{path} = {value}" for path, value in row.items()))
    for symbol in symbols:
        typer.echo(f"{symbol.path} = {_text(resource, symbol)}")
    if with_hash:
        typer.echo(f"sha256 {digest}")
    typer.echo(f"{result.scans} scans, {result.scans * interval / 1e9:g} s of PLC time", err=True)


def _end(result: HeadlessRun[dict[str, Json]]) -> None:
    for refused in result.refused:
        near = f" Near: {', '.join(refused.refusal.near)}." if refused.refusal.near else ""
        typer.echo(f"scanbench: refused before scan {refused.scan}: {refused.refusal.message}.{near}", err=True)
    trap = result.resource.trap
    if trap is not None:
        typer.echo(
            f"{trap.file}:{trap.line}:{trap.column}: trap {trap.kind}: {trap.message} in scan {trap.scan}", err=True
        )
        raise typer.Exit(4)
    if result.refused:
        raise typer.Exit(2)


def _trap_json(resource: Resource) -> Json:
    trap = resource.trap
    if trap is None:
        return None
    place: dict[str, Json] = {"file": trap.file, "line": trap.line, "column": trap.column, "scan": trap.scan}
    return {"kind": str(trap.kind), **place, "message": trap.message}


# ---- options ------------------------------------------------------------------------------------------------------


def _interval(text: str) -> int:
    try:
        interval = duration(text.upper().removeprefix("T#").removeprefix("TIME#"))
    except ValueError as error:
        usage(f"--interval {text}: {error}")
    if interval < 1_000:
        usage(f"--interval {text}: a task runs at most every microsecond")
    return interval


def _commands(program: Program, options: Options) -> list[tuple[int, Command]]:
    """(scan, command) in the order of the scans; for one scan: sets, forces, errors raised, errors cleared."""
    made: list[tuple[int, Command]] = []
    for text in options.set:
        path, value, scan = _assignment(program, "--set", text)
        made.append((scan, Write(AUTHOR, path, value)))
    for text in options.force:
        path, value, scan = _assignment(program, "--force", text)
        made.append((scan, Force(AUTHOR, path, value)))
    for text in options.generate:
        reference, scan = _at(text)
        error = parse_reference(program.layout.model, reference)
        if isinstance(error, Refusal):
            usage(f"--raise {text}: {error.message}")
        made.append((scan, Generate(AUTHOR, (error,))))
    for text in options.clear:
        reference, scan = _at(text)
        if reference.lower() == "all":
            made.append((scan, Recover(AUTHOR, None)))
            continue
        error = parse_reference(program.layout.model, reference)
        if isinstance(error, Refusal):
            usage(f"--clear {text}: {error.message}")
        made.append((scan, Recover(AUTHOR, (error.id,))))
    return made


def _at(text: str) -> tuple[str, int]:
    match = AT.fullmatch(text)
    return (match.group(1), int(match.group(2))) if match else (text, 0)


def _assignment(program: Program, option: str, text: str) -> tuple[str, str, int]:
    body, scan = _at(text)
    path, equals, value = body.partition("=")
    if not equals:
        usage(f"{option} {text}: write PATH=VALUE, or PATH=VALUE@SCAN")
    return _symbol(program, path.removesuffix(":").strip()).path, value.strip(), scan


def _symbol(program: Program, path: str) -> Symbol:
    try:
        return resolve(program, path)
    except UnknownPath as error:
        near = f" Near: {', '.join(error.near)}." if error.near else ""
        usage(f"{error.message}{near}")


# ---- values -------------------------------------------------------------------------------------------------------


def _values(resource: Resource, symbols: list[Symbol]) -> dict[str, Json]:
    return {symbol.path: _json(resource, symbol) for symbol in symbols}


def _bytes(resource: Resource, symbol: Symbol) -> bytes | None:
    place = symbol.locate(resource.memory)
    if place is None:
        return None
    offset, bit = place
    data = bytes(resource.memory[offset : offset + symbol.type.size])
    return data if bit is None else bytes((data[0] >> bit & 1,))


def _json(resource: Resource, symbol: Symbol) -> Json:
    """A value for JSON; arrays are lists, structures objects; None for an in-out that is bound to nothing."""
    if isinstance(symbol.type, ArrayType):
        return [_json(resource, each) for each in members(resource.program, symbol.path)]
    if isinstance(symbol.type, Record):
        return {each.name: _json(resource, each) for each in members(resource.program, symbol.path)}
    data = _bytes(resource, symbol)
    return None if data is None else python_value(symbol.type, data)


def _text(resource: Resource, symbol: Symbol) -> str:
    if symbol.expandable:
        return json.dumps(_json(resource, symbol), ensure_ascii=False)
    data = _bytes(resource, symbol)
    return "not bound yet" if data is None else format_value(symbol.type, data)
