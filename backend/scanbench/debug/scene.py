"""What there is to look at: a program, an image, and the calls that are open in it."""

from dataclasses import dataclass, field

from scanbench.check.typed.local import Locals, locals_of
from scanbench.engines.debug import Frame
from scanbench.engines.interpreter.evaluate import Evaluator
from scanbench.program.program import Pou, Program
from scanbench.symbols.sites import Sites


@dataclass(frozen=True, slots=True)
class Scene:
    """Of a moment: it is made again when the image has changed."""

    program: Program
    """Whose statements run."""
    memory: bytearray
    sites: Sites
    frames: tuple[Frame, ...] = ()
    """Innermost first; none while it runs, or in the seam."""
    past: bool = False
    """What is shown is an earlier position of the PLC: nothing can be written."""
    locals: Locals = field(init=False, repr=False)
    evaluator: Evaluator = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "locals", locals_of(self.program))
        object.__setattr__(self, "evaluator", Evaluator(self.program, self.memory))

    def frame(self, index: int | None) -> Frame | None:
        """One frame; None where nothing runs, or the whole program is meant. Raises `NoFrame`."""
        if index is None:
            return None
        if not 0 <= index < len(self.frames):
            raise NoFrame(f"there is no frame {index}: {len(self.frames)} calls are open. Ask for the stack again")
        return self.frames[index]


class NoFrame(Exception):
    """A frame that is not there (any more), or a scope that it does not have: a sentence for people."""


def at(frame: Frame | None) -> tuple[Pou | None, int]:
    """The POU in whose scope a text is understood, and its instance."""
    return (None, 0) if frame is None else (frame.pou, frame.instance)
