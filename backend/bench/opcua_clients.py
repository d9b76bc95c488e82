"""Clients of OPC UA for `bench comm`: a process each, so that what they cost is not counted as the server's."""

import asyncio
import logging
import time
from datetime import UTC, datetime

from asyncua import Client, Node
from asyncua.common.subscription import DataChangeNotif


class Told:
    """What a subscription tells one client: how old each value was when it came, in seconds."""

    def __init__(self) -> None:
        self.took: list[float] = []
        self.counting = False

    def datachange_notification(self, node: Node, value: object, data: DataChangeNotif) -> None:
        at = data.monitored_item.Value.SourceTimestamp
        if self.counting and at is not None:
            self.took.append((datetime.now(UTC) - at).total_seconds())


def subscribed(port: int, nodes: int, interval_ms: float, begin: float, seconds: float) -> list[float]:
    """Subscribes to so many variables; from the moment `begin` (of the clock of the epoch) on, what comes is counted."""
    return asyncio.run(_subscribed(port, nodes, interval_ms, begin, seconds))


async def _subscribed(port: int, nodes: int, interval_ms: float, begin: float, seconds: float) -> list[float]:
    told = Told()
    logging.disable()
    async with Client(f"opc.tcp://127.0.0.1:{port}", timeout=60) as client:
        subscription = await client.create_subscription(interval_ms, told)
        await subscription.subscribe_data_change([client.get_node(f"ns=2;s=Main.v{each}") for each in range(nodes)])
        left = begin - time.time()
        assert left > 0, "the clients were not ready in time"
        await asyncio.sleep(left)
        told.counting = True
        await asyncio.sleep(seconds)
        told.counting = False
    return told.took


def reads(port: int, nodes: int, interval_ms: float, begin: float, seconds: float) -> list[float]:
    """Reads so many variables in one request each time; from request to answer, in seconds."""
    return asyncio.run(_reads(port, nodes, interval_ms, begin, seconds))


async def _reads(port: int, nodes: int, interval_ms: float, begin: float, seconds: float) -> list[float]:
    took: list[float] = []
    logging.disable()
    async with Client(f"opc.tcp://127.0.0.1:{port}", timeout=60) as client:
        wanted = [client.get_node(f"ns=2;s=Main.v{each}") for each in range(nodes)]
        await client.read_values(wanted)  # the first time takes longer: the PLC finds them one by one
        left = begin - time.time()
        assert left > 0, "the clients were not ready in time"
        for at in range(int(seconds * 1000 / interval_ms)):
            await asyncio.sleep(begin + at * interval_ms / 1000 - time.time())
            asked = time.perf_counter()
            await client.read_values(wanted)
            took.append(time.perf_counter() - asked)
    return took
