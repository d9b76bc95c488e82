"""A request and its outcome in words, for the log of frames."""

from scanbench.comm.fins.areas import Form, element
from scanbench.comm.fins.codes import End, Refused
from scanbench.comm.fins.commands import NAMES
from scanbench.comm.fins.frame import Request
from scanbench.plcmodel.model import Model

_COUNTED = {0x0101, 0x0102, 0x0103}
_SEVERAL, _TRANSFER = 0x0104, 0x0105
_SHOWN = 4

OUTCOMES = {
    End.NO_UNIT: "no such unit: DA2 has to be 00, the CPU Unit",
    End.UNDEFINED: "the model does not know this command",
    End.TOO_LONG: "the request is too long",
    End.TOO_SHORT: "the request is too short",
    End.NOT_AS_MANY: "not as many data as elements",
    End.NO_AREA: "the model has no such memory area",
    End.BEGINS_OUTSIDE: "the first address is outside of the area",
    End.ENDS_OUTSIDE: "the last address is outside of the area",
    End.ANSWER_TOO_LONG: "the answer would be too long",
    End.PARAMETER: "a parameter is wrong",
    End.READ_ONLY: "this memory is read-only",
    End.PROTECTED: "this server lets clients read only",
    End.CANNOT_CHANGE: "this cannot be changed",
    End.NOT_NOW: "not possible now",
    End.NOT_IN_PROGRAM: "not possible in PROGRAM mode",
    End.NOT_IN_RUN: "not possible in RUN mode",
    End.SERVICE_BUSY: "the PLC does not answer now",
    End.NOT_CLEARED: "the cause of the error is still there",
}


def outcome(end: End) -> str:
    """Empty for a normal end."""
    return f"{end:04X} {OUTCOMES[end]}" if end else ""


def described(request: Request, model: Model) -> str:
    """`memory area read D100, 3`; a command that nobody knows by its number."""
    name = NAMES.get(request.command, f"command {request.command:04X}")
    body = request.body
    if request.command in _COUNTED and len(body) >= 6:  # place and count
        return f"{name} {place(model, body[:4])}, {int.from_bytes(body[4:6], 'big')}"
    if request.command == _SEVERAL:
        places = [place(model, body[at : at + 4]) for at in range(0, len(body) - 3, 4)]
        return f"{name} {', '.join(places[:_SHOWN])}{', ...' if len(places) > _SHOWN else ''}"
    if request.command == _TRANSFER and len(body) == 10:  # two places and a count
        return f"{name} {place(model, body[:4])} to {place(model, body[4:8])}, {int.from_bytes(body[8:], 'big')}"
    return name


def place(model: Model, code: bytes) -> str:
    """An area code and an address in the vendor's notation; in hexadecimal where they mean nothing."""
    try:
        found = element(model, code[0], int.from_bytes(code[1:3], "big"), code[3])
        found.spans(1)
    except Refused:
        return code.hex()
    if found.area is None:
        return code.hex()
    bit = found.form in (Form.BIT, Form.FORCED_BIT)
    byte = 2 * found.word + (found.bit // 8 if bit else 0)
    return model.format(found.area, byte, found.bit % 8 if bit else None, 1 if bit else 16)
