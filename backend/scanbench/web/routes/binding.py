"""REST: what the in-outs of a PLC are bound to."""

from typing import Annotated

from fastapi import APIRouter, Query

from scanbench.debug.bound_to import Bound
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api/instances/{instance}", tags=["values"])


@router.get("/binding")
async def on_binding(bench: Bench, instance: Id, path: Annotated[str, Query(max_length=2000)]) -> Bound:
    """What an in-out (`Main.fb1.level`) is bound to: the variable that the block's last execution was given, and what other
    calls pass."""
    return await bench.session(instance).debugging.binding(path)
