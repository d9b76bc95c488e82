"""REST: questions about the past of a run: who wrote this, what changed, where two runs part, what if."""

import asyncio
from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import Response

from scanbench.history.contract import Changes, RerunChange, Writer
from scanbench.history.whatif.contract import WhatIf, WhatIfWanted
from scanbench.web import messages_past as wire
from scanbench.web import messages_whatif
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id, Scan
from scanbench.web.reach import Bench
from scanbench.wire.comparisons import Comparison, Rerun
from scanbench.wire.refused import Refused

router = APIRouter(prefix="/api", tags=["past"])
_LOOK_S = 0.25
"""How often it is looked whether somebody still waits for an answer that takes long."""


@router.get("/instances/{instance}/last-write")
async def on_last_write(
    bench: Bench, instance: Id, path: Annotated[str, Query(min_length=1, max_length=2000)], scan: Scan | None = None
) -> Writer:
    """Who last wrote a variable before `scan` began, or before what is shown now."""
    return await bench.history.last_writer(bench.session(instance), path, scan)


@router.get("/instances/{instance}/changes")
async def on_changes(bench: Bench, instance: Id, first: Scan, last: Scan, other: Id | None = None) -> Changes:
    """The variables that differ between the beginnings of scans `first` and `last`; with `other`, in that instance at `last`."""
    second = None if other is None else bench.session(other)
    return await bench.history.changes(bench.session(instance), first, last, second)


@router.get("/instances/{instance}/scenario", response_class=Response)
async def on_scenario(bench: Bench, instance: Id, scan: Scan | None = None) -> Response:
    """A scenario file of what people and protocol clients did before `scan`, or so far: a test that expects the outputs to be the same again."""
    session = bench.session(instance)
    text = await bench.history.scenario(session, scan)
    name = f'attachment; filename="{session.id}.scenario.yaml"'
    return Response(text, media_type="application/yaml", headers={"content-disposition": name})


@router.get("/instances/{instance}/comparisons")
async def on_comparisons(bench: Bench, instance: Id) -> list[Comparison]:
    """The comparisons of this run with others, the newest first."""
    return bench.history.comparisons(bench.session(instance))


@router.post("/instances/{instance}/comparisons", status_code=201)
async def on_compare(bench: Bench, request: Request, instance: Id, new: wire.NewComparison) -> Comparison:
    """Compares this run (A) with a second one (B), scan by scan; progress comes by A's WebSocket."""
    a, b = bench.session(instance), bench.session(new.other)
    return bench.history.compare(a, b, user_of(request).name)


@router.get("/comparisons/{comparison}")
async def on_comparison(bench: Bench, comparison: Id) -> Comparison:
    """A comparison: how far it is, and what came of it."""
    return bench.history.comparison(comparison)


@router.delete("/comparisons/{comparison}", status_code=204)
async def on_delete_comparison(bench: Bench, comparison: Id) -> None:
    """Cancels a comparison, or deletes its result."""
    await bench.history.forget(comparison)


@router.post("/instances/{instance}/what-if")
async def on_what_if(bench: Bench, request: Request, instance: Id, new: messages_whatif.NewWhatIf) -> WhatIf:
    """Goes on with the recorded run from a scan with other values of some inputs: as given, each of several, or the smallest change with
    which a condition holds. The PLC goes on meanwhile. The answer comes when all is tried."""
    wanted = WhatIfWanted(
        new.scan, tuple(new.values), new.vary.strip(), tuple(new.tried), new.search, tuple(new.candidates), new.hold,
        new.window, new.condition.strip(), tuple(new.watch),
    )  # fmt: skip
    trying = asyncio.ensure_future(bench.history.what_if(bench.session(instance), wanted))
    try:
        while not (await asyncio.wait({trying}, timeout=_LOOK_S))[0]:
            if await request.is_disconnected():
                raise Refused("nobody waits for the answer any more")
        return trying.result()
    finally:
        trying.cancel()


@router.post("/instances/{instance}/reruns", status_code=201)
async def on_rerun(bench: Bench, request: Request, instance: Id, new: wire.NewRerun) -> Rerun:
    """Replays the run with one error changed, as a new instance; progress comes by this instance's WebSocket."""
    change = RerunChange(new.scan, new.error, new.by, new.instead, new.leave_out, new.scans_after)
    return await bench.history.rerun(bench.session(instance), change, new.name.strip(), user_of(request).name)


@router.get("/reruns/{rerun}")
async def on_rerun_state(bench: Bench, rerun: Id) -> Rerun:
    """A replay: how far it is, and which instance came of it."""
    return bench.history.rerun_of(rerun)


@router.delete("/reruns/{rerun}", status_code=204)
async def on_cancel_rerun(bench: Bench, rerun: Id) -> None:
    """Cancels a replay."""
    await bench.history.cancel_rerun(rerun)
