"""Which error of the catalogue a trap is."""

from scanbench.plcmodel.model import ErrorEntry, Model
from scanbench.program.sites import TrapKind
from scanbench.runtime.trap import TrapInfo

CYCLE_TIME_OVER, PROGRAM_ERROR = "cycle-time-over", "program-error"
"""Ids of the errors that a PLC finds, in every model that has them."""


def error_of(model: Model, info: TrapInfo) -> ErrorEntry | None:
    """The error that the device reports; None where the model has none, or an instruction (FALS) reports its own."""
    kind = TrapKind(info.kind)
    if kind is TrapKind.FATAL:
        return None
    return model.error(CYCLE_TIME_OVER if kind is TrapKind.LOOP else PROGRAM_ERROR)
