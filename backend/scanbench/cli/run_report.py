"""What `scanbench run` prints: values as text for people, one JSON object for machines."""

import hashlib
import json
from collections.abc import Iterator, Sequence

import typer

from scanbench.check.typed.condition import without_value
from scanbench.program.sites import TrapKind
from scanbench.recording.headless import HeadlessRun
from scanbench.reports.junit import Case, junit
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import TrapInfo
from scanbench.symbols.symbols import Symbol
from scanbench.symbols.violations import read_violations
from scanbench.symbols.whole import Worth, worth, worth_text

Json = Worth
Shown = list[tuple[str, Symbol]]
"""What is printed: the path as it was asked for, and the variable."""
VIOLATIONS_SHOWN = 20
"""Places of violations that are printed as text: an array of blocks has hundreds."""
_RUNS, _TAKEN = "the program runs", "each command is taken"
Result = HeadlessRun[dict[str, Json]]


def nothing_ran(problems: list[dict[str, str | int]], **more: Json) -> str:
    """The JSON object of a call that ran nothing."""
    shown: dict[str, object] = {"scans": 0, "time_ns": 0, "values": {}, "rows": [], "problems": problems, "trap": None}
    return json.dumps(shown | more, ensure_ascii=False)


def report_json(result: Result, shown: Shown, problems: list[dict[str, str | int]], with_hash: bool) -> None:
    """One object; a variable is keyed by its path as it was asked for."""
    resource, interval = result.resource, result.resource.program.interval_ns
    content: dict[str, object] = {
        "scans": result.scans,
        "time_ns": result.scans * interval,
        "values": values(resource, shown),
        "rows": [{"scan": scan, "time_ns": scan * interval, "values": row} for scan, row in result.rows],
        **({"hash": _hash(resource)} if with_hash else {}),
        "problems": problems,
        "until_unvalued": result.unvalued,
        "refused": [{"scan": each.scan, "message": each.refusal.message} for each in result.refused],
        "violations": _violations(resource),
        "violations_dropped": read_violations(resource.program, resource.memory).dropped,
        "state": _state(resource),
        "trap": _trap(resource),
    }
    typer.echo(json.dumps(content, ensure_ascii=False))


def report_text(result: Result, shown: Shown, with_hash: bool) -> None:
    """A line a variable."""
    resource = result.resource
    for scan, row in result.rows:
        typer.echo(f"{scan}: " + ", ".join(f"{path} = {value}" for path, value in row.items()))
    for path, symbol in shown:
        typer.echo(f"{path} = {worth_text(resource.program, resource.memory, symbol)}")
    if with_hash:
        typer.echo(f"sha256 {_hash(resource)}")
    for line in _outside(resource):
        typer.echo(line, err=True)
    seconds = f"{result.scans * resource.program.interval_ns / 1e9:,.6f}".rstrip("0").rstrip(".")
    typer.echo(f"{result.scans:,} scans, {seconds} s of PLC time", err=True)


def _outside(resource: Resource) -> Iterator[str]:
    """Values that left their subranges, a line each."""
    violations = read_violations(resource.program, resource.memory)
    for each in violations.entries[:VIOLATIONS_SHOWN]:
        times = f"{each.times} times, scans {each.first_scan} to {each.last_scan}"
        yield f"{each.span}: subrange: {each.told}, {times}"
    more = len(violations.entries) - VIOLATIONS_SHOWN
    if more > 0:
        note = f"subrange: {more} more places, {violations.count} violations in all; --json lists the places"
        if violations.dropped:
            note += f" (the list is full: {violations.dropped} violations are not in it)"
        yield note


def run_junit(name: str, result: Result, untaken: Sequence[str], until: str | None, interrupted: bool) -> str:
    """For a build server: did the program run, was each command taken?"""
    trap, outside = result.resource.trap, "\n".join(_outside(result.resource))
    ran = Case("run", _RUNS, text=outside)
    if trap is not None:
        ran = Case("run", _RUNS, "failure", trap_text(trap), "trap", outside)
    elif interrupted:
        ran = Case("run", _RUNS, "error", f"interrupted after {result.scans:,} scans", "interrupted", outside)
    elif until is not None and not result.met:
        told = f"after {result.scans:,} scans it was not so that {until}"
        ran = Case("run", _RUNS, "failure", "; ".join(filter(None, (told, unvalued(result, until)))), "until", outside)
    cases = [ran, Case("run", _TAKEN)]
    if untaken:
        cases[1] = Case("run", _TAKEN, "error", untaken[0], "refused", "\n".join(untaken))
    return junit(name, cases)


def unvalued(result: Result, until: str) -> str:
    """When the condition of --until had no value, if ever."""
    return "" if result.unvalued is None else without_value(until, result.unvalued)


def differ_junit(name: str, difference: str) -> str:
    """The same of a run in which the engines came to a different image."""
    return junit(name, [Case("run", _RUNS, "failure", difference, "difference")])


def trap_text(trap: TrapInfo) -> str:
    """Where the program stopped, and why."""
    return f"{trap.file}:{trap.line}:{trap.column}: trap {trap.kind}: {trap.message} in scan {trap.scan}"


def values(resource: Resource, shown: Shown) -> dict[str, Json]:
    """The values now."""
    return {path: worth(resource.program, resource.memory, symbol) for path, symbol in shown}


def texts(resource: Resource, shown: Shown) -> dict[str, Json]:
    """The same as people read them."""
    return {path: worth_text(resource.program, resource.memory, symbol) for path, symbol in shown}


def _hash(resource: Resource) -> str:
    return hashlib.sha256(resource.state).hexdigest()


def _state(resource: Resource) -> str:
    """`running`, `stopped` (mode PROGRAM), `fatal` or `trapped`."""
    if resource.trap is not None and resource.trap.kind != TrapKind.FATAL:
        return "trapped"
    if resource.header.halt:
        return "fatal"
    return "running" if resource.runnable else "stopped"


def _violations(resource: Resource) -> list[Json]:
    """Subrange violations, in the order in which they first happened."""
    return [
        {
            "file": each.span.file, "line": each.span.line, "column": each.span.column, "pou": each.pou,
            "instance": each.instance, "variable": each.variable, "target": each.target, "value": each.value, "low": each.low,
            "high": each.high, "times": each.times, "first_scan": each.first_scan, "last_scan": each.last_scan,
            "calls": [
                {"pou": call.pou, "instance": call.instance, "file": call.span.file, "line": call.span.line, "column": call.span.column}
                for call in each.calls
            ],
            "calls_cut": each.cut,
        }
        for each in read_violations(resource.program, resource.memory).entries
    ]  # fmt: skip


def _trap(resource: Resource) -> Json:
    trap = resource.trap
    if trap is None:
        return None
    place: dict[str, Json] = {"file": trap.file, "line": trap.line, "column": trap.column, "scan": trap.scan}
    return {"kind": str(trap.kind), **place, "message": trap.message}
