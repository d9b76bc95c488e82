"""What is asked by REST about inputs with other values; what comes of it is in `history/whatif/contract.py`."""

from pydantic import Field

from scanbench.history.whatif.contract import MOST_SET, MOST_TRIES, MOST_WINDOW, SetValue
from scanbench.web.messages_base import Scan, Wire

_PATH = 2000


class NewWhatIf(Wire):
    """Inputs of the recorded run with other values, from a scan on; see `history.whatif.contract.WhatIfWanted`."""

    scan: Scan = Field(description="the values are set before this scan")
    values: list[SetValue] = Field(default=[], max_length=MOST_SET, description="in every try")
    vary: str = Field(default="", max_length=_PATH, description="of this variable each of the values `tried`")
    tried: list[str] = Field(default=[], max_length=MOST_TRIES)
    search: bool = Field(
        default=False, description="looks for the smallest change of `candidates` with which the condition holds"
    )
    candidates: list[str] = Field(default=[], max_length=MOST_SET)
    hold: bool = Field(default=True, description="forced all the time; else written once")
    window: int = Field(
        default=100, ge=1, le=MOST_WINDOW, description="so many scans are run, `scan` the first of them"
    )
    condition: str = Field(default="", max_length=_PATH, description="what is to be, in ST: `Main.valve = 3`")
    watch: list[str] = Field(default=[], max_length=MOST_SET, description="variables whose values at the end are told")
