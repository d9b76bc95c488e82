"""Values of what people typed about a program (`check.typed.local`), on any image of it: halted, running or kept."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar, cast

from scanbench.check.typed.local import Local, LocalAssignment, LocalAssignments, LocalPlace
from scanbench.engines.interpreter.arithmetic import Number
from scanbench.engines.interpreter.expressions import Body
from scanbench.engines.interpreter.memory import Value, putter
from scanbench.engines.interpreter.observer import ReferenceObserver
from scanbench.engines.interpreter.places import BIT_SHIFT, BYTE_OFFSET, Trapped
from scanbench.engines.interpreter.statements import Statements
from scanbench.engines.interpreter.violations import recorder
from scanbench.problems import Span
from scanbench.program.copies import Spot
from scanbench.program.layout import Layout
from scanbench.program.program import Expr, Place, Pou, Program
from scanbench.program.sites import TrapSite
from scanbench.program.types import Elementary, Kind, Record, StringType, Subrange, Type
from scanbench.symbols.values import format_value

T = TypeVar("T")
ROUNDS = 50_000
"""Of loops in the functions that a text calls: the PLC waits for them, and this is some tenth of a second."""
Stored = tuple[LocalAssignment, Spot, bytes]
"""By which assignment, where, which bytes."""
_NOBODY = Pou("", "function", Record("", Kind.STRUCT), Record("", Kind.STRUCT), (), None, Span("", 0, 0, 0, 0))


class NoValue(Exception):
    """Why something has no value now, or none that fits: a sentence for people."""


class Evaluator:
    """Evaluates on one memory. What runs code of the program runs on a copy, so nothing is ever changed.

    `instance` is where the instance of the text's POU begins (`engines.debug.Frame.instance`); temporaries are those in
    the frame of the POU, whichever call left them there.
    """

    observer: ReferenceObserver | None = None

    def __init__(self, program: Program, memory: bytearray) -> None:
        self.program = program
        self.memory = memory
        self.state_size = program.layout.state_size
        self.record = recorder(memory, program)
        self._bodies: dict[Pou, Body] = {}
        self._copy: Evaluator | None = None

    def body(self, pou: Pou) -> Body:
        """Of a FUNCTION that is called, made when it is."""
        if pou not in self._bodies:
            self._bodies[pou] = Statements(self, pou).block(pou.body)
        return self._bodies[pou]

    def value(self, local: Local, instance: int) -> Value:
        """What it is worth now. Raises NoValue."""
        return self._guarded(local.traps, self._on(local.calls)._closure(local.pou, local.expr), instance)

    def valued(self, local: Local) -> Callable[[int], Value]:
        """The same for any instance, again and again; raises NoValue. Good for as long as this evaluator is."""
        if local.calls:
            return lambda instance: self.value(local, instance)
        closure = self._closure(local.pou, local.expr)
        return lambda instance: self._guarded(local.traps, closure, instance)

    def text(self, local: Local, instance: int) -> str:
        """The same as people read it. Raises NoValue."""
        return shown(local.type, self.value(local, instance))

    def condition(self, local: Local) -> Callable[[int], bool]:
        """Whether it holds, for an instance; a trap inside is FALSE. Good for as long as this evaluator is."""
        if local.calls:
            return lambda instance: self._holds(self._on(True)._closure(local.pou, local.expr), instance)
        closure = self._closure(local.pou, local.expr)
        return lambda instance: self._holds(closure, instance)

    def locate(self, local: LocalPlace, instance: int) -> Spot:
        """Where it is now. Raises NoValue."""
        run = self._on(local.calls)._located(local.pou, local.place)
        return self._guarded(local.traps, run, instance)

    def assigned(self, local: LocalAssignments, instance: int) -> list[Stored]:
        """What would be stored, one after the other. Raises NoValue."""
        return self.assigning(local)(instance)

    def assigning(self, local: LocalAssignments) -> Callable[[int], list[Stored]]:
        """The same for any instance, at any time. Good for as long as this evaluator is."""
        on = self._on(local.calls)
        every = [
            (
                each,
                None if each.condition is None else on._closure(local.pou, each.condition),
                on._closure(local.pou, each.value),
                on._located(local.pou, each.target),
            )
            for each in local.assignments
        ]

        def run(instance: int) -> list[Stored]:
            found: list[Stored] = []
            before: list[tuple[int, bytes]] = []
            try:
                for each, condition, value, located in every:
                    self._on(local.calls)
                    if condition is not None and not self._guarded(local.traps, condition, instance):
                        continue
                    worth = self._guarded(local.traps, value, instance)
                    _within(each.target.type, worth, each.shown)
                    spot = self._guarded(local.traps, located, instance)
                    data = bytes_of(each.target.type, worth)
                    found.append((each, spot, data))
                    before.append((spot[0], bytes(self.memory[spot[0] : spot[0] + len(data)])))
                    self._store(spot, data)  # for what is computed of it
            finally:
                for offset, old in reversed(before):
                    self.memory[offset : offset + len(old)] = old
            return found

        return run

    def _store(self, spot: Spot, data: bytes) -> None:
        offset, bit = spot
        if bit is None:
            self.memory[offset : offset + len(data)] = data
        else:
            self.memory[offset] = self.memory[offset] & ~(1 << bit) | (data[0] & 1) << bit

    def _on(self, calls: bool) -> "Evaluator":
        """Who evaluates: a copy, as the image is now, of what may leave traces in frames."""
        if not calls:
            return self
        if self._copy is None:
            self._copy = Evaluator(self.program, bytearray(self.memory))
        else:
            self._copy.memory[:] = self.memory
        self._copy.memory[Layout.BUDGET : Layout.BUDGET + 8] = ROUNDS.to_bytes(8, "little")
        return self._copy

    def _statements(self, pou: Pou | None) -> Statements:
        traps, calls = len(self.program.traps), len(self.program.calls)
        return Statements(self, replace(pou or _NOBODY, first_trap=traps, first_check=0, first_call=calls))

    def _closure(self, pou: Pou | None, expr: Expr) -> Callable[[int], Value]:
        return self._statements(pou).evaluate(expr)

    def _located(self, pou: Pou | None, place: Place) -> Callable[[int], Spot]:
        where = self._statements(pou).places.reference(place)
        bit = place.type.kind is Kind.BOOL and (place.bit is not None or place.slot or place.reference)
        in_bits = bool(bit)

        def located(instance: int) -> Spot:
            found = where(instance)
            return found & BYTE_OFFSET, found >> BIT_SHIFT if in_bits else None

        return located

    @staticmethod
    def _holds(closure: Callable[[int], Value], instance: int) -> bool:
        try:
            return bool(closure(instance))
        except Trapped:
            return False

    def _guarded(self, traps: tuple[TrapSite, ...], run: Callable[[int], T], instance: int) -> T:
        try:
            return run(instance)
        except Trapped as trapped:
            every = (*self.program.traps, *traps)
            raise NoValue(every[trapped.trap - 1].message) from None


def shown(type: Type, value: Value) -> str:
    """A value as people read it; of an array or structure how much is in it."""
    if isinstance(type, Elementary | StringType):
        return format_value(type, bytes_of(type, value))
    return type.name


def bytes_of(type: Type, value: Value) -> bytes:
    """The bytes of a value in an image."""
    if isinstance(value, bytes):
        return value
    made = bytearray(type.size)
    putter(made, type)(0, value)
    return bytes(made)


def _within(type: Type, value: Value, target: str) -> None:
    if isinstance(type, Subrange) and not type.low <= cast(Number, value) <= type.high:
        raise NoValue(f"{target}: {shown(type, value)} is outside of {type.low}..{type.high} ({type.name})")
