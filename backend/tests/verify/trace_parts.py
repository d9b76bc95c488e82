"""What the tests of traces share: programs, tables, and a trace of the conveyor by a native run."""

from collections.abc import Mapping, Sequence
from functools import cache

from scanbench.check.build import check_sources
from scanbench.check.typed.condition import BadCondition, compile_signal
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.program import Program
from scanbench.program.types import ArrayType, Elementary, Record
from scanbench.runtime.command import Refusal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.server.samples import samples
from scanbench.symbols.symbols import members
from scanbench.taps.trace import Trace, TraceDefinition
from scanbench.taps.trace_csv import to_csv
from scanbench.verify.trace.bind import Checked, check
from scanbench.verify.trace.mapping import ColumnMap, Gaps, Role, TraceMapping
from scanbench.verify.trace.read import read_trace
from tests.caseformat import MODELS

Writes = Mapping[int, tuple[tuple[str, str], ...]]
PRESSED: Writes = {
    5: (("start", "TRUE"),),
    9: (("start", "FALSE"),),
    160: (("stop", "TRUE"),),
    163: (("stop", "FALSE"),),
    170: (("start", "TRUE"),),
    200: (("reset", "TRUE"), ("start", "FALSE")),
    202: (("reset", "FALSE"),),
}
SIGNALS = (
    "start", "stop", "reset", "basicIoError", "motor", "lamp", "partsTotal", "bufferLevel", "Main.uptime",
    "Main.belt.position", "Main.heartbeat", "Main.parts.total + 1", "D100", "Main.buffer.level",
)  # fmt: skip


def program_of(source: str) -> Program:
    checked = check_sources({"Main.st": source}, MODELS["CJ1M-CPU63"])
    assert checked.program is not None, checked.problems
    return checked.program


@cache
def conveyor() -> Program:
    sample = next(each for each in samples() if each.name == "Conveyor")
    program = check_sources(sample.files, MODELS[sample.model]).program
    assert program is not None
    return program


@cache
def conveyor_csv(first: int = 0, scans: int = 300) -> str:
    """`scans` rows from scan `first` on."""
    return exported(conveyor(), SIGNALS, first, scans, PRESSED)


def exported(program: Program, signals: Sequence[str], first: int, scans: int, writes: Writes) -> str:
    """What our own export writes of a native run."""
    resource = Resource(Loaded.make(program, NativeEngine))
    trace = Trace(1, TraceDefinition("trace", tuple(signals)), "Ada")
    trace.define(trace.definition, program, "Ada")
    for scan in range(first + scans):
        for path, value in writes.get(scan, ()):
            assert not isinstance(resource.submit(Write("Ada", path, value)), Refusal)
        if scan == first:
            trace.start(program, scan)
            resource.waiting.samplings = trace.samplings
        resource.run(1)
    trace.drain(first + scans)
    return "".join(to_csv(trace.buffer.pieces(0, 1 << 40), trace.signals, program.interval_ns))


def leaves(program: Program, path: str = "") -> list[str]:
    """Every single value of the program that can be traced."""
    found = []
    for symbol in members(program, path):
        if symbol.slots:
            continue
        if isinstance(symbol.type, Elementary):
            found += [] if isinstance(compile_signal(program, symbol.path), BadCondition) else [symbol.path]
        elif isinstance(symbol.type, ArrayType | Record):
            found += leaves(program, symbol.path)
    return found


def with_cell(text: str, scan: int, column: str, value: str) -> str:
    """The same file with another value in one cell."""
    lines = text.split("\r\n")
    names = lines[0].split(",")
    index = next(at for at, line in enumerate(lines) if line.split(",")[0] == str(scan))
    cells = lines[index].split(",")
    assert cells[names.index(column)] != value
    cells[names.index(column)] = value
    lines[index] = ",".join(cells)
    return "\r\n".join(lines)


def mapped(*columns: tuple[str, str, Role], axis: str = "scan", gaps: Gaps = "refuse") -> TraceMapping:
    return TraceMapping(axis, "scan", gaps, tuple(ColumnMap(*each) for each in columns))


def checked(text: str, mapping: TraceMapping, program: Program) -> Checked:
    return check(read_trace(text.encode(), "trace.csv"), mapping, program)
