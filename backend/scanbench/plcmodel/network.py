"""The logical ports of a model's communications instructions, as its catalogue of errors describes them. (W340, p.1018.)"""

from dataclasses import dataclass

from scanbench.plcmodel.model import ErrorEntry, Location, Model

COMPLETION_CODE = "completion-code"
"""The detail of an error of a port: how the instruction ended."""
_MOST = 8


@dataclass(frozen=True, slots=True)
class Port:
    """One of them."""

    number: int
    error: ErrorEntry
    """What is present while the last instruction on it failed; its flag is that of the port."""
    code: Location
    """The word with the completion code."""
    enabled: Location
    """The bit that is on while an instruction can be executed on it: in the word before the codes (A202, A203 to A210; K-H)."""


def ports(model: Model) -> tuple[Port, ...]:
    """Those that the model has, from port 0 on; empty where it has no communications instructions."""
    found: list[Port] = []
    for number in range(_MOST):
        error = model.error(f"communications-port-{number}-error")
        detail = error.detail(COMPLETION_CODE) if error is not None else None
        code = detail.addresses[0].location if detail is not None else None
        if error is None or code is None:
            break
        first = found[0].code if found else code
        enabled = Location(first.area, first.byte - 2, number, 1)
        found.append(Port(number, error, code, enabled))
    return tuple(found)
