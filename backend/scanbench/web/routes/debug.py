"""REST: what a debugger shows of one PLC, for scripts and links: coverage."""

from fastapi import APIRouter
from fastapi.responses import PlainTextResponse

from scanbench.taps.lcov import lcov
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench
from scanbench.wire.debugging import Coverage

router = APIRouter(prefix="/api/instances/{instance}", tags=["debug"])


@router.get("/coverage")
async def on_coverage(bench: Bench, instance: Id) -> Coverage:
    """Statements and branches that were reached since coverage was switched on."""
    return await bench.session(instance).debugging.reached()


@router.get("/coverage.lcov", response_class=PlainTextResponse)
async def on_lcov(bench: Bench, instance: Id) -> PlainTextResponse:
    """The same as LCOV, for genhtml and CI."""
    session = bench.session(instance)
    name = f"attachment; filename=scanbench-{session.id}.lcov"
    return PlainTextResponse(lcov((await session.debugging.reached()).files), headers={"Content-Disposition": name})
