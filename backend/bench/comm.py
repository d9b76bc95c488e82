"""`python -m bench comm`: clients of FINS, Modbus and OPC UA at one virtual PLC of a real server, and storms of broken frames.

The load that issue and documentation speak of: 50 clients of FINS read 100 words 20 times a second each, while 10 clients of OPC UA subscribe to 1,000 variables each at 10 Hz.
*Answers* are from a client's request to its answer, in milliseconds; the PLC runs scans of 10 ms. *Ages* are a figure of our own: from when a value was read in the PLC to when a
subscriber has it, the interval of 100 ms included. CPU is of one core: of the PLC's process, of the server's (the parent), of that of OPC UA, and of all that the machine did besides (the
clients among it): where it has two cores and does much else, latencies are those of the scheduler.

Storms: so many broken frames by each protocol, between two stretches without; how late scans began (in the mean and at worst), with and without, of one run.
"""

import argparse
import asyncio
import json
import random
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from itertools import islice
from pathlib import Path

from bench.broken_frames import (
    AT_ONCE,
    FINS,
    MODBUS,
    SLMP,
    broken_opcua,
    fins_over_tcp,
    messages_of_opcua,
    mutated,
    sent,
)
from bench.comm_clients import PER_SECOND, WORDS, Asks, Ua, fins_from, modbus_from
from bench.comm_server import Bench, Plc, Used
from bench.opcua_clients import reads, subscribed

CLIENTS, MODBUS_CLIENTS = 50, 16
UA_CLIENTS, UA_NODES, UA_MS, UA_CHANGING = 10, 1000, 100, 100
"""So many clients subscribe to so many variables each, ten times a second; so many of them change with each scan."""
READY_S, UA_READY_S = 2.0, 25.0
"""So long until all clients are there."""
CONNECTIONS = 4
"""Of a storm, at the same time."""
WAIT_S = 3.0
"""How long a stretch without a storm is."""
MOST_MS, MOST_PERCENT = 20, 100
"""What is aimed at: of 99 % of the answers, and of host and parent together."""
_SOURCE = (
    "PROGRAM Main\nVAR n : DINT; level AT D100 : INT;\n"
    + "".join(f"  v{each} : INT;\n" for each in range(UA_NODES))
    + "END_VAR\n  n := n + 1;\n"
    + "".join(f"  v{each} := v{each} + 1;\n" for each in range(UA_CHANGING))
    + "END_PROGRAM\n"
)


@dataclass(frozen=True, slots=True)
class Took:
    """How long something took, as clients saw it."""

    what: str
    answers: bool
    """From a request to its answer; else the age of what a subscriber is told."""
    count: int
    per_second: float
    p50_ms: float
    p99_ms: float
    worst_ms: float


@dataclass(frozen=True, slots=True)
class Load:
    """What clients saw, and what it cost, in percent of a core."""

    what: str
    took: tuple[Took, ...]
    host_percent: float
    server_percent: float
    opcua_percent: float
    besides_percent: float
    """All that the machine did besides: the clients, and other work."""
    late_percent: float
    """Scans of the last seconds that began after the next one was due."""


@dataclass(frozen=True, slots=True)
class Storm:
    """How late scans began while broken frames came, and in the stretches before and after that."""

    protocol: str
    frames: int
    seconds: float
    late_us: float
    worst_us: float
    late_us_without: float
    worst_us_without: float


Client = Callable[[float], list[float]]
"""From the moment that it is given on; what took how long, in seconds."""


def measure(plc: Plc, what: str, clients: dict[str, list[Client]], ages: str, seconds: float, ready_s: float) -> Load:
    """Runs clients, each in a process of its own; `ages`: those that tell of ages."""
    begin = time.time() + (ready_s if clients else 0)
    with ProcessPoolExecutor(max(1, sum(map(len, clients.values())))) as pool:
        running = {name: [pool.submit(one, begin) for one in some] for name, some in clients.items()}
        time.sleep(max(0.0, begin - time.time()))
        plc.new_pace()
        before, at = plc.used(), time.perf_counter()
        time.sleep(seconds)
        lasted, after, late = time.perf_counter() - at, plc.used(), plc.state["late_percent"]
        found = {name: sorted(each for one in some for each in one.result()) for name, some in running.items()}
    took = tuple(_took(name, name != ages, each, lasted) for name, each in found.items())
    return _load(what, took, before, after, lasted, late)


