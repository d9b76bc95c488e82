"""Campaigns of a server: many random disturbances, tried on the run of a PLC in a job process, while the PLC goes on."""

import asyncio
import logging
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from scanbench.history.campaign.contract import OUTCOMES, CampaignWanted, Trial
from scanbench.host.run_files import created
from scanbench.jobs.client import FAULT, alone
from scanbench.runtime.clock import fresh_token, monotonic_ns
from scanbench.server.going import GoingFiles
from scanbench.server.history import Open
from scanbench.session.session import Session
from scanbench.store.records import NameTaken, NotFound
from scanbench.wire.campaigns import CampaignCount, CampaignDone, CampaignState, RunCampaign, TrialDone
from scanbench.wire.refused import Refused

log = logging.getLogger("scanbench")

KEPT = 10
"""Campaigns of an instance."""
MOST = 2
"""At a time."""
_TOLD_EVERY_NS = 250_000_000


@dataclass
class _Campaign:
    session: Session
    state: CampaignState
    run: str
    until: int
    created: str
    """When the run was begun."""
    trials: list[Trial] = field(default_factory=list)
    task: "asyncio.Task[None] | None" = None
    told: int = 0

    @property
    def over(self) -> bool:
        return self.task is None or self.task.done()

    @property
    def came_to_nothing(self) -> bool:
        """Why is told until there is a next one."""
        return self.state.over and self.state.message != "" and not self.trials


