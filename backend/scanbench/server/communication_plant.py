"""The plant of a PLC that is a server of Modbus TCP: how it is set, the client that exchanges values with it, and what people see of it."""

import asyncio
import logging
from collections.abc import Callable

from scanbench.comm.desk import Desk
from scanbench.comm.modbus.plant import PlantClient
from scanbench.comm.modbus.wires import PlantWanted, answers_bit, wires
from scanbench.faults.line_faults import NO_FAULT, LineFault
from scanbench.server.communication_door import ErrorReaders, SessionDoor
from scanbench.server.communication_shapes import PlantSeen
from scanbench.session.session import Session
from scanbench.typed import BadValue, make_kept
from scanbench.wire.refused import Refused

log = logging.getLogger("scanbench")


class Plant:
    """Of one PLC. `on_clients` is called when the plant comes to be exchanged with, or no more."""

    def __init__(self, session: Session, readers: ErrorReaders, kept: object, on_clients: Callable[[], None]) -> None:
        self._session, self._readers, self._on_clients = session, readers, on_clients
        self.wanted = _read(kept)
        self.desk: Desk | None = None
        """None while it is off."""
        self.fault = NO_FAULT
        """What is wrong with the line to it."""
        self._client: PlantClient | None = None
        self._task: asyncio.Task[None] | None = None
        self._trouble = ""

    @property
    def seen(self) -> PlantSeen:
        """As it is now."""
        client, desk = self._client, self.desk
        if client is None or desk is None:
            return PlantSeen(self.wanted, self.fault, False, self._trouble, 0, 0.0, 0.0, ())
        return PlantSeen(
            self.wanted,
            self.fault,
            client.answers,
            client.trouble,
            client.exchanges,
            client.took_ms,
            desk.per_second,
            desk.frames,
        )

    def check(self, wanted: PlantWanted) -> None:
        """`Refused` where these settings make no sense for this PLC."""
        wires(self._session.model, wanted)
        answers_bit(self._session.model, wanted)

    async def set(self, wanted: PlantWanted) -> None:
        """Other settings, which were checked."""
        await self.end()
        self.wanted = wanted
        self.begin()

    def begin(self) -> None:
        """Exchanges values, if that is wanted."""
        wanted, name = self.wanted, f"Modbus plant {self.wanted.host}:{self.wanted.port}"
        if not wanted.on:
            return
        desk = Desk(lambda _: door, self._on_clients, False, self.fault)
        door = SessionDoor(self._session, name, self._readers)
        try:
            client = PlantClient(door, wanted, desk, lambda text: self._session.log.add(name, text, "system"))
        except Refused as error:  # the model is a different one now
            self._trouble = error.message
            return
        self._client, self.desk = client, desk
        self._task = asyncio.get_running_loop().create_task(_run(client, name))

    def break_line(self, fault: LineFault) -> None:
        """Something is wrong with the line to the plant, or nothing any more: from the next exchange on."""
        self.fault = fault
        if self.desk is not None:
            self.desk.fault = fault

    async def end(self) -> None:
        """Nothing is exchanged any more."""
        task, self._task = self._task, None
        self._client, self.desk, self._trouble = None, None, ""
        if task is not None:
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)
            self._on_clients()


async def _run(client: PlantClient, name: str) -> None:
    try:
        await client.run()
    except Exception:
        log.exception("%s: values could not be exchanged", name)
        await client.lost("")
        client.trouble = "values are not exchanged any more: see the log of the server"


def _read(kept: object) -> PlantWanted:
    """What was kept; what cannot be understood is off."""
    if not isinstance(kept, dict):
        return PlantWanted()
    try:
        return make_kept(PlantWanted, kept)
    except BadValue as error:
        log.error("the settings of a plant cannot be read: %s", error)
        return PlantWanted()
