"""Answers of the REST API: disturbances, and campaigns of them. Made by `python -m tests.client_shapes`; do not edit."""

from typing import Literal, TypedDict

from scanbench.client.shapes.past import VerifyPlace


class DisturbanceInfo(TypedDict):
    """A disturbance that is not over, or was missed, for people."""

    id: int
    text: str
    """`Memory D120, bit 0, once in scan 500`"""
    kind: Literal["flip", "late", "stuck", "result"]
    by: str
    state: Literal["waiting", "active", "missed"]
    """missed: its time is over and nothing was changed; it is listed until it is taken back."""
    fired: int
    """How often until now."""
    next_scan: int | None
    why: str
    """missed: the scan, and why."""


class CampaignWanted(TypedDict):
    """What is tried. The same of the same run gives the same disturbances, on every machine."""

    seed: int
    count: int
    first: int
    """The disturbances come in these scans, ..."""
    last: int
    """... this one included."""
    window: int
    """Scans after a disturbance in which the program may notice it."""
    kinds: list[Literal["flip", "late", "stuck", "result"]]
    alarms: list[str]
    """Conditions that say that the program has noticed something, where they hold and would not hold otherwise: `Main.alarm`."""


class CampaignCount(TypedDict):
    """So many disturbances ended like this."""

    outcome: Literal["both", "verification", "program", "nothing", "no effect", "missed"]
    count: int


class CampaignState(TypedDict):
    """How far a campaign of disturbances is, and how many ended how. The last 10 of an instance are kept."""

    id: int
    instance: int
    by: str
    wanted: CampaignWanted
    done: int
    of: int
    outcomes: list[CampaignCount]
    """Those that there were."""
    silent: int
    """So many made an output wrong, and the program did not notice it."""
    over: bool
    message: str
    """Why it did not come to its end."""
    type: Literal["campaign"]


class CampaignTrial(TypedDict):
    """One disturbance, and what came of it."""

    number: int
    """From 1."""
    text: str
    """`Memory Main.count, bit 3, once in scan 500`"""
    kind: Literal["flip", "late", "stuck", "result"]
    scan: int
    outcome: Literal["both", "verification", "program", "nothing", "no effect", "missed"]
    verification: str
    """The first difference that the second execution found, ..."""
    verified_scan: int | None
    """... and in which scan."""
    place: VerifyPlace | None
    """Where in the program that was."""
    program: list[str]
    """What the program, or the PLC that runs it, did that it would not have done otherwise, ..."""
    program_scan: int | None
    """... and the scan in which that began."""
    output_scan: int | None
    """After this scan an output was different for the first time."""
    differs: bool
    """Whether anything that the program remembers was different at the end of the window."""
    trapped: bool
    """A run-time error stopped the program."""
    refused: list[str]
    """What somebody had entered in the run, and the PLC did not take this time, but does without the disturbance; and why."""
    why: str
    """missed: why."""
    unvalued: list[str]
    """Of each alarm that had no value after a scan, since the disturbance: which, and after which scan first. There it noticed nothing."""


class WholeCampaign(TypedDict):
    """A campaign, and what came of each disturbance that was tried so far."""

    state: CampaignState
    trials: list[CampaignTrial]
