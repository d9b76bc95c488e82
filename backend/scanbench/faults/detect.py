"""Errors that nobody injects: the PLC finds them itself (a trap), or an instruction of the program asks for them."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass

from scanbench.faults.answers import Answers, is_news, number_text
from scanbench.faults.inject import ACTIVE, Generate
from scanbench.faults.reference import ErrorRef
from scanbench.faults.trap_errors import error_of
from scanbench.plcmodel.model import ErrorDetail, ErrorEntry, Model
from scanbench.program.program import Pou, Program
from scanbench.program.sites import TrapKind
from scanbench.runtime.command import Command, View
from scanbench.runtime.detect import Asked
from scanbench.runtime.trap import TrapInfo

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
        error = error_of(view.model, info)
        if error is None:
            return None
        ref = ErrorRef(error.id, tuple(_trap_details(error, kind, info, view)))
        return Generate("PLC", (ref,), "plc") if is_news(view, view.derived(ACTIVE), error, ref) else None

    def on_asked(self, asked: tuple[Asked, ...], view: View) -> tuple[Command, ...]:
        """One command for each thing that the program asked for and that changes something, in its order.

        A program asks in every scan, so an error that is present with this number is no news.
        """
        answers = Answers(view)
        for each in asked:
            answers.add(each)
        return tuple(answers.commands)


def _trap_details(error: ErrorEntry, kind: TrapKind, info: TrapInfo, view: View) -> Iterator[tuple[str, str]]:
    cause = error.detail(_CAUSE)
    known = [id for id in _CAUSES.get(kind, ()) if cause is not None and cause.choice(id) is not None]
    if known:
        yield _CAUSE, known[0]
    task = _task_detail(view.model, error)
    number = _stopped_task(view.program, info) if task is not None else None
    if task is not None and number is not None:
        yield task.name, number_text(task, number)


def _task_detail(model: Model, error: ErrorEntry) -> ErrorDetail | None:
    """The detail that writes the word in which the model shows the task that ran."""
    word = model.special(_STOPPED_TASK)
    return next((each for each in error.details if word is not None and each.addresses[0].location == word), None)


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
