"""Reads `.case` files and runs their cases on engines."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

from scanbench.check.build import check_sources
from scanbench.check.libraries.catalogue import used_libraries
from scanbench.engines.engine import Engine, Reason, Stop
from scanbench.host.build import all_models
from scanbench.plcmodel.model import Model
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.names import names_of
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.symbols.values import format_value, parse_value
from scanbench.symbols.violations import read_violations
from scanbench.syntax.language_file import dialect_named, with_dialect
from scanbench.syntax.literals import date_and_time, duration

HEAD = re.compile(
    r"^\[(case|source|scans|trap|model|interval|budget|dialect|feature|violations|calls|file|clock|start|both|libraries)\b\s*(.*?)\]\s*$"
)
LINE = re.compile(r"^\s*(\d+)\s*:(.*?)(?:\|(.*))?$")
PAIR = re.compile(
    r"\s*([^\s:=,]+(?:\[[^\]]*\][^\s:=,]*)*)\s*:?=\s*('(?:\$.|[^'])*'|\"(?:\$.|[^\"])*\"|[^,]+)\s*(?:,|$)"
)

MODELS: dict[str, Model] = {model.name: model for model in all_models()[0]}


@dataclass(slots=True)
class Step:
    """What happens before a scan, and holds after it."""

    scan: int
    sets: list[tuple[str, str]]
    expected: list[tuple[str, str]]
    line: int


@dataclass(slots=True)
class Case:
    name: str
    source: str = ""
    steps: list[Step] = field(default_factory=list)
    trap: tuple[str, int] | None = None
    model: str = "GENERIC-IEC"
    interval_ns: int = 10_000_000
    budget: int | None = None
    features: list[str] = field(default_factory=list)
    """Numbers of what it shows, as in `tests/features`: `72.4`."""
    violations: list[str] | None = None
    """The list of subrange violations after the last scan, as `shown_violations` writes it."""
    calls: list[str] | None = None
    """Who called, of each of them: `Violation.path`, or `-`."""
    files: dict[str, str] = field(default_factory=dict)
    """Beside `source`: what is in `plant/`."""
    epoch_ns: int = 0
    """What the PLC's clock shows at virtual time 0."""
    in_out: Literal["reference", "value", ""] = ""
    """How blocks take their in-outs, when it is not as the model has it."""
    dialect: str = ""
    """In which the source is written; empty for the strict language."""
    libraries: bool = False
    """With the libraries of the dialect that it uses."""
    both: bool = False
    """It holds for both conventions."""
    starts: list[int] = field(default_factory=list)
    """Scans before which the program starts once more, with everything kept."""


def read_cases(path: Path) -> list[Case]:
    """All cases of a file; one that holds for both conventions of in-outs is two."""
    return [each for case in _read_cases(path) for each in (_both(case) if case.both else [case])]


def _both(case: Case) -> list[Case]:
    by_reference = replace(case, name=f"{case.name} by reference", in_out="reference")
    return [by_reference, replace(case, name=f"{case.name} by value", in_out="value")]


def _read_cases(path: Path) -> list[Case]:
    cases: list[Case] = []
    part = ""
    for number, line in enumerate(path.read_text("utf-8").splitlines(), 1):
        head = HEAD.match(line)
        if head:
            part, rest = head.groups()
            if part == "case":
                cases.append(Case(f"{path.stem}/{rest}"))
            else:
                _head(cases[-1], part, rest)
        elif part == "source":
            cases[-1].source += line + "\n"
        elif part == "file":
            cases[-1].files[[*cases[-1].files][-1]] += line + "\n"
        elif part == "violations" and line.strip():
            expected_violations = cases[-1].violations
            assert expected_violations is not None
            expected_violations.append(line.strip())
        elif part == "calls" and line.strip():
            expected_calls = cases[-1].calls
            assert expected_calls is not None
            expected_calls.append(line.strip())
        elif part == "scans" and line.strip():
            match = LINE.match(line)
            assert match, f"{path}:{number}: a line is `scan: sets | expectations`"
            scan, sets, expected = match.groups()
            cases[-1].steps.append(Step(int(scan), PAIR.findall(sets), PAIR.findall(expected or ""), number))
    return cases


def _head(case: Case, part: str, rest: str) -> None:
    """Reads a heading in brackets other than `[case]`."""
    match part:
        case "trap":
            kind, place = rest.split()
            case.trap = kind, int(place)
        case "model":
            case.model = rest
        case "dialect":
            case.dialect = rest
        case "budget":
            case.budget = int(rest)
        case "feature":
            case.features += rest.replace(",", " ").split()
        case "interval":
            case.interval_ns = duration(rest)
        case "clock":
            case.epoch_ns = date_and_time(rest.replace("T", "-"))
        case "start":
            case.starts.append(int(rest))
        case "file":
            case.files[rest] = ""
        case "violations":
            case.violations = []
        case "calls":
            case.calls = []
        case "both":
            case.both = True
        case "libraries":
            case.libraries = True


def project_of(case: Case) -> dict[str, str]:
    """The files of the case, with the dialect that it is in."""
    sources = {"case.st": case.source, **case.files}
    dialect = dialect_named(case.dialect) if case.dialect else None
    assert dialect is not None or not case.dialect, f"there is no dialect {case.dialect}"
    if dialect is None:
        return sources
    used = used_libraries(sources, dialect) if case.libraries else []
    return dict(with_dialect(sources | {each.path: each.text for each in used}, dialect))


