"""REST: campaigns: many random disturbances, each tried alone on the run of a PLC, and who noticed each."""

import json
from typing import Literal

from fastapi import APIRouter, Request
from fastapi.responses import Response

from scanbench.history.campaign.contract import KINDS, Campaign, CampaignWanted
from scanbench.reports.campaign_report import CampaignReport, campaign_json, campaign_junit
from scanbench.session.session import Session
from scanbench.web import messages_campaigns as wire
from scanbench.web import translate
from scanbench.web.auth import user_of
from scanbench.web.messages import Instance
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench
from scanbench.wire.campaigns import CampaignState

router = APIRouter(prefix="/api", tags=["campaigns"])
_MOST = 500
"""Scans that are disturbed where nobody says which: the last of the run."""


@router.get("/instances/{instance}/campaigns")
async def on_campaigns(bench: Bench, instance: Id) -> list[CampaignState]:
    """The campaigns of this PLC, the newest first."""
    return bench.campaigns.of(bench.session(instance))


@router.post("/instances/{instance}/campaigns", status_code=201)
async def on_new_campaign(bench: Bench, request: Request, instance: Id, new: wire.NewCampaign) -> CampaignState:
    """Begins a campaign on the recorded run; the PLC goes on meanwhile. Progress comes by this instance's WebSocket."""
    session = bench.session(instance)
    return await bench.campaigns.begin(session, _wanted(session, new), user_of(request).name)


@router.get("/campaigns/{campaign}")
async def on_campaign(bench: Bench, campaign: Id) -> wire.WholeCampaign:
    """A campaign with what was tried so far."""
    state, trials = bench.campaigns.whole(campaign)
    return wire.WholeCampaign(state=state, trials=list(trials))


@router.get("/campaigns/{campaign}/export", response_class=Response)
async def on_export(
    bench: Bench, campaign: Id, format: Literal["json", "junit"] = "json", require: Literal["any", "program"] = "any"
) -> Response:
    """The same as `scanbench campaign --json` and `--junit` write."""
    state, trials = bench.campaigns.whole(campaign)
    session = bench.session(state.instance)
    project = await bench.projects.get(session.project_id)
    report = CampaignReport(
        project.name, session.model.name, Campaign(state.wanted, trials), state.of, require, instance=session.name
    )
    if format == "junit":
        return Response(campaign_junit(report), media_type="application/xml")
    return Response(json.dumps(campaign_json(report), ensure_ascii=False), media_type="application/json")


@router.delete("/campaigns/{campaign}", status_code=204)
async def on_delete_campaign(bench: Bench, campaign: Id) -> None:
    """Cancels a campaign, or deletes its result."""
    await bench.campaigns.forget(campaign)


@router.post("/campaigns/{campaign}/trials/{number}/open", status_code=201)
async def on_open_trial(bench: Bench, request: Request, campaign: Id, number: Id) -> Instance:
    """A new paused PLC that goes on with the run as this disturbance made it: one can go to its scan, and verify it."""
    session = await bench.campaigns.open_trial(campaign, number, user_of(request).name)
    return translate.instance(session, await bench.projects.get(session.project_id))


def _wanted(session: Session, new: wire.NewCampaign) -> CampaignWanted:
    live = max(session.state.scan, session.state.live_scan)
    last = live - 1 if new.last is None else new.last
    first = max(0, last - _MOST + 1) if new.first is None else new.first
    alarms = tuple(each.strip() for each in new.alarms if each.strip())
    kinds = tuple(each for each in KINDS if each in new.kinds)
    return CampaignWanted(new.seed, new.count, first, last, new.window, kinds, alarms)