class Campaigns:
    """Of all PLCs of a server. What they tried is in memory; after a restart of the server they are tried again, which comes to the
    same, as the seed says which ones."""

    def __init__(self, runs: Path, cache: Path, open: Open) -> None:
        self._runs, self._cache, self._open = runs, cache, open
        self._next = 1
        self._all: dict[int, _Campaign] = {}
        self._taking_up = asyncio.Lock()
        self._going = GoingFiles(runs.with_name("campaigns"))

    async def close(self) -> None:
        """Ends what runs; it comes back when the server starts again."""
        tasks = [each.task for each in self._all.values() if each.task is not None]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        await self._going.close()

    async def take_up(self, sessions: Mapping[int, Session]) -> None:
        """Those that were there when the server ended, one after the other; until then they say that they wait."""
        for each in await asyncio.to_thread(lambda: list(self._going.all())):
            self._next = max(self._next, each.id + 1)
            state = each.status
            session = sessions.get(state.instance) if isinstance(state, CampaignState) else None
            if session is None:
                self._going.forget(each.id)
                continue
            assert isinstance(state, CampaignState)
            fresh = replace(state, done=0, outcomes=(), silent=0, over=False, message="")
            more = each.more
            campaign = self._all[each.id] = _Campaign(session, fresh, more["run"], int(more["until"]), more["created"])
            campaign.task = asyncio.get_running_loop().create_task(self._again(campaign))

    async def _again(self, campaign: _Campaign) -> None:
        async with self._taking_up:
            await self._run(campaign)

    async def forget_instance(self, instance: int) -> None:
        """Ends those of an instance that goes."""
        for id, each in list(self._all.items()):
            if each.session.id == instance:
                await self.forget(id)

    def of(self, session: Session) -> list[CampaignState]:
        """Those of an instance, the newest first."""
        return [each.state for each in reversed(self._all.values()) if each.session is session]

    def whole(self, id: int) -> tuple[CampaignState, tuple[Trial, ...]]:
        """One, with what was tried so far."""
        campaign = self._get(id)
        return campaign.state, tuple(campaign.trials)

    async def begin(self, session: Session, wanted: CampaignWanted, author: str) -> CampaignState:
        """Begins one."""
        run, until = session.instance.run_file, _until(session)
        begun = await asyncio.to_thread(created, run)
        running = sum(not each.over for each in self._all.values())
        if running >= MOST:
            raise Refused(f"{running} campaigns go on already: wait for one, or cancel it")
        over = [id for id, each in self._all.items() if each.session is session and each.over]
        worth = [id for id in over if not self._all[id].came_to_nothing]
        for id in over:
            if id not in worth[-(KEPT - 1) :]:
                del self._all[id]
                self._going.forget(id)
        id, self._next = self._next, self._next + 1
        state = CampaignState(id, session.id, author, wanted, of=wanted.count)
        campaign = self._all[id] = _Campaign(session, state, str(run), until, begun)
        campaign.task = asyncio.get_running_loop().create_task(self._run(campaign))
        self._going.keep(id, state, {"run": str(run), "until": str(until), "created": begun})
        _tell(campaign)
        return campaign.state

    async def forget(self, id: int) -> None:
        """Cancels one, or forgets what came of it."""
        campaign = self._get(id)
        del self._all[id]
        self._going.forget(id)
        if campaign.task is not None and not campaign.over:
            campaign.task.cancel()
            await asyncio.wait((campaign.task,))
            _tell(campaign, message="cancelled", over=True)

    async def open_trial(self, id: int, number: int, author: str) -> Session:
        """A new paused PLC that goes on with the run as it was disturbed."""
        campaign = self._get(id)
        wanted = campaign.state.wanted
        to = self._runs / f"campaign-{fresh_token()}"

        async def on_part(part: object) -> None:
            """What came of it is known."""

        try:
            await alone(
                self._cache,
                lambda ref: RunCampaign(
                    ref, campaign.run, wanted, campaign.until, campaign.created, (number,), str(to)
                ),
                CampaignDone,
                on_part,
            )
            name = f"{campaign.session.name}, disturbance {number}"
            session = await self._opened(campaign.session, name, to, author)
            text = next((each.text for each in campaign.trials if each.number == number), "")
            session.log.add(author, f"disturbance {number} of the campaign with seed {wanted.seed}: {text}")
            return session
        finally:
            await asyncio.to_thread(to.unlink, True)

    async def _opened(self, origin: Session, name: str, path: Path, author: str) -> Session:
        """The PLC under this name, or the next one that is free: the same disturbance can be opened twice."""
        for again in range(2, 100):
            try:
                return await self._open(origin, name if again == 2 else f"{name} ({again - 1})", path, author)
            except NameTaken:
                continue
        return await self._open(origin, name, path, author)

    async def _run(self, campaign: _Campaign) -> None:
        id, wanted = campaign.state.id, campaign.state.wanted

        async def on_part(part: object) -> None:
            if isinstance(part, TrialDone):
                campaign.trials.append(part.trial)
                if monotonic_ns() - campaign.told > _TOLD_EVERY_NS:
                    _tell(campaign)

        try:
            await alone(
                self._cache,
                lambda ref: RunCampaign(ref, campaign.run, wanted, campaign.until, campaign.created),
                CampaignDone,
                on_part,
            )
            _tell(campaign, over=True)
        except Refused as why:
            _tell(campaign, message=why.message, over=True)
            if campaign.came_to_nothing:
                self._going.forget(id)
        except Exception:
            log.exception("a campaign came to nothing")
            _tell(campaign, message=FAULT, over=True)

    def _get(self, id: int) -> _Campaign:
        campaign = self._all.get(id)
        if campaign is None:
            raise NotFound(f"there is no campaign {id}: it was forgotten, or the server has started again")
        return campaign


def _tell(campaign: _Campaign, message: str = "", over: bool = False) -> None:
    counted = Counter(each.outcome for each in campaign.trials)
    outcomes = tuple(CampaignCount(each, counted[each]) for each in OUTCOMES if counted[each])
    silent = sum(each.silent for each in campaign.trials)
    campaign.told = monotonic_ns()
    campaign.state = replace(
        campaign.state, done=len(campaign.trials), outcomes=outcomes, silent=silent, message=message, over=over
    )
    campaign.session.tell(campaign.state)


def _until(session: Session) -> int:
    """Scans before this one are over; 0 where nobody knows but the run file."""
    state = session.state
    return max(state.scan, state.live_scan) if session.instance.on else 0
