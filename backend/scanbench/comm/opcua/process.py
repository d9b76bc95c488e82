"""The process of the OPC UA server of one PLC: what asyncua costs takes no time from the server of Scanbench."""

import asyncio
import logging
import os
import signal
import socket
from pathlib import Path
from typing import TYPE_CHECKING

from scanbench.comm.opcua.link import Link
from scanbench.engines.cache import BlobCache
from scanbench.engines.lifeline import end_with_parent
from scanbench.jobs.channel import messages
from scanbench.jobs.client import FAULT
from scanbench.wire.codec import BadMessage
from scanbench.wire.opcua import OpcUaFailed, OpcUaReady, OpcUaStart

if TYPE_CHECKING:
    from scanbench.comm.opcua.plc import Plc

log = logging.getLogger("scanbench")


def serve(sock: socket.socket, cache: Path | None, parent: int) -> int:
    """Serves until the process `parent` closes the socket, or is gone; the exit code."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the parent's business
    logging.getLogger("asyncua").setLevel(logging.CRITICAL)  # what clients do wrong is told to them
    return asyncio.run(_served(sock, None if cache is None else BlobCache(cache), parent))


async def _served(sock: socket.socket, cache: BlobCache | None, parent: int) -> int:
    reader, writer = await asyncio.open_unix_connection(sock=sock, limit=1 << 20)
    link = Link(writer)
    plc: Plc | None = None
    tasks: set[asyncio.Task[None]] = set()
    try:
        async for message in messages(reader):
            if plc is not None:
                if not await link.take(message):
                    plc.hear(message)
                continue
            if not isinstance(message, OpcUaStart):
                raise BadMessage(type(message).__name__)
            end_with_parent(parent)  # it has spoken, so it has adopted this process
            plc = _plc(link, cache, message)
            tasks.add(asyncio.create_task(_live(plc, link)))
    except BadMessage:
        log.exception("the process of an OPC UA server was told what it does not understand")
        return 1
    return 0


def _plc(link: Link, cache: BlobCache | None, start: OpcUaStart) -> "Plc":
    from scanbench.comm.opcua import plc  # asyncua takes 0.5 s and 40 MB: not in the process that all others come from

    return plc.Plc(link, cache, start)


async def _live(plc: "Plc", link: Link) -> None:
    try:
        await plc.open()
    except OSError as error:
        link.tell(OpcUaFailed(os.strerror(error.errno) if error.errno else str(error)))
        return
    except Exception:
        log.exception("an OPC UA server could not be started")
        link.tell(OpcUaFailed(FAULT))
        return
    link.tell(OpcUaReady(plc.port))
    try:
        await plc.live()
    except Exception:
        log.exception("an OPC UA server ends")
        link.close()  # and so does its process: another one is started
