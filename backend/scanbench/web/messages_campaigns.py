"""What is asked about campaigns by REST; what comes of them is in `history/campaign/contract.py` and `wire/events.py`."""

from pydantic import Field

from scanbench.faults.disturb.definition import DisturbanceKind
from scanbench.history.campaign.contract import KINDS, MOST_WINDOW, Trial
from scanbench.web.messages_base import Scan, Wire
from scanbench.wire.campaigns import CampaignState


class NewCampaign(Wire):
    """The same numbers on the same run try the same disturbances."""

    count: int = Field(default=100, ge=1, le=2_000)
    seed: int = Field(default=1, ge=0, le=(1 << 53) - 1)
    first: Scan | None = Field(
        default=None, description="the disturbances come from this scan on; else in the last 500"
    )
    last: Scan | None = Field(default=None, description="up to this one; else to the end of the run so far")
    window: int = Field(default=100, ge=0, le=MOST_WINDOW, description="scans in which the program may notice each")
    kinds: list[DisturbanceKind] = Field(default=list(KINDS), min_length=1, max_length=len(KINDS))
    alarms: list[str] = Field(
        default=[], max_length=10, description="conditions that say that the program has noticed something"
    )


class WholeCampaign(Wire):
    """A campaign, and what came of each disturbance that was tried so far."""

    state: CampaignState
    trials: list[Trial]
