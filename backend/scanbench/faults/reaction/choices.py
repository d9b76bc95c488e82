"""Which details of an error a program tells apart: each of them is raised in a sweep.

A choice is told apart by the places that read its bits, or by its error code where the code word is read and that number is in
the program. Numbers that are only in the first values of variables (a table of codes) are not found.
"""

from collections.abc import Iterable, Iterator, Sequence

from scanbench.faults.details import choose
from scanbench.faults.reaction.deciding import Instances
from scanbench.faults.reaction.error_memory import Watched, code_bits
from scanbench.faults.reaction.places import heads, parts
from scanbench.faults.reaction.readings import Readings
from scanbench.faults.reference import ErrorRef, find_error
from scanbench.plcmodel.hardware import fitted_instances
from scanbench.plcmodel.model import ErrorDetail, ErrorEntry
from scanbench.program.bodies import every
from scanbench.program.program import Case, Const, Program
from scanbench.runtime.command import Refusal

_MOST = 600
"""Numbers of a detail that are tried out."""
_Told = tuple[frozenset[tuple[int, int, int, int]], int | None]
_UNTOLD: _Told = (frozenset(), None)


class Choices:
    """The details that one program tells apart."""

    def __init__(self, program: Program) -> None:
        self._program, self._readings = program, Readings(program, Instances(program))
        readings = self._readings
        by_byte: dict[int, int] = {}
        for part in code_bits(program):
            by_byte[part.offset] = by_byte.get(part.offset, 0) | part.mask
        self._numbers = frozenset(_numbers(program)) if readings.reads(by_byte) else frozenset[int]()

    def of(self, id: str) -> Sequence[ErrorRef]:
        """The error with its default details, and with each choice that is told apart. Without the former, if the program
        looks at nothing of it but at these choices. Where a project says what is fitted: each instance of that, perhaps none."""
        entry = find_error(self._program.layout.model, id)
        default = ErrorRef(id)
        if isinstance(entry, Refusal):
            return (default,)
        if not entry.details:
            return () if fitted_instances(self._program.layout.model.fitted, entry) == () else (default,)
        chosen = choose(entry, {}, self._program.layout)
        if isinstance(chosen, Refusal):
            return (default,)
        fitted = fitted_instances(self._program.layout.model.fitted, entry)
        if fitted is not None:
            return [ErrorRef(id, details) for details in fitted]
        found = [each for detail in entry.details for each in self._of_detail(entry, detail, dict(chosen.details))]
        if found and not self._looks_at(default, entry):
            return found
        return (default, *found)

    def expand(self, errors: Iterable[ErrorRef]) -> list[ErrorRef]:
        """Of each error that has no details yet what is to be raised; each once, in this order."""
        found = [each for ref in errors for each in ((ref,) if ref.details else self.of(ref.id))]
        return list(dict.fromkeys(found))

    def _of_detail(self, entry: ErrorEntry, detail: ErrorDetail, defaults: dict[str, str]) -> Iterator[ErrorRef]:
        values = list(_values(detail))
        if detail.control == "Spin" and not self._may_tell(entry, detail, values):
            return
        seen = {self._told_by(entry, {})}
        for value in values:
            if value == defaults.get(detail.name):
                continue
            told = self._told_by(entry, {detail.name: value})
            if told is not None and told != _UNTOLD and told not in seen:
                seen.add(told)
                yield ErrorRef(entry.id, ((detail.name, value),))

    def _may_tell(self, entry: ErrorEntry, detail: ErrorDetail, values: Sequence[str]) -> bool:
        """Whether the program reads anything of a row of numbers, or has one of their codes: most times it does not."""
        ends = [choose(entry, {detail.name: value}, self._program.layout) for value in (values[0], values[-1])]
        chosen = [each for each in ends if not isinstance(each, Refusal)]
        codes = [each.code for each in chosen if entry.coded]
        offsets = [offset for each in chosen for offset in Watched.of(self._program, each).detail]
        if codes and any(min(codes) <= number <= max(codes) for number in self._numbers):
            return True
        return bool(offsets) and self._readings.any_in(min(offsets), max(offsets) + 1)

    def _told_by(self, entry: ErrorEntry, given: dict[str, str]) -> _Told | None:
        """What tells a choice apart: the places that read its details, and its code if that is a number of the program."""
        chosen = choose(entry, given, self._program.layout)
        if isinstance(chosen, Refusal):
            return None
        detail = Watched.of(self._program, chosen).detail
        code = chosen.code if entry.coded and chosen.code in self._numbers else None
        return self._readings.reads(detail), code

    def _looks_at(self, ref: ErrorRef, entry: ErrorEntry) -> bool:
        """Whether the program reads the flag, the details or the number of the code."""
        chosen = choose(entry, dict(ref.details), self._program.layout)
        if isinstance(chosen, Refusal):
            return False
        watched = Watched.of(self._program, chosen)
        return bool(
            self._readings.reads(watched.flag)
            or self._readings.reads(watched.detail)
            or (entry.coded and chosen.code in self._numbers)
        )


def _values(detail: ErrorDetail) -> Iterator[str]:
    if detail.control == "List":
        yield from (each.id for each in detail.addresses)
        return
    address = detail.addresses[0]
    if detail.control == "Spin" and not address.is_text:
        low, high = address.minimum or 0, address.maximum or 0
        for number in range(low, min(high, low + _MOST) + 1):
            yield f"{number:X}" if address.base == 16 else str(number)


def _numbers(program: Program) -> Iterator[int]:
    """The whole numbers in the statements of a program."""
    for pou in program.tasked:
        for stmt in every(pou.body):
            if isinstance(stmt, Case):
                yield from (low for labels, _ in stmt.branches for low, high in labels if low == high)
            for node in parts(heads(stmt)):
                if isinstance(node, Const) and isinstance(node.value, int):
                    yield node.value
