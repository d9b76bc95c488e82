"""What the program asked for in a scan, as commands: errors that its instructions raise, and what they clear.

A program asks in every scan, so what changes nothing is no news.
"""

from collections.abc import Callable, Mapping

from scanbench.check.system.system_text import Form
from scanbench.faults import device_errors
from scanbench.faults.clear import clear, most_serious, nonfatal
from scanbench.faults.details import Chosen, choose
from scanbench.faults.inject import ACTIVE, Generate, Recover, present_after, present_choices
from scanbench.faults.network import asked_of_others, error_on
from scanbench.faults.present import Active
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.model import ErrorDetail, ErrorEntry, Instruction, Location
from scanbench.runtime.command import Command, Refusal, View
from scanbench.runtime.detect import Asked

ALL_NONFATAL = 0xFFFF
"""The selector that clears every nonfatal error."""
_AUTHOR = "program"


def is_news(view: View, present: Mapping[str, Active], error: ErrorEntry, ref: ErrorRef) -> bool:
    """Whether raising this would change anything, and is possible."""
    chosen = choose(error, dict(ref.details), view.program.layout)
    if isinstance(chosen, Refusal):
        return False
    there = {id: active for id, active in present.items() if id == error.id}
    return all(one.details != chosen.details for one in present_choices(view, there).get(error.id, ()))


class Answers:
    """The commands for what a program asked, each after the ones before it."""

    def __init__(self, view: View) -> None:
        self._view = view
        self._present = view.derived(ACTIVE)
        self.commands: list[Command] = []
        self._taken: set[int] = set()
        """Ports of communications instructions that were asked for."""

    def add(self, asked: Asked) -> None:
        """Adds the commands for one request of the program; requests are added in the order in which it made them."""
        match asked.form:
            case Form.CLEAR_CODE:
                self._clear(lambda one: nonfatal(one) and one.code == asked.number)
            case Form.NETWORK:
                self._network(asked)
            case Form.CLEAR_FLAGS:
                self._clear_flags(asked.instruction)
            case _:
                if asked.instruction < len(self._view.model.instructions):
                    self._instruction(self._view.model.instructions[asked.instruction], asked)

    def _instruction(self, instruction: Instruction, asked: Asked) -> None:
        model, number = self._view.model, asked.number
        error = model.error(instruction.error)
        if error is None:
            return
        if asked.form == Form.SYSTEM:
            code, information = number >> 16, number & 0xFFFF
            meant = device_errors.by_code(model, code, error.severity)
            if meant is not None:
                self._raise(meant, device_errors.reference(meant, code, information))
        elif asked.form == Form.CLEAR:
            self._clear(self._selected(instruction, number))
        elif instruction.minimum <= number <= instruction.maximum:
            detail = error.detail(instruction.detail)
            details = () if detail is None else ((detail.name, number_text(detail, number)),)
            self._raise(error, ErrorRef(error.id, details))
        elif number == instruction.clears:
            self._clear(lambda one: one.error is error)

    def _network(self, asked: Asked) -> None:
        """A communications instruction: the error that the one before it left on its port goes."""
        request = asked_of_others(self._view, asked.instruction, asked.places, self._taken)
        if request is None:
            return
        left = error_on(self._view, request.port)
        if left:
            self._do(Recover(_AUTHOR, (left,), way="program"))
        self.commands.append(request)

    def _selected(self, instruction: Instruction, selector: int) -> Callable[[Chosen], bool]:
        if selector == ALL_NONFATAL:
            return nonfatal
        if instruction.minimum <= selector <= instruction.maximum:
            return lambda one: one.error.id == instruction.error and _has_number(one, instruction, selector)
        return most_serious(self._view, self._present, nonfatal)

    def _raise(self, error: ErrorEntry, ref: ErrorRef) -> None:
        if is_news(self._view, self._present, error, ref):
            self._do(Generate(_AUTHOR, (ref,), "program"))

    def _clear(self, wanted: Callable[[Chosen], bool]) -> None:
        command, _ = clear(self._view, self._present, _AUTHOR, wanted, "program")
        if command is not None:
            self._do(command)

    def _clear_flags(self, index: int) -> None:
        if index < len(self._view.model.resets):
            word = self._view.model.resets[index].flags
            self._clear(lambda one: nonfatal(one) and _in_word(one.error.flag, word))

    def _do(self, command: Generate | Recover) -> None:
        self.commands.append(command)
        self._present = present_after(self._present, command, self._view.header.scan)


def number_text(detail: ErrorDetail, number: int) -> str:
    """A number as the catalogue writes it."""
    return f"{number:X}" if detail.addresses[0].base == 16 else str(number)


def _has_number(one: Chosen, instruction: Instruction, number: int) -> bool:
    detail = one.error.detail(instruction.detail)
    return detail is not None and dict(one.details)[detail.name] == number_text(detail, number)


def _in_word(flag: Location, word: Location) -> bool:
    return flag.area.name == word.area.name and flag.word == word.word
