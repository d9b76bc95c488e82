"""The ST text of the communications instructions SEND, RECV and CMND of a model that has ports for them.

They only ask: what is asked leaves the PLC in the seam after the scan (`faults/network.py`), which reads the control words then. Each
takes four entries of `Layout.ASKED`: itself, and where its three operands lie.
"""

from typing import Literal

from scanbench.check.system.system_text import Form
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.network import ports
from scanbench.program.layout import Layout

Instruction = Literal["SEND", "RECV", "CMND"]
NAMES: tuple[Instruction, ...] = ("SEND", "RECV", "CMND")
"""By the number that an entry has for an instruction."""
PLACES = "__ASKED_PLACES"
"""The entries of `Layout.ASKED` as references."""
OPERANDS = ("S", "D", "C")


def network_instructions(model: Model) -> list[str]:
    """A function for each."""
    return [_instruction(number, name) for number, name in enumerate(NAMES)] if ports(model) else []


def _instruction(number: int, name: str) -> str:
    entries = 1 + len(OPERANDS)
    places = "\n".join(f"{PLACES}[__ASKED_COUNT + {at}] := REF({each});" for at, each in enumerate(OPERANDS, 1))
    return f"""\
FUNCTION {name} : BOOL
VAR_IN_OUT {", ".join(OPERANDS)} : WORD; END_VAR
IF __ASKED_COUNT <= {Layout.ASKED_LIMIT - entries} THEN
__ASKED[__ASKED_COUNT] := ULINT_TO_LWORD({Form.NETWORK * 256 + number});
{places}
__ASKED_COUNT := __ASKED_COUNT + {entries};
{name} := TRUE;
END_IF;
END_FUNCTION
"""
