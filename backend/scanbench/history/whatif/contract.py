"""What if: inputs of a recorded run are set to other values at a scan, and the run goes on from there."""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.public import Public

MOST_TRIES = 200
MOST_WINDOW = 10_000
MOST_SCANS = 500_000
"""Of all tries together."""
MOST_SET = 50
"""Variables that are set, varied, or searched among."""


class BadWhatIf(Exception):
    """It cannot be tried; the message says why, and what to do."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.near = near


@dataclass(frozen=True, slots=True)
class SetValue(Public):
    """A variable or address, and its value as typed."""

    PUBLIC: ClassVar = "WhatIfValue"

    path: str
    value: str


@dataclass(frozen=True, slots=True)
class WhatIfWanted(Public):
    """What is tried: the `values` in every try; with `vary`, each of the values `tried`; with `search`, the smallest change of the variables
    `candidates` with which `condition` holds. None of them: one try."""

    PUBLIC: ClassVar = "WhatIfWanted"

    scan: int
    """The values are set before this scan, after all that was entered there."""
    values: tuple[SetValue, ...] = ()
    vary: str = ""
    tried: tuple[str, ...] = ()
    """Values as typed, or ranges of whole numbers: `0..100/5`."""
    search: bool = False
    candidates: tuple[str, ...] = ()
    hold: bool = True
    """The values are forced all the time; else they are written once."""
    window: int = 100
    """So many scans are run, `scan` the first of them."""
    condition: str = ""
    """What is to be, in ST: `Main.valve = 3`. It is met where it holds after one of the scans."""
    watch: tuple[str, ...] = ()
    """Variables and addresses whose values after the last scan are told."""


@dataclass(frozen=True, slots=True)
class Try(Public):
    """What came of one set of values."""

    PUBLIC: ClassVar = "WhatIfTry"

    values: tuple[SetValue, ...]
    """None: the run as it was recorded."""
    met: int | None = None
    """After this scan the condition held for the first time."""
    unvalued: int | None = None
    """After this scan, before it held, the condition had no value for the first time."""
    output_scan: int | None = None
    """After this scan an output (%Q) was different from the recorded run for the first time."""
    shown: tuple[str, ...] = ()
    """The values of what is watched."""
    trapped: str = ""
    """The run-time error that stopped the program, and where."""
    refused: tuple[str, ...] = ()
    """A value that the PLC did not take, then nothing was run; or what had been entered later, and was not taken this time."""
    ran: int = 0
    """Scans."""
    compared: int = 0
    """Scans of which the outputs were compared: the recorded run may have ended before."""


@dataclass(frozen=True, slots=True)
class WhatIf(Public):
    """All that was tried."""

    PUBLIC: ClassVar = "WhatIf"

    wanted: WhatIfWanted
    recorded: Try
    tries: tuple[Try, ...]
    best: int | None = None
    """Of a search: the index of the smallest change that was found."""
    note: str = ""
    """What the search did not look at, and why a row may differ from the recorded run."""
    scenario: str = ""
    """A scenario file that does the same from a cold start and expects the condition; empty where there can be none."""
    undisturbed: Try | None = None
    """Where a disturbance came in the recorded run: without it, as all tries are, and with no other value."""
