"""The way from the process of an OPC UA server to the server of Scanbench, which has the door to the PLC."""

import asyncio
from collections.abc import Sequence

from scanbench.jobs.channel import Channel
from scanbench.runtime.command import Command
from scanbench.wire.memory import AreaSpan
from scanbench.wire.opcua import OpcUaAsked, OpcUaDone, OpcUaSubmit
from scanbench.wire.refused import Refused
from scanbench.wire.variables import ReadVariables, VariablesAre

_PATIENCE_S = 30.0
"""The server answers in far less; it has deadlines of its own for the PLC."""


class NotThere(Exception):
    """The PLC is switched off, starting, or silent: the message says which."""


class Link:
    """Asks and tells. In the event loop."""

    def __init__(self, writer: asyncio.StreamWriter) -> None:
        self._writer = writer
        self._channel = Channel("OPC UA", writer.close, Refused)
        self._channel.begin(writer)

    def close(self) -> None:
        """Nothing is said any more."""
        self._writer.close()

    async def take(self, message: object) -> bool:
        """Gives an answer to who waits for it; false where it is none."""
        return await self._channel.take(message)

    async def read(self, paths: Sequence[str]) -> VariablesAre:
        """Variables, all of one scan; `NotThere`."""
        wanted = tuple(paths)
        try:
            found = await self._channel.ask(lambda ref: ReadVariables(ref, wanted), VariablesAre, _PATIENCE_S)
        except (TimeoutError, Refused) as error:
            raise NotThere("the server does not answer") from error
        if found.message:
            raise NotThere(found.message)
        return found

    async def submit(self, client: str, command: Command) -> OpcUaDone:
        """Enters a command; `NotThere`: whether it was done is not known."""
        try:
            done = await self._channel.ask(lambda ref: OpcUaSubmit(ref, client, command), OpcUaDone, _PATIENCE_S)
        except (TimeoutError, Refused) as error:
            raise NotThere("the server does not answer") from error
        if done.away:
            raise NotThere(done.message)
        return done

    def asked(self, client: str, text: str, outcome: str = "", spans: Sequence[AreaSpan] = ()) -> None:
        """Tells what a client asked."""
        self.tell(OpcUaAsked(client, text, outcome, tuple(spans)))

    def tell(self, message: object) -> None:
        """Something without an answer."""
        self._channel.tell(message)
