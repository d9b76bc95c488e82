"""What the registers of Modbus mean at one PLC: what its project says, or else as its model has it."""

import asyncio
from collections.abc import Awaitable, Callable

from scanbench.comm.modbus.map_file import read_map
from scanbench.comm.modbus.mapping import Mapped, default
from scanbench.session.session import Session
from scanbench.wire.refused import Refused

MapFile = Callable[[int], Awaitable[str | None]]
"""The text of a project's own map; None where it has none."""


class ModbusMap:
    """Of one PLC."""

    def __init__(self, session: Session, map_file: MapFile) -> None:
        self._session, self._map_file = session, map_file
        self._default = default(session.model)
        self._table: tuple[Mapped, ...] | None = None
        self.own = False
        """The project has one of its own."""
        self.trouble = ""
        """Why that cannot be used."""

    def table(self) -> tuple[Mapped, ...]:
        """As it is now; nothing where the project's own cannot be used."""
        return self._default if self._table is None else self._table

    async def read(self) -> None:
        """Reads what the project says now."""
        text = await self._map_file(self._session.project_id)
        self.own, self.trouble = text is not None, ""
        if text is None:
            self._table = None
            return
        try:
            self._table = await asyncio.to_thread(read_map, self._session.model, text)
        except Refused as error:
            self._table, self.trouble = (), error.message
