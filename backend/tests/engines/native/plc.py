"""A small program on the native engine, for tests."""

from dataclasses import dataclass

from scanbench.check.build import check_sources
from scanbench.engines.engine import Reason
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.program.sites import TrapSite
from scanbench.symbols.symbols import resolve
from scanbench.symbols.values import parse_value, python_value
from tests.caseformat import MODELS, first_difference

MODEL = MODELS["GENERIC-IEC"]


def check(source: str, interval_ns: int = 1_000_000) -> Program:
    """The checked program; problems fail the test."""
    checked = check_sources({"test.st": source}, MODEL, interval_ns)
    assert checked.program is not None, "\n".join(map(str, checked.problems))
    return checked.program


@dataclass(slots=True)
class Plc:
    """Image and engine."""

    program: Program
    memory: bytearray
    engine: NativeEngine

    def value(self, path: str) -> bool | int | float | str | None:
        symbol = resolve(self.program, path)
        place = symbol.locate(self.memory)
        assert place is not None
        offset, bit = place
        data = bytes(self.memory[offset : offset + symbol.type.size])
        return python_value(symbol.type, bytes([data[0] >> bit & 1]) if bit is not None else data)

    def raw(self, path: str) -> bytes:
        symbol = resolve(self.program, path)
        place = symbol.locate(self.memory)
        assert place is not None
        return bytes(self.memory[place[0] : place[0] + symbol.type.size])

    def set(self, path: str, text: str) -> None:
        symbol = resolve(self.program, path)
        place = symbol.locate(self.memory)
        assert place is not None
        data = parse_value(symbol.type, text)
        self.memory[place[0] : place[0] + len(data)] = data

    def offset(self, path: str) -> int:
        place = resolve(self.program, path).locate(self.memory)
        assert place is not None
        return place[0]

    def field(self, offset: int, size: int = 8) -> int:
        return int.from_bytes(self.memory[offset : offset + size], "little", signed=True)

    def set_field(self, offset: int, value: int, size: int = 8) -> None:
        self.memory[offset : offset + size] = value.to_bytes(size, "little", signed=True)

    def force(self, *entries: tuple[int, int, int]) -> None:
        """Writes the force table: (offset, mask, value)."""
        self.set_field(Layout.FORCE_COUNT, len(entries), 4)
        for number, (offset, mask, value) in enumerate(entries):
            at = Layout.FORCES + 8 * number
            self.memory[at : at + 8] = offset.to_bytes(4, "little") + bytes([mask, value, 0, 0])

    def trapped(self) -> TrapSite:
        """Runs a scan that has to trap."""
        stop = self.engine.run(1)
        assert stop.reason is Reason.TRAP
        return self.program.traps[stop.trap - 1]


def plc(source: str, opt_level: int = 2) -> Plc:
    """A PLC with this program; nothing has run."""
    program = check(source)
    memory = bytearray(program.initial_image)
    return Plc(program, memory, NativeEngine(program, memory, opt_level))


def ran(source: str, scans: int = 1) -> Plc:
    """After some scans, which the reference engine must have left as the native one did."""
    made = plc(source)
    reference = bytearray(made.program.initial_image)
    assert made.engine.run(scans) == ReferenceEngine(made.program, reference).run(scans)
    assert first_difference(made.program, made.memory, reference) == ""
    return made
