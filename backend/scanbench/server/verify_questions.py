"""Questions about one row of a verification, which its process answers."""

from scanbench.debug.flow_shown import FlowAsked
from scanbench.server.verification import Verification
from scanbench.verify.contract import VerifyFlows
from scanbench.wire.verification import RowFlowsAre, RowFlowsOf, UseRow, UsesAre, UsesOf


async def uses_of(verification: Verification, scan: int, call: int) -> tuple[UseRow, ...]:
    """Its used-variable record."""
    return (await verification.ask(lambda ref: UsesOf(ref, scan, call), UsesAre)).uses


async def flows_of(verification: Verification, scan: int, call: int, asked: FlowAsked) -> VerifyFlows:
    """What the code of an instance saw, on both sides."""
    return (await verification.ask(lambda ref: RowFlowsOf(ref, scan, call, asked), RowFlowsAre)).flows
