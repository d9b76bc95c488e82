"""Errors that nobody injects: the PLC finds them itself (a trap), or an instruction of the program asks for them."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from scanbench.check.program import Pou, Program, TrapKind
from scanbench.faults.details import choose
from scanbench.faults.inject import ACTIVE, Generate, Recover, present_choices
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.model import ErrorDetail, ErrorEntry, Instruction, Model
from scanbench.runtime.command import Command, Refusal, View
from scanbench.runtime.detect import Asked
from scanbench.runtime.trap import TrapInfo

CYCLE_TIME_OVER, PROGRAM_ERROR = "cycle-time-over", "program-error"
"""Ids of the errors that a PLC finds, in every model that has them."""
_CAUSE = "cause"
_CAUSES = {
    TrapKind.DIVISION: ("division", "operation-data", "instruction-processing"),
    TrapKind.BOUNDS: ("bounds", "device-range", "instruction-processing"),
    TrapKind.STRING: ("string", "operation-data", "instruction-processing"),
    TrapKind.NULL: ("reference", "device-range", "illegal-access"),
    TrapKind.ABSTRACT: ("call", "operation-data", "illegal-instruction"),
}
"""What models call the cause; the first that this one knows is it."""
_STOPPED_TASK = "stopped-task"
_INTERRUPT_TASK = 0x8000


class Detection:
    """Implements `runtime.detect.Detect` with the model's catalogue."""

    def on_trap(self, info: TrapInfo, view: View) -> Command | None:
        """The error that the device reports; None where the model has none, it is there already, or FALS made it."""
        kind = TrapKind(info.kind)
        error = view.model.error(CYCLE_TIME_OVER if kind is TrapKind.LOOP else PROGRAM_ERROR)
        if error is None or kind is TrapKind.FATAL:
            return None
        ref = ErrorRef(error.id, tuple(_trap_details(error, kind, info, view)))
        return None if _known(view, error, ref, _present(view)) else Generate("PLC", (ref,), "plc")

    def on_asked(self, asked: tuple[Asked, ...], view: View) -> tuple[Command, ...]:
        """One command for each thing that the program asked for and that changes something, in its order.

        A program asks in every scan, so an error that is present with this number is no news.
        """
        present = _present(view)
        commands: list[Command] = []
        for index, number in asked:
            if index >= len(view.model.instructions):
                continue
            instruction = view.model.instructions[index]
            error = view.model.error(instruction.error)
            if error is None:
                continue
            if instruction.minimum <= number <= instruction.maximum:
                ref = ErrorRef(error.id, tuple(_number_detail(error, instruction, number)))
                if not _known(view, error, ref, present):
                    commands.append(Generate("program", (ref,), "program"))
            elif number == instruction.clears and present.pop(error.id, None) is not None:
                commands.append(Recover("program", (error.id,)))
        return tuple(commands)


Details = tuple[tuple[str, str], ...]


def _present(view: View) -> dict[str, set[Details]]:
    """The errors that are present, and the details with which they are."""
    choices = present_choices(view, view.derived(ACTIVE))
    return {id: {one.details for one in several} for id, several in choices.items()}


def _known(view: View, error: ErrorEntry, ref: ErrorRef, present: dict[str, set[Details]]) -> bool:
    """Whether raising this is no news, or not possible; else it counts as present from now on."""
    chosen = choose(error, dict(ref.details), view.program.layout)
    if isinstance(chosen, Refusal) or chosen.details in present.get(error.id, ()):
        return True
    present.setdefault(error.id, set()).add(chosen.details)
    return False


def _number_detail(error: ErrorEntry, instruction: Instruction, number: int) -> Iterator[tuple[str, str]]:
    detail = error.detail(instruction.detail)
    if detail is not None:
        yield detail.name, _text(detail, number)


def _trap_details(error: ErrorEntry, kind: TrapKind, info: TrapInfo, view: View) -> Iterator[tuple[str, str]]:
    cause = error.detail(_CAUSE)
    known = [id for id in _CAUSES.get(kind, ()) if cause is not None and cause.choice(id) is not None]
    if known:
        yield _CAUSE, known[0]
    task = _task_detail(view.model, error)
    number = _stopped_task(view.program, info) if task is not None else None
    if task is not None and number is not None:
        yield task.name, _text(task, number)


def _task_detail(model: Model, error: ErrorEntry) -> ErrorDetail | None:
    """The detail that writes the word in which the model shows the task that ran."""
    word = model.special(_STOPPED_TASK)
    return next((each for each in error.details if word is not None and each.addresses[0].location == word), None)


def _text(detail: ErrorDetail, number: int) -> str:
    return f"{number:X}" if detail.addresses[0].base == 16 else str(number)


def _stopped_task(program: Program, info: TrapInfo) -> int | None:
    """The number of the task that ran into the trap, as Omron counts: cyclic tasks from 0, interrupt tasks from 8000."""
    place = (info.file, info.line, info.column)
    sites = (site for site in program.traps if (site.span.file, site.span.line, site.span.column) == place)
    pou = next((site.pou.upper() for site in sites if site.kind == info.kind), None)
    if pou is None:
        return None
    cyclic, interrupt = 0, _INTERRUPT_TASK
    for task in program.tasks:
        if any(called.name.upper() == pou for instance in task.programs for called in _called(instance.pou)):
            return cyclic if task.single is None else interrupt
        cyclic, interrupt = cyclic + (task.single is None), interrupt + (task.single is not None)
    return None


def _called(pou: Pou) -> set[Pou]:
    """A POU and all that it calls. Walks the whole tree: a trap is rare."""
    found = {pou}
    waiting: list[object] = [pou.body]
    while waiting:
        node = waiting.pop()
        if isinstance(node, Pou):
            if node not in found:
                found.add(node)
                waiting.append(node.body)
        elif isinstance(node, tuple | list):
            waiting += node
        elif is_dataclass(node) and type(node).__module__ == Pou.__module__:
            waiting += (getattr(node, field.name) for field in fields(node))
    return found
