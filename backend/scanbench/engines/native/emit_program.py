"""A program as the text of LLVM modules: one for each POU, and one for the scan.

The text of a POU's module depends on other POUs only through what it calls and through the offsets of frames: the numbers
from which its sites count, and the offset of the list of violations, are defined in the scan's module. So the text stays the
same when other POUs change, and its code can be kept.
"""

from collections import Counter
from collections.abc import Iterable

from scanbench.engines.native import emit_pou, emit_scan, inlining
from scanbench.engines.native.effects import Effects
from scanbench.engines.native.emit_body import Unit
from scanbench.engines.native.emit_checks import CALLERS, COPIES, LIST, PATHS
from scanbench.engines.native.emit_try import CODES
from scanbench.engines.native.flavour import RUN, Flavour
from scanbench.engines.native.registers import Signature
from scanbench.program.calling import callers
from scanbench.program.program import Pou, Program
from scanbench.program.sites import EXCEPTIONS


class Emitter:
    """Emits the modules of one program."""

    def __init__(
        self,
        program: Program,
        effects: Effects | None = None,
        signatures: dict[Pou, Signature] | None = None,
        flavour: Flavour = RUN,
    ) -> None:
        """`effects` and `signatures` of its POUs may be known already. The flavour says what the code does besides."""
        self.names = names(program.pous)
        self._program = program
        self._effects = effects or Effects()
        self._signatures: dict[Pou, Signature] = {} if signatures is None else signatures
        self._flavour = flavour
        runs = (each for task in program.tasks for each in task.programs)
        calls = Counter(each.pou for each in (*runs, *program.plant))
        self.housed = {pou for pou, count in calls.items() if count == 1 and inlining.shared(pou)}
        """Small programs, which are emitted into the module of the scan."""
        # a bound that all programs of about this size have
        self._size = 1 << program.layout.size.bit_length() - 1

    def pou(self, pou: Pou) -> Unit:
        """The module of one POU, if it is not housed elsewhere."""
        unit = self._unit()
        emit_pou.emit(unit, pou, self._size, "")
        return self._complete(unit, {pou})

    def scan(self) -> Unit:
        """The module of the scan, the loop around it and the small programs."""
        unit = self._unit()
        emit_scan.emit(unit, self._program)
        return self._complete(unit, set())

    def numbers(self) -> Unit:
        """The module of the numbers that the others refer to."""
        unit = self._unit()
        self._add_numbers(unit, "")
        return unit

    def whole(self) -> Unit:
        """Everything in one module."""
        unit = self._unit()
        for pou in self._program.pous:
            emit_pou.emit(unit, pou, self._size)
        emit_scan.emit(unit, self._program)
        self._add_numbers(unit, "internal ")
        return unit

    def _unit(self) -> Unit:
        return Unit(
            effects=self._effects,
            names=self.names,
            signatures=self._signatures,
            image_size=self._program.layout.size,
            state_size=self._program.layout.state_size,
            flavour=self._flavour,
        )

    def _complete(self, unit: Unit, here: set[Pou]) -> Unit:
        """Adds copies of small callees, which may become part of the module, and declares what it refers to."""
        left = inlining.MOST_COPIED
        while True:
            copies = []
            for each in unit.mentioned:
                if each not in here and inlining.shared(each) and (left > 0 or each in self.housed):
                    copies.append(each)
                    left -= inlining.size(each.body) + inlining.COPY
            if not copies:
                break
            for each in copies:
                emit_pou.emit(unit, each, self._size, "internal " if each in self.housed else "available_externally ")
            here.update(copies)
        for each in [*unit.mentioned]:
            if each in here:
                name = self.names[each]
                for number in (first_trap(name), first_check(name), first_call(name)):
                    unit.module.add(f"{number} = external constant i32")
            else:
                unit.module.add(f"declare {emit_pou.head(unit, each, self._size)}")
        unit.module.add(f"{LIST} = external constant i64")
        unit.module.add(f"{COPIES} = external constant i64")
        unit.module.add(f"{PATHS} = external constant i64")
        unit.module.add(f"{CALLERS} = external constant i32")
        return unit

    def _add_numbers(self, unit: Unit, linkage: str) -> None:
        for pou in self._program.pous:
            name = self.names[pou]
            unit.module.add(f"{first_trap(name)} = {linkage}constant i32 {pou.first_trap}")
            unit.module.add(f"{first_check(name)} = {linkage}constant i32 {pou.first_check}")
            unit.module.add(f"{first_call(name)} = {linkage}constant i32 {pou.first_call}")
        unit.module.add(f"{LIST} = {linkage}constant i64 {self._program.layout.violations}")
        unit.module.add(f"{COPIES} = {linkage}constant {_copies(self._program)}, align 8")
        unit.module.add(f"{PATHS} = {linkage}constant i64 {self._program.layout.paths}")
        noted = [0, *callers(self._program)]
        unit.module.add(
            f"{CALLERS} = {linkage}constant [{len(noted)} x i32] [{', '.join(f'i32 {each}' for each in noted)}]"
        )
        unit.module.define(CODES, f"{linkage}constant {_codes(self._program)}, align 2")
        self._flavour.declare(unit)


def _copies(program: Program) -> str:
    found = program.layout.copies.all
    numbers = [len(found), *(number for each in found for number in (each.start, each.end, each.slot))]
    return f"[{len(numbers)} x i64] [{', '.join(f'i64 {each}' for each in numbers)}]"


def _codes(program: Program) -> str:
    """What __TRY says of each trap; 0 for what it does not catch. The first one has number 1."""
    codes = (0, *(EXCEPTIONS.get(each.kind, 0) for each in program.traps))
    text = "".join(f"\\{code & 0xFF:02X}\\{code >> 8:02X}" for code in codes)
    return f'[{2 * len(codes)} x i8] c"{text}"'


def emit_program(program: Program, flavour: Flavour = RUN) -> str:
    """The IR text of everything in one module."""
    return Emitter(program, flavour=flavour).whole().module.text()


def names(pous: Iterable[Pou]) -> dict[Pou, str]:
    """A name for each POU, which does not depend on POUs of other names."""
    made: dict[Pou, str] = {}
    taken: dict[str, int] = {}
    for pou in pous:
        name = "".join(c if c.isascii() and (c.isalnum() or c in "_.") else f"${ord(c):x}" for c in pou.name)
        taken[name] = taken.get(name, 0) + 1
        made[pou] = name if taken[name] == 1 else f"{name}${taken[name]}"
    return made


def first_trap(name: str) -> str:
    """The number that the numbers of a POU's traps count from."""
    return f'@"trap.{name}"'


def first_call(name: str) -> str:
    """The number that the numbers of a POU's calls count from."""
    return f'@"call.{name}"'


def first_check(name: str) -> str:
    """The number that the numbers of a POU's subrange checks count from."""
    return f'@"check.{name}"'
