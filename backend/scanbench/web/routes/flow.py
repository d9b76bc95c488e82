"""REST: what the code of an instance saw in a scan, element by element."""

from typing import Annotated

from fastapi import APIRouter, Query

from scanbench.debug.flow_shown import FlowAsked, Flows
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api/instances/{instance}", tags=["debugging"])


@router.get("/flow")
async def on_flow(
    bench: Bench,
    instance: Id,
    pou: Annotated[str, Query(max_length=500)],
    path: Annotated[str, Query(max_length=2000)] = "",
    call: Annotated[int, Query(ge=0, le=1 << 30)] = 0,
    first: Annotated[int, Query(ge=1, le=1 << 30)] = 1,
    last: Annotated[int, Query(ge=1, le=1 << 30)] = 1 << 30,
) -> Flows:
    """Power and values at each element of a POU (a PROGRAM, a block, a FUNCTION, a method) as the code of the instance `path` saw them: in the scan that
    runs next while the PLC runs, in the last one and in the halted one while it waits, in that of the past that is shown. `call`: which of several
    calls in the scan, 0 for the last one; `first` and `last`: the lines whose elements are wanted."""
    return await bench.session(instance).debugging.flow(FlowAsked(pou, path, call, first, last))
