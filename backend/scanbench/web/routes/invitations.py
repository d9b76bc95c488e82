"""REST: an invitation for somebody else."""

from fastapi import APIRouter, Request

from scanbench.web.messages_together import Invitation

router = APIRouter(prefix="/api/invitations", tags=["instances"])


@router.post("")
async def on_invite(request: Request) -> Invitation:
    """The token, for an address that lets somebody in who has none: they may do everything that you may."""
    return Invitation(token=request.app.state.token)
