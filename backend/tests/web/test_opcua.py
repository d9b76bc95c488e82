"""OPC UA at a virtual PLC, from clients of asyncua."""

import asyncio
from collections.abc import Callable, Coroutine
from datetime import UTC, datetime
from typing import Any

from asyncua import Client, Node, ua

from tests.web.server import PATIENCE_S, Server
from tests.web.test_communication import MODEL, seen

SOURCE = """
TYPE Colour : (RED, GREEN := 5, BLUE); END_TYPE
TYPE Tank : STRUCT level : INT; full : BOOL; END_STRUCT END_TYPE
FUNCTION_BLOCK Counter
VAR_INPUT step : INT; END_VAR
VAR sum : DINT; END_VAR
  sum := sum + step;
END_FUNCTION_BLOCK
PROGRAM Main
VAR
  level AT D100 : INT; twice AT D101 : INT; errors AT A400 : WORD; lamp AT CIO 100.03 : BOOL;
  n : DINT; same : DINT; ratio : REAL := 1.5; span : TIME := T#1s500ms; day : DATE := D#2026-11-28; name : STRING := 'pump';
  wide : WSTRING := "ポンプ"; colour : Colour := BLUE; tank : Tank; tanks : ARRAY[1..2] OF Tank; numbers : ARRAY[1..4] OF INT := [1, 2, 3, 4];
  grid : ARRAY[0..1, 0..2] OF INT := [1, 2, 3, 4, 5, 6]; counter : Counter;
END_VAR
VAR CONSTANT most : INT := 42; END_VAR
  n := n + 1; same := n; twice := 2 * level; counter(step := 1);
END_PROGRAM
"""


def switch_on(server: Server, instance: int, **more: object) -> str:
    wanted = {"on": True, "port": 0, "access": "write", **more}
    reply = server.http.put(f"/api/instances/{instance}/communication/opcua", json=wanted)
    assert reply.status_code == 200, reply.text
    (seen,) = (each for each in reply.json()["servers"] if each["kind"] == "opcua")
    assert seen["listening"], seen
    return str(seen["address"])


def run(story: Coroutine[Any, Any, None]) -> None:
    asyncio.run(asyncio.wait_for(story, PATIENCE_S))


def client_at(address: str, password: str = "", user: str = "Ada") -> Client:
    client = Client(address, timeout=PATIENCE_S)
    client.application_uri, client.name = "urn:test", "HMI"
    if password:
        client.set_user(user)
        client.set_password(password)
    return client


def at(client: Client, path: str) -> Node:
    return client.get_node(f"ns=2;s={path}")


class Changes:
    """What a subscription tells, and a way to wait for it."""

    def __init__(self) -> None:
        self.told: asyncio.Queue[tuple[str, Any, ua.StatusCode]] = asyncio.Queue()
        self.events: asyncio.Queue[Any] = asyncio.Queue()

    def datachange_notification(self, node: Node, value: Any, data: Any) -> None:
        status = data.monitored_item.Value.StatusCode
        self.told.put_nowait((str(node.nodeid.Identifier), value, status))

    def event_notification(self, event: Any) -> None:
        self.events.put_nowait(event)

    async def until(self, path: str, fits: Callable[[Any, ua.StatusCode], bool]) -> None:
        while True:
            name, value, status = await self.told.get()
            if name == path and fits(value, status):
                return


async def write(client: Client, path: str, value: object, variant: ua.VariantType) -> str:
    """The name of the status that answers."""
    params = ua.WriteParameters()
    given = ua.DataValue(ua.Variant(value, variant))
    params.NodesToWrite = [ua.WriteValue(at(client, path).nodeid, ua.AttributeIds.Value, None, given)]
    (status,) = await client.uaclient.write(params)
    return str(status.name)


