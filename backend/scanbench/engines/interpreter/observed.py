"""Reference engines that are observed; see `engines.observe`."""

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.observer import ReferenceObserver
from scanbench.engines.observe import Observed
from scanbench.program.program import Program


def observed_engine(program: Program, memory: bytearray) -> Observed:
    """An engine on this image, and what it notes."""
    observer = ReferenceObserver(program)
    return ReferenceEngine(program, memory, observer), observer