def _took(what: str, answers: bool, took: list[float], lasted: float) -> Took:
    p50, p99, worst = (1000 * took[min(len(took) - 1, int(q * len(took)))] if took else 0.0 for q in (0.5, 0.99, 1))
    return Took(what, answers, len(took), len(took) / lasted, p50, p99, worst)


def _load(what: str, took: tuple[Took, ...], before: Used, after: Used, lasted: float, late: float) -> Load:
    plc, server, others, machine = (
        100 * (b - a) / lasted
        for a, b in (
            (before.plc, after.plc), (before.server, after.server), (before.others, after.others),
            (before.machine, after.machine),
        )
    )  # fmt: skip
    return Load(what, took, plc, server, others, max(0.0, machine - plc - server - others), late)


# ---- clients -----------------------------------------------------------------------------------------------------


def loads(plc: Plc, ports: dict[str, int], clients: int, ua_clients: int, seconds: float) -> list[Load]:
    """Each protocol by itself, then the load that is aimed at."""

    def of_ua(ask: Callable[[int, int, float, float, float], list[float]], nodes: int) -> list[Client]:
        apart = UA_MS / ua_clients / 1000
        return [Ua(ask, ports["opcua"], nodes, UA_MS, each * apart, seconds) for each in range(ua_clients)]

    fins: list[Client] = [Asks(fins_from, ports["fins"], clients, seconds)]
    modbus: list[Client] = [Asks(modbus_from, ports["modbus"], min(MODBUS_CLIENTS, clients), seconds)]
    return [
        measure(plc, "no client", {}, "", seconds, 0),
        measure(plc, "FINS", {"FINS": fins}, "", seconds, READY_S),
        measure(plc, "Modbus", {"Modbus": modbus}, "", seconds, READY_S),
        measure(plc, "OPC UA, reads", {"OPC UA": of_ua(reads, WORDS)}, "", seconds, UA_READY_S),
        measure(
            plc, LOAD, {"FINS": fins, "OPC UA": of_ua(subscribed, UA_NODES)}, "OPC UA", seconds, UA_READY_S
        ),
    ]  # fmt: skip


LOAD = "the load"

# ---- storms ------------------------------------------------------------------------------------------------------


def storm(plc: Plc, protocol: str, port: int, frames: int) -> Storm:
    """Broken frames as fast as the server takes them."""
    late: list[tuple[float, float]] = []
    lasted = 0.0
    for broken in (False, True, False):
        plc.new_pace()
        begin = time.perf_counter()
        if broken:
            asyncio.run(_storm(protocol, port, frames))
            lasted = time.perf_counter() - begin
        else:
            time.sleep(WAIT_S)
        state = plc.state
        late.append((state["late_us"], state["worst_us"]))
    before, amid, after = late
    return Storm(protocol, frames, lasted, *amid, (before[0] + after[0]) / 2, max(before[1], after[1]))


async def _storm(protocol: str, port: int, frames: int) -> None:
    if protocol == "FINS, UDP":
        await _datagrams(port, frames)
        return
    whole = {"FINS, TCP": [fins_over_tcp(each) for each in FINS], "SLMP": SLMP, "Modbus": MODBUS}.get(protocol)
    opcua = await messages_of_opcua(port) if whole is None else []

    async def some(seed: int) -> None:
        chance, mine = random.Random(seed), frames // CONNECTIONS
        made = iter(mutated(whole or [], mine if whole else 0, seed))
        for _ in range(0, mine, AT_ONCE):
            if whole:
                await sent(port, list(islice(made, AT_ONCE)))
            else:
                await broken_opcua(port, opcua, chance)

    await asyncio.gather(*map(some, range(CONNECTIONS)))


