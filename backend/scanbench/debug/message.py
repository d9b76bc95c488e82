"""What a logpoint says: text with `{expression}` in it."""

import re
from dataclasses import dataclass

from scanbench.check.typed.condition import BadCondition
from scanbench.check.typed.local import Local, Locals
from scanbench.engines.interpreter.evaluate import Evaluator, NoValue
from scanbench.program.program import Pou

_PART = re.compile(r"\{\{|\}\}|\{([^{}]*)\}|[{}]")
LONGEST = 4000
"""Characters that one message says."""


@dataclass(frozen=True, slots=True)
class Message:
    """A log message, understood in the scope of the POU for which it was made. `{{` and `}}` stand for braces."""

    parts: tuple[str | Local, ...]

    @staticmethod
    def of(locals: Locals, pou: Pou | None, text: str) -> "Message | BadCondition":
        """The message, or which of its expressions is wrong."""
        parts: list[str | Local] = []
        at = 0
        for match in _PART.finditer(text):
            parts.append(text[at : match.start()])
            at = match.end()
            if match.group() in ("{{", "}}"):
                parts.append(match.group()[0])
                continue
            if match.group(1) is None:
                return BadCondition(
                    f"`{match.group()}` is alone; write `{{level}}`, or `{match.group() * 2}` for a brace."
                )
            local = locals.value(pou, match.group(1))
            if isinstance(local, BadCondition):
                return BadCondition(f"`{match.group()}`: {local.message}", local.near, match.start(1) + local.column)
            parts.append(local)
        parts.append(text[at:])
        return Message(tuple(each for each in parts if each != ""))

    def text(self, evaluator: Evaluator, instance: int) -> str:
        """What it says now."""
        said = "".join(each if isinstance(each, str) else _worth(each, evaluator, instance) for each in self.parts)
        return said if len(said) <= LONGEST else f"{said[: LONGEST - 3]}..."


def _worth(local: Local, evaluator: Evaluator, instance: int) -> str:
    try:
        return evaluator.text(local, instance)
    except NoValue as error:
        return f"{{{local.text.strip()}: {error}}}"