def build(case: Case) -> Program:
    """The checked program; problems fail the test."""
    model = MODELS[case.model]
    model = replace(model, in_out=case.in_out) if case.in_out else model
    checked = check_sources(project_of(case), model, case.interval_ns)
    assert checked.program is not None, "\n".join(map(str, checked.problems))
    return checked.program


def look_up(program: Program, path: str) -> Symbol:
    """A variable of Main before anything else of that name."""
    try:
        return resolve(program, f"Main.{path}")
    except UnknownPath:
        return resolve(program, path)


def find(program: Program, path: str, memory: bytearray) -> tuple[int, int | None, str]:
    symbol = look_up(program, path)
    place = symbol.locate(memory)
    assert place is not None, f"{path} is bound to nothing"
    offset, bit = place
    data = bytes(memory[offset : offset + symbol.type.size])
    if bit is not None:
        data = bytes([data[0] >> bit & 1])
    return offset, bit, format_value(symbol.type, data)


def write(program: Program, path: str, text: str, memory: bytearray) -> None:
    symbol = look_up(program, path)
    offset, bit, _ = find(program, path, memory)
    data = parse_value(symbol.type, text)
    if bit is None:
        memory[offset : offset + len(data)] = data
    else:
        memory[offset] = memory[offset] & ~(1 << bit) | data[0] << bit


def first_difference(program: Program, a: bytearray, b: bytearray) -> str:
    """Where two images differ, for people; '' where they do not."""
    size = program.layout.state_size
    if a[:size] == b[:size]:
        return ""
    at = next(index for index in range(size) if a[index] != b[index])
    return f"{names_of(program).path(at)} (byte {at}): {a[at : at + 8].hex()} and {b[at : at + 8].hex()}"


def run_case(case: Case, engines: list[Callable[[Program, bytearray], Engine]]) -> None:
    """Runs on all engines in lockstep; compares whole images after every scan, then the expectations."""
    program = build(case)
    memories = [bytearray(program.initial_image) for _ in engines]
    for memory in memories if case.budget else ():
        memory[Layout.BUDGET_LIMIT : Layout.BUDGET_LIMIT + 8] = (case.budget or 0).to_bytes(8, "little")
    for memory in memories:
        memory[Layout.EPOCH : Layout.EPOCH + 8] = case.epoch_ns.to_bytes(8, "little")
    running = [make(program, memory) for make, memory in zip(engines, memories, strict=True)]
    last = max(step.scan for step in case.steps)
    for scan in range(last + 1):
        steps = [step for step in case.steps if step.scan == scan]
        for memory in memories if scan in case.starts else ():
            memory[Layout.STARTED : Layout.STARTED + 8] = scan.to_bytes(8, "little")
            at = scan * program.interval_ns
            memory[Layout.STARTED_AT : Layout.STARTED_AT + 8] = at.to_bytes(8, "little")
        for path, value in (each for step in steps for each in step.sets):
            for memory in memories:
                write(program, path, value, memory)
        stops = [engine.run(1) for engine in running]
        assert len(set(stops)) == 1, f"scan {scan}: {stops}"
        for memory in memories[1:]:
            difference = first_difference(program, memories[0], memory)
            assert not difference, f"scan {scan}: {running[0].name} and {running[1].name} differ at {difference}"
        for line, path, value in ((step.line, *each) for step in steps for each in step.expected):
            shown = shown_asked(memories[0]) if path == "asked" else find(program, path, memories[0])[2]
            assert same(shown, value), f"line {line}, scan {scan}: {path} is {shown}, not {value}"
        check_stop(program, case, stops[0], scan == last)
    if case.violations is not None:
        assert shown_violations(program, memories[0]) == case.violations
    if case.calls is not None:
        assert [each.path or "-" for each in read_violations(program, memories[0]).entries] == case.calls


def shown_asked(memory: bytearray) -> str:
    """What the program asked for: `instruction:number` each."""
    count = int.from_bytes(memory[Layout.ASKED_COUNT : Layout.ASKED_COUNT + 4], "little")
    entries = (memory[Layout.ASKED + 8 * each :][:8] for each in range(count))
    shown = (f"{int.from_bytes(each[:2], 'little')}:{int.from_bytes(each[4:], 'little')}" for each in entries)
    return " ".join(shown) or "none"


def shown_violations(program: Program, memory: bytearray) -> list[str]:
    """A line for each: `line:column instance variable = value, low..high, times, scans first..last`."""
    found = read_violations(program, memory)
    lines = [
        f"{each.span.line}:{each.span.column} {each.instance or each.pou} {each.name} = {'beyond ' * each.beyond}{each.value}, "
        f"{each.low}..{each.high}, {each.times}, scans {each.first_scan}..{each.last_scan}"
        for each in found.entries
    ]
    return lines + ([f"dropped {found.dropped}"] if found.dropped else [])


def same(shown: str, wanted: str) -> bool:
    """Equal as text, or as the number or duration that both write."""
    wanted = wanted.strip()
    if shown == wanted or shown.upper() == wanted.upper():
        return True
    try:
        if shown.startswith("T#") and wanted.upper().startswith("T#"):
            return duration(shown[2:]) == duration(wanted[2:])
        return _number(shown) == _number(wanted)
    except ValueError:
        return False


def _number(text: str) -> float:
    return int(text[3:], 16) if text.startswith("16#") else float(text)


def check_stop(program: Program, case: Case, stop: Stop, last: bool) -> None:
    if stop.reason is Reason.TRAP:
        site = program.traps[stop.trap - 1]
        assert case.trap == (site.kind.value, site.span.line), f"trapped: {site}"
        assert last
    else:
        assert not (last and case.trap), f"no trap, but {case.trap} expected"