def test_a_client_reads_every_type_and_writes_what_tools_may(server: Server) -> None:
    instance = server.instance("opc ua", MODEL, main=SOURCE)
    address = switch_on(server, instance)
    assert address.startswith("opc.tcp://127.0.0.1:")

    async def story() -> None:
        async with client_at(address, server.token) as client:
            main = await client.nodes.objects.get_child([f"2:{name_of(server, instance)}", "2:Programs", "2:Main"])
            names = [(await each.read_browse_name()).Name for each in await main.get_children()]
            assert names[:4] == ["level", "twice", "errors", "lamp"]
            found = {path: await at(client, f"Main.{path}").read_value() for path in GIVEN}
            assert found == GIVEN
            types = {path: await at(client, f"Main.{path}").read_data_type_as_variant_type() for path in TYPES}
            assert types == TYPES

            n, same = await client.read_values([at(client, "Main.n"), at(client, "Main.same")])
            assert n == same, "one answer is of one scan"
            assert await at(client, "D100").read_value() == 0, "an address has a node, too"
            assert await at(client, "Main.numbers[2]").read_value() == 2

            assert await write(client, "Main.level", 21, ua.VariantType.Int16) == "Good"
            assert await at(client, "Main.level").read_value() == 21, "what was acknowledged is there"
            while await at(client, "Main.twice").read_value() != 42:
                pass
            for path, value, variant in WRITTEN:
                assert await write(client, path, value, variant) == "Good"
                assert await at(client, path).read_value() == value
            for path, value, variant, status in REFUSED:
                assert await write(client, path, value, variant) == status
            assert await at(client, "Main.errors").read_value() == 0
            level = await at(client, "Main.errors").read_attribute(ua.AttributeIds.AccessLevel)
            assert level.Value is not None
            assert level.Value.Value == 1, "error memory can be read, and that is all"

    run(story())
    told = seen(server, instance, "opcua")
    assert told["clients"] == []
    outcomes = {each["text"]: each["outcome"] for each in told["frames"]}
    assert outcomes["write Main.colour"] == "BadOutOfRange"
    assert outcomes["write Main.errors"] == "BadUserAccessDenied"
    readers = server.http.get(f"/api/instances/{instance}/communication").json()["error_readers"]
    assert {"word": "A400", "clients": ["OPC UA Ada, HMI"]} in readers
    log = server.http.get(f"/api/instances/{instance}/log?count=100").json()["lines"]
    assert [each["author"] for each in log if each["text"] == "Main.level := 21"] == ["OPC UA Ada, HMI"]


GIVEN = {
    "ratio": 1.5, "span": 1500.0, "day": datetime(2026, 11, 28, tzinfo=UTC), "name": "pump", "wide": "ポンプ", "colour": 6,
    "tank.level": 0, "tanks[2].full": False, "numbers": [1, 2, 3, 4], "grid": [[1, 2, 3], [4, 5, 6]], "most": 42, "lamp": False,
}  # fmt: skip
TYPES = {
    "level": ua.VariantType.Int16, "errors": ua.VariantType.UInt16, "lamp": ua.VariantType.Boolean, "n": ua.VariantType.Int32,
    "ratio": ua.VariantType.Float, "span": ua.VariantType.Double, "day": ua.VariantType.DateTime, "wide": ua.VariantType.String,
    "colour": ua.VariantType.Int32,
}  # fmt: skip
WRITTEN = (
    ("Main.ratio", 2.25, ua.VariantType.Float),
    ("Main.span", 250.5, ua.VariantType.Double),
    ("Main.day", datetime(2027, 1, 1, tzinfo=UTC), ua.VariantType.DateTime),
    ("Main.name", "valve", ua.VariantType.String),
    ("Main.wide", "弁", ua.VariantType.String),
    ("Main.colour", 5, ua.VariantType.Int32),
    ("Main.tanks[2].full", True, ua.VariantType.Boolean),
    ("Main.numbers", [4, 3, 2, 1], ua.VariantType.Int16),
    ("Main.grid", [[6, 5, 4], [3, 2, 1]], ua.VariantType.Int16),
    ("Main.lamp", True, ua.VariantType.Boolean),
    ("D200", 7, ua.VariantType.UInt16),
)
REFUSED = (
    ("Main.errors", 1, ua.VariantType.UInt16, "BadUserAccessDenied"),
    ("A400", 1, ua.VariantType.UInt16, "BadUserAccessDenied"),
    ("Main.most", 1, ua.VariantType.Int16, "BadUserAccessDenied"),
    ("Main.level", 1, ua.VariantType.Int32, "BadTypeMismatch"),
    ("Main.colour", 2, ua.VariantType.Int32, "BadOutOfRange"),
    ("Main.name", "ポンプ", ua.VariantType.String, "BadOutOfRange"),
    ("Main.nothing", 1, ua.VariantType.Int16, "BadNodeIdUnknown"),
)


def name_of(server: Server, instance: int) -> str:
    return str(server.http.get(f"/api/instances/{instance}").json()["name"])
