"""Campaigns of disturbances: messages between the server and a job process, and what browsers are told."""

from dataclasses import dataclass
from typing import Literal

from scanbench.history.campaign.contract import CampaignWanted, Outcome, Trial
from scanbench.public import Public


@dataclass(frozen=True, slots=True)
class RunCampaign:
    """Tries disturbances on the run, as far as it is over before scan `until`. Answered with a `TrialDone` for each, then
    `CampaignDone`."""

    ref: int
    run: str
    wanted: CampaignWanted
    until: int
    created: str
    """When that run was begun: a new one has the same file. Empty: nobody knows."""
    only: tuple[int, ...] = ()
    """These numbers; empty: all."""
    to: str = ""
    """Where the run file of the last of them is left."""


@dataclass(frozen=True, slots=True)
class TrialDone:
    """What came of one, and of how many."""

    ref: int
    trial: Trial
    of: int


@dataclass(frozen=True, slots=True)
class CampaignDone:
    """All were tried."""

    ref: int


@dataclass(frozen=True, slots=True)
class CampaignCount(Public):
    """So many disturbances ended like this."""

    outcome: Outcome
    count: int


@dataclass(frozen=True, slots=True)
class CampaignState(Public):
    """How far a campaign of disturbances is, and how many ended how. The last 10 of an instance are kept."""

    id: int
    instance: int
    by: str
    wanted: CampaignWanted
    done: int = 0
    of: int = 0
    outcomes: tuple[CampaignCount, ...] = ()
    """Those that there were."""
    silent: int = 0
    """So many made an output wrong, and the program did not notice it."""
    over: bool = False
    message: str = ""
    """Why it did not come to its end."""
    type: Literal["campaign"] = "campaign"
