"""Which client reads a controller: by the protocol of its address."""

import asyncio
from dataclasses import replace
from importlib import import_module

from scanbench.comm.controller.contract import Connection, Source
from scanbench.comm.fins.located import located
from scanbench.comm.fins.reading import open_fins
from scanbench.program.program import Program


async def open_source(connection: Connection) -> Source:
    """Connects; `Unreachable`."""
    if connection.by_fins:
        return await open_fins(connection)
    # not with the server, which would start a third of a second later, and beside the loop
    reading = await asyncio.to_thread(import_module, "scanbench.comm.opcua.reading")
    source: Source = await reading.open_opcua(connection)
    return source


def for_program(connection: Connection, program: Program) -> Connection:
    """By FINS a controller says nothing of what it has: where nobody named anything, the variables of the program at addresses are read."""
    if not connection.by_fins or connection.nodes:
        return connection
    return replace(connection, nodes=located(program))