async def _datagrams(port: int, frames: int) -> None:
    loop = asyncio.get_running_loop()
    transport, _ = await loop.create_datagram_endpoint(asyncio.DatagramProtocol, remote_addr=("127.0.0.1", port))
    for at, frame in enumerate(mutated(FINS, frames, seed=7)):
        transport.sendto(frame)
        if at % 64 == 0:
            await asyncio.sleep(0.002)
    transport.close()


# ---- what is printed ---------------------------------------------------------------------------------------------


def shown(found: list[Load], storms: list[Storm]) -> list[str]:
    """As tables, for people."""
    lines = ["                                 count       /s   p50 ms   p99 ms   worst   PLC %  server %  OPC UA %  besides %  late %"]  # fmt: skip
    for load in found:
        cost = (
            f"{load.host_percent:8.1f}  {load.server_percent:8.1f}  {load.opcua_percent:8.1f}  {load.besides_percent:9.1f}"
            f"  {load.late_percent:6.2f}"
        )
        if not load.took:
            lines.append(f"{load.what:66}{cost}")
        for each in load.took:
            kind = "answers" if each.answers else "ages"
            lines.append(
                f"{load.what:14} {each.what:7} {kind:8} {each.count:7}  {each.per_second:7.0f}  {each.p50_ms:7.2f}  {each.p99_ms:7.2f}"
                f"  {each.worst_ms:6.1f}{cost if each is load.took[0] else ''}"
            )
    load = next(each for each in found if each.what == LOAD)
    p99 = max(each.p99_ms for each in load.took if each.answers)
    both = load.host_percent + load.server_percent
    lines += [
        "",
        f"The load ({PER_SECOND} requests a second of each client of FINS for {WORDS} words; {UA_NODES} variables of each client of OPC UA at {1000 // UA_MS} Hz):",
        f"  99 % of the answers within {p99:.1f} ms, of {MOST_MS} that are aimed at: {_met(p99, MOST_MS)}",
        f"  PLC and server {both:.0f} % of a core, of {MOST_PERCENT}: {_met(both, MOST_PERCENT)} (with the process of OPC UA {both + load.opcua_percent:.0f} %)",
        "  (ages of subscribed values are not among the answers)",
        "",
        "storm of       frames  seconds   late us  without    worst us  without",
    ]
    lines += [
        f"{each.protocol:12} {each.frames:8}  {each.seconds:7.1f}  {each.late_us:8.0f} {each.late_us_without:8.0f}  {each.worst_us:10.0f} {each.worst_us_without:8.0f}"
        for each in storms
    ]
    return lines


def _met(found: float, most: float) -> str:
    return "met" if found < most else "NOT met"


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="python -m bench comm", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--clients", type=int, default=CLIENTS, help="of FINS")
    parser.add_argument("--ua-clients", type=int, default=UA_CLIENTS, help="of OPC UA")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--storm", type=int, default=100_000, help="broken frames of each protocol")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(Path(folder))
        try:
            omron = bench.plc("CJ1M-CPU13", _SOURCE)
            ports = {kind: omron.switch_on(kind) for kind in ("fins", "modbus", "opcua")}
            found = loads(omron, ports, given.clients, given.ua_clients, given.seconds)
            storms = [
                storm(omron, protocol, ports[kind], given.storm)
                for protocol, kind in (
                    ("FINS, UDP", "fins"), ("FINS, TCP", "fins"), ("Modbus", "modbus"), ("OPC UA", "opcua"),
                )
                if given.storm
            ]  # fmt: skip
            if given.storm:
                omron.switch_off()
                melsec = bench.plc("Q03UD", _SOURCE)
                storms.append(storm(melsec, "SLMP", melsec.switch_on("slmp"), given.storm))
        finally:
            bench.close()
    if given.json:
        made = {"loads": [asdict(each) for each in found], "storms": [asdict(each) for each in storms]}
        sys.stdout.write(json.dumps(made) + "\n")
        return
    sys.stdout.write("\n".join(shown(found, storms)) + "\n")


if __name__ == "__main__":
    main()
