"""All that is asked of a PLC."""

from typing import Generic, TypeVar
from urllib.parse import urlencode

from scanbench.client.requests.communication import Communication
from scanbench.client.requests.disturbances import Disturbances
from scanbench.client.requests.errors import Errors
from scanbench.client.requests.past import Past
from scanbench.client.requests.running import Running
from scanbench.client.requests.sweeps import Sweeps
from scanbench.client.requests.traces import Traces
from scanbench.client.requests.values import Values
from scanbench.client.requests.verification import Verifications
from scanbench.client.transport import Reach

PlcT = TypeVar("PlcT")


class PlcRequests(
    Values,
    Errors,
    Running[PlcT],
    Past,
    Sweeps,
    Disturbances[PlcT],
    Verifications,
    Traces,
    Communication,
    Generic[PlcT],
):
    """One virtual PLC."""

    def __init__(self, reach: Reach, id: int) -> None:
        self._reach, self._id, self._base = reach, id, f"/api/instances/{id}"

    @property
    def id(self) -> int:
        """Its number on the server."""
        return self._id

    def link(self, scan: int | None = None) -> str:
        """The address of this PLC for a browser, as it is now or as it was before a scan."""
        path = f"/i/{self._id}" if scan is None else f"/i/{self._id}/scan/{scan}"
        return f"{self._reach.address}{path}?{urlencode({'token': self._reach.token})}"
