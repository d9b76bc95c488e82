"""An injection campaign: many random disturbances, each tried alone, and who noticed it."""

from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.faults.disturb.definition import DisturbanceKind
from scanbench.public import Public
from scanbench.verify.contract import Place

Outcome = Literal["both", "verification", "program", "nothing", "no effect", "missed"]
"""Who noticed it. nothing: an output, or what the program remembers, is different, and nobody noticed. no effect: nobody noticed, and
at the end nothing was different, nor any output in between. missed: it did not come about."""
OUTCOMES: tuple[Outcome, ...] = ("both", "verification", "program", "nothing", "no effect", "missed")
KINDS: tuple[DisturbanceKind, ...] = ("flip", "result", "stuck", "late")
MOST_TRIALS = 10_000
MOST_SCANS = 100_000
"""In which disturbances may come."""
MOST_WINDOW = 10_000


class BadCampaign(Exception):
    """It cannot be done; the message says why, and what to do."""


@dataclass(frozen=True, slots=True)
class CampaignWanted(Public):
    """What is tried. The same of the same run gives the same disturbances, on every machine."""

    PUBLIC: ClassVar = "CampaignWanted"

    seed: int = 1
    count: int = 100
    first: int = 0
    """The disturbances come in these scans, ..."""
    last: int = 0
    """... this one included."""
    window: int = 100
    """Scans after a disturbance in which the program may notice it."""
    kinds: tuple[DisturbanceKind, ...] = KINDS
    alarms: tuple[str, ...] = ()
    """Conditions that say that the program has noticed something, where they hold and would not hold otherwise: `Main.alarm`."""


@dataclass(frozen=True, slots=True)
class Trial(Public):
    """One disturbance, and what came of it."""

    PUBLIC: ClassVar = "CampaignTrial"

    number: int
    """From 1."""
    text: str
    """`Memory Main.count, bit 3, once in scan 500`"""
    kind: DisturbanceKind
    scan: int
    outcome: Outcome
    verification: str = ""
    """The first difference that the second execution found, ..."""
    verified_scan: int | None = None
    """... and in which scan."""
    place: Place | None = None
    """Where in the program that was."""
    program: tuple[str, ...] = ()
    """What the program, or the PLC that runs it, did that it would not have done otherwise, ..."""
    program_scan: int | None = None
    """... and the scan in which that began."""
    output_scan: int | None = None
    """After this scan an output was different for the first time."""
    differs: bool = False
    """Whether anything that the program remembers was different at the end of the window."""
    trapped: bool = False
    """A run-time error stopped the program."""
    refused: tuple[str, ...] = ()
    """What somebody had entered in the run, and the PLC did not take this time, but does without the disturbance; and why."""
    why: str = ""
    """missed: why."""
    unvalued: tuple[str, ...] = ()
    """Of each alarm that had no value after a scan, since the disturbance: which, and after which scan first. There it noticed nothing."""

    @property
    def silent(self) -> bool:
        """Whether an output was wrong, and the program did not notice it."""
        return self.output_scan is not None and not self.program


@dataclass(frozen=True, slots=True)
class Campaign:
    """All that was tried."""

    wanted: CampaignWanted
    trials: tuple[Trial, ...]

    def count(self, outcome: Outcome) -> int:
        """So many ended like this."""
        return sum(each.outcome == outcome for each in self.trials)
