"""What is asked of a server: which PLCs there are, and to take a run."""

import json
from collections.abc import Mapping
from typing import Generic, TypeVar
from urllib.parse import urlencode

from scanbench.client.asking import Json, Refused, Request, Steps, asked
from scanbench.client.requests.base import Asks, waited
from scanbench.client.shapes import running as shapes
from scanbench.client.transport import Reach

PlcT = TypeVar("PlcT")
_START_S = 60.0


class ServerRequests(Asks, Generic[PlcT]):
    """A running server."""

    def __init__(self, reach: Reach) -> None:
        """See `connect`."""
        self._reach, self._base = reach, "/api"

    def _of(self, id: int) -> PlcT:
        """The PLC of this number."""
        raise NotImplementedError

    @asked
    def plcs(self) -> Steps[Mapping[str, int]]:
        """Instances by name, with their numbers."""
        return self._plcs()

    @asked
    def plc(self, name: str | int) -> Steps[PlcT]:
        """The instance of this name or number."""
        if isinstance(name, int):
            return self._of(name)
        known = yield from self._plcs()
        if name not in known:
            raise Refused(f"there is no instance `{name}`", tuple(known))
        return self._of(known[name])

    @asked
    def take_run(self, run: bytes, name: str) -> Steps[PlcT]:
        """A new PLC, of this name or the next one that is free, which goes on with the run of an exported file. `Refused` where
        nothing of the file can be read; of a damaged one all that can be read is taken, and the new PLC's log says what is lost."""
        taken = yield from self._plcs()
        free = next(each for each in (name, *(f"{name} {n}" for n in range(2, len(taken) + 3))) if each not in taken)
        made = yield from self._send(shapes.ImportedInstance, "POST", "instances/import", run, name=free[:100])
        yield from waited(
            lambda: self._get(shapes.Instance, f"instances/{made['id']}"),
            lambda now: now["state"]["state"] == "starting", _START_S,
            lambda now: f"{now['name']} has not started yet: {now['state']['message']}",
        )  # fmt: skip
        return self._of(made["id"])

    @asked
    def ask(self, method: str, path: str, body: Json | bytes = None) -> Steps[Json]:
        """Any request of the REST API: `ask("GET", "/api/models")`; bytes go as they are."""
        data = yield Request(method, path, body)
        found: Json = json.loads(data) if data else None
        return found

    def link(self, path: str) -> str:
        """The address of a page of this server, for a browser that was not there before."""
        return f"{self._reach.address}{path}?{urlencode({'token': self._reach.token})}"

    def _plcs(self) -> Steps[Mapping[str, int]]:
        return {each["name"]: each["id"] for each in (yield from self._get(shapes.AppInfo, ""))["instances"]}
