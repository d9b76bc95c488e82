"""Checked programs whose bodies are made by hand: what a node means, whoever makes it."""

from dataclasses import dataclass, replace

from scanbench.engines.engine import Stop
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.problems import Span
from scanbench.program.layout import Layout
from scanbench.program.program import Base, Const, Expr, Load, Place, Pou, Program, Stmt
from scanbench.program.sites import TrapKind, TrapSite
from scanbench.program.types import Kind, Reference, Type
from tests.caseformat import first_difference
from tests.engines.native.plc import check

SPAN = Span("test.st", 1, 1, 1, 2)
LIST_SIZE = 8 + Layout.VIOLATION_LIMIT * Layout.VIOLATION_BYTES


@dataclass(slots=True)
class HandMade:
    """A program without statements; `run` gives its PROGRAM a body."""

    program: Program
    pou: Pou
    memory: bytearray

    def at(self, name: str, type: Type | None = None, add: int = 0, bit: int | None = None) -> Place:
        """The variable, or a part of it."""
        member = self.pou.instance.members[name.upper()]
        variable = f"{self.pou.name}.{name}".upper()
        return Place(type or member.type, Base.SELF, member.offset + add, bit=bit, variable=variable)

    def get(self, name: str) -> Expr:
        return Load(self.at(name))

    def offset(self, name: str) -> int:
        """In the image."""
        return self.program.tasks[0].programs[0].offset + self.pou.instance.members[name.upper()].offset

    def number(self, name: str) -> int:
        member = self.pou.instance.members[name.upper()]
        start = self.offset(name)
        return int.from_bytes(self.memory[start : start + member.type.size], "little", signed=True)

    def list_field(self, at: int, size: int = 4) -> int:
        start = self.program.layout.violations + at
        return int.from_bytes(self.memory[start : start + size], "little", signed=True)

    def run(self, *body: Stmt, scans: int = 1, opt_level: int = 2) -> Stop:
        """Both engines, from the same image; they must agree."""
        self.pou.body = body
        shadow = bytearray(self.memory)
        stop = NativeEngine(self.program, self.memory, opt_level).run(scans)
        assert ReferenceEngine(self.program, shadow).run(scans) == stop
        assert first_difference(self.program, self.memory, shadow) == ""
        return stop


def hand_made(variables: str, types: str = "", body: str = "") -> HandMade:
    """A program with these variables, a list of violations, and one trap of each kind in the order of `TrapKind`.

    `body` is there to be replaced: it calls what the statements to come want to call.
    """
    program = check(f"{types}\nPROGRAM Main\nVAR {variables} END_VAR\n{body}\nEND_PROGRAM")
    layout = program.layout
    if not layout.violations:
        layout.violations = -(-layout.state_size // 8) * 8
        grown = layout.violations + LIST_SIZE - layout.state_size
        layout.state_size += grown
        layout.size += grown
        for pou in program.pous:
            pou.frame_offset += grown
    traps = tuple(TrapSite(kind, SPAN, "Main", kind.value) for kind in TrapKind)
    image = program.initial_image + bytes(layout.size - len(program.initial_image))
    program = replace(program, traps=traps, initial_image=image)
    return HandMade(program, program.pous[-1], bytearray(image))


def trap(kind: TrapKind) -> int:
    """As nodes and `Stop` name it."""
    return list(TrapKind).index(kind) + 1


def through(type: Type, value: Expr, offset: int = 0) -> Place:
    """The place to which a reference leads."""
    return Place(type, Base.IMAGE, offset, reference=value, null_trap=trap(TrapKind.NULL))


def reference_to(type: Type) -> Reference:
    return Reference(f"REF_TO {type.name}", Kind.REF, 8, target=type)


def const(type: Type, value: int | bytes) -> Const:
    return Const(type, value)  # type: ignore[arg-type]
