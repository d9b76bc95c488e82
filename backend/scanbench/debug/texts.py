"""What people write at breakpoints, made ready to run: conditions, messages, assignments."""

from collections.abc import Callable

from scanbench.check.typed.local import Bad, Local, locals_of
from scanbench.debug.assign import Assigning
from scanbench.debug.message import Message
from scanbench.engines.interpreter.evaluate import Evaluator
from scanbench.program.program import Pou, Program

Holds = Callable[[int], bool]
"""Whether a condition holds, for an instance of its POU."""
Says = Callable[[int], str]
"""What a message says there."""


class BadText(Exception):
    """Why something means nothing in this program: a sentence for people."""

    def __init__(self, message: str) -> None:
        super().__init__(message)
        self.message = message


class Texts:
    """Understands texts about one program, on one image."""

    def __init__(self, program: Program, memory: bytearray) -> None:
        self.locals = locals_of(program)
        self.evaluator = Evaluator(program, memory)

    def condition(self, pou: Pou | None, text: str) -> Holds:
        """A BOOL in the scope of a POU, or of the whole program. Raises `BadText`."""
        return self.evaluator.condition(self.local(pou, text))

    def local(self, pou: Pou | None, text: str) -> Local:
        """The same, not made ready to run."""
        made = self.locals.condition(pou, text)
        if isinstance(made, Bad):
            raise BadText(f"condition: {made.message}")
        return made

    def message(self, pou: Pou | None, text: str) -> Says:
        """A text with `{expression}` in it. Raises `BadText`."""
        made = Message.of(self.locals, pou, text)
        if isinstance(made, Bad):
            raise BadText(f"message: {made.message}")
        evaluator = self.evaluator
        return lambda instance: made.text(evaluator, instance)

    def assigning(self, pou: Pou | None, text: str) -> Assigning:
        """Assignments. Raises `BadText`."""
        made = self.locals.assignments(pou, text)
        if isinstance(made, Bad):
            raise BadText(f"assignment: {made.message}")
        return Assigning(self.evaluator, made)
