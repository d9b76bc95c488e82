"""REST: what a debugger shows of one PLC, for scripts and links: coverage, diagnostics, breakpoints."""

from fastapi import APIRouter, Request
from fastapi.responses import PlainTextResponse

from scanbench.taps.lcov import lcov
from scanbench.web import translate, translate_debug
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.messages_debug import BreakpointInfo, ChangeCoverage
from scanbench.web.messages_diagnostics import Diagnostics
from scanbench.web.messages_errors import CommandResult
from scanbench.web.reach import Bench
from scanbench.web.translate_errors import command_result
from scanbench.wire.debugging import Coverage

router = APIRouter(prefix="/api/instances/{instance}", tags=["debug"])


@router.get("/coverage")
async def on_coverage(bench: Bench, instance: Id) -> Coverage:
    """Statements and branches that were reached since coverage was switched on."""
    return await bench.session(instance).debugging.reached()


@router.patch("/coverage")
async def on_cover(bench: Bench, request: Request, instance: Id, wanted: ChangeCoverage) -> CommandResult:
    """Notes which statements and branches are reached from now on, or no longer."""
    debugging = bench.session(instance).debugging
    return command_result(await debugging.cover(wanted.on, wanted.reset, user_of(request).name))


@router.get("/breakpoints")
async def on_breakpoints(bench: Bench, instance: Id) -> list[BreakpointInfo]:
    """All breakpoints of the PLC, whoever manages them; they are set by DAP, on the PLC's sockets."""
    return list(map(translate_debug.breakpoint, bench.session(instance).debugging.verdicts))


@router.get("/diagnostics")
async def on_diagnostics(bench: Bench, instance: Id) -> Diagnostics:
    """The values that left their subrange, since this was cleared last."""
    session = bench.session(instance)
    await session.forces.now()  # before that is answered, what was counted is told
    return translate.diagnostics(session.log.violations)


@router.get("/coverage.lcov", response_class=PlainTextResponse)
async def on_lcov(bench: Bench, instance: Id) -> PlainTextResponse:
    """The same as LCOV, for genhtml and CI."""
    session = bench.session(instance)
    name = f"attachment; filename=scanbench-{session.id}.lcov"
    return PlainTextResponse(lcov((await session.debugging.reached()).files), headers={"Content-Disposition": name})
