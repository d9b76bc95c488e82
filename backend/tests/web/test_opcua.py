"""OPC UA at a virtual PLC, from clients of asyncua."""

import asyncio
import os
import random
import signal
import socket
import struct
from collections.abc import Callable, Coroutine
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest
from asyncua import Client, Node, ua
from asyncua.crypto.cert_gen import setup_self_signed_certificate
from asyncua.crypto.security_policies import SecurityPolicyBasic256Sha256
from cryptography.x509.oid import ExtendedKeyUsageOID

from scanbench.recording.blocks import read_contents
from scanbench.recording.format import RunFile
from scanbench.runtime.write_variables import WriteVariables
from scanbench.wire.codec import ENTRIES
from tests.amounts import slow
from tests.cli.calling import scanbench
from tests.web.server import PATIENCE_S, Server
from tests.web.test_communication import MODEL, break_line, raise_battery_error, seen, until

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


async def alarm(changes: Changes, active: bool) -> Any:
    """The next event of an alarm that says so."""
    while True:
        event = await changes.events.get()
        if getattr(event, "ActiveState/Id", None) is active:
            return event


def test_a_subscriber_sees_values_of_one_scan_errors_and_their_recovery_and_calls_methods(server: Server) -> None:
    instance = server.instance("opc ua errors", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def story() -> None:
        changes = Changes()
        async with client_at(address, server.token) as client:
            subscription = await client.create_subscription(50, changes)
            await subscription.subscribe_data_change(
                [at(client, "Main.n"), at(client, "Main.twice"), numbered(client, 20)]
            )
            alarms = numbered(client, 5)
            await subscription.subscribe_alarms_and_conditions(alarms, [ua.ObjectIds.OffNormalAlarmType])
            first = await at(client, "Main.n").read_value()
            await changes.until("Main.n", lambda value, _: value > first)
            assert await write(client, "Main.level", 21, ua.VariantType.Int16) == "Good"
            await changes.until("Main.twice", lambda value, _: value == 42)

            await asyncio.to_thread(raise_battery_error, server, instance)
            await changes.until("20", lambda value, _: value == ["00F7 Battery error"])
            event = await alarm(changes, active=True)
            assert event.Message.Text == "00F7 Battery error"
            assert not getattr(event, "AckedState/Id")
            assert (event.ConditionName, event.Severity, event.Retain) == ("battery-error", 500, True)
            assert await at(client, "Main.errors").read_value() == 0xF7
            conditions = client.get_node(f"i={ua.ObjectIds.ConditionType}")
            await conditions.call_method(
                "0:ConditionRefresh", ua.Variant(subscription.subscription_id, ua.VariantType.UInt32)
            )
            assert (await alarm(changes, active=True)).ConditionName == "battery-error", "who comes later is told, too"

            methods = numbered(client, 1)
            with pytest.raises(ua.uaerrors.BadInvalidState):
                await methods.call_method("2:ClearErrors")
            await asyncio.to_thread(recover, server, instance)
            await changes.until("20", lambda value, _: value == [])
            event = await alarm(changes, active=False)
            assert (event.Message.Text, event.Retain) == ("recovered: 00F7 Battery error", True), "nobody has seen it"

            await methods.call_method("2:SetMode", "PROGRAM")
            assert await numbered(client, 10).read_value() == "PROGRAM"
            await methods.call_method("2:SetMode", "run")
            assert await write(client, "Main.level", 5, ua.VariantType.Int16) == "Good", "as at the device, in RUN too"
            with pytest.raises(ua.uaerrors.BadInvalidState):
                await methods.call_method("2:SetMode", "WALK")

    run(story())


def test_an_alarm_is_acknowledged_with_a_remark_by_who_may_write(server: Server) -> None:
    instance = server.instance("opc ua alarms", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def story() -> None:
        ann, bob = Changes(), Changes()
        async with client_at(address, server.token) as ada, client_at(address) as nobody:
            for client, changes in ((ada, ann), (nobody, bob)):
                subscription = await client.create_subscription(50, changes)
                await subscription.subscribe_alarms_and_conditions(
                    numbered(client, 5), [ua.ObjectIds.OffNormalAlarmType]
                )
            await asyncio.to_thread(raise_battery_error, server, instance)
            raised = await alarm(ann, active=True)
            assert (raised.Retain, getattr(raised, "AckedState/Id"), raised.Comment.Text) == (True, False, "")
            assert (await alarm(bob, active=True)).EventId == raised.EventId

            assert await said(nobody, ACKNOWLEDGE, raised) == "BadUserAccessDenied"
            assert await said(ada, ACKNOWLEDGE, raised, event=b"no event") == "BadEventIdUnknown"
            assert await said(ada, ACKNOWLEDGE, raised, condition="alarm:memory-error") == "BadNodeIdUnknown"
            assert await said(ada, ACKNOWLEDGE, raised, comment=None) == "BadInvalidArgument"
            assert await said(ada, CONFIRM, raised) == "BadNotSupported"
            assert await said(ada, ADD_COMMENT, raised, comment="who has a battery?") == "Good"
            remark = await alarm(bob, active=True)
            assert (remark.Comment.Text, getattr(remark, "AckedState/Id")) == ("who has a battery?", False)

            await asyncio.to_thread(recover, server, instance)
            gone = await alarm(ann, active=False)
            assert (gone.Retain, getattr(gone, "AckedState/Id")) == (True, False)
            assert await said(ada, ACKNOWLEDGE, raised, comment="new one is in") == "Good"
            seen = await alarm(ann, active=False)
            assert (seen.Retain, getattr(seen, "AckedState/Id"), seen.Comment.Text) == (False, True, "new one is in")
            assert seen.ClientUserId == "OPC UA Ada, HMI"
            assert await said(ada, ACKNOWLEDGE, raised) == "BadNodeIdUnknown", "it is over"

            await asyncio.to_thread(raise_battery_error, server, instance)
            again = await alarm(ann, active=True)
            assert (getattr(again, "AckedState/Id"), again.Comment.Text) == (False, "")
            assert await said(ada, ACKNOWLEDGE, raised) == "BadEventIdUnknown", "that was the time before"
            assert await said(ada, ACKNOWLEDGE, again) == "Good"
            assert (await alarm(ann, active=True)).Retain
            assert await said(ada, ACKNOWLEDGE, again) == "BadConditionBranchAlreadyAcked"

    run(story())
    (row,) = (each for each in rows(server, instance) if each["id"] == "battery-error")
    assert (row["acknowledged"]["by"], row["acknowledged"]["remark"]) == ("OPC UA Ada, HMI", "")
    log = server.http.get(f"/api/instances/{instance}/log?count=100").json()["lines"]
    told = [each["text"] for each in log if each["author"] == "OPC UA Ada, HMI"]
    assert "battery-error was acknowledged: new one is in" in told
    assert "battery-error: remark: who has a battery?" in told


ACKNOWLEDGE, ADD_COMMENT, CONFIRM = (ua.NodeId.from_string(f"i={each}") for each in (9111, 9029, 9113))
"""Methods of AcknowledgeableConditionType and of ConditionType."""


async def said(
    client: Client, method: ua.NodeId, alarm: Any, comment: str | None = "", event: bytes = b"", condition: str = ""
) -> str:
    """The name of the status that answers who calls a method of an alarm."""
    asked = ua.CallMethodRequest()
    asked.ObjectId = at(client, condition).nodeid if condition else alarm.NodeId
    asked.MethodId = method
    given = ua.Variant(comment) if comment is None else ua.Variant(ua.LocalizedText(comment))
    asked.InputArguments = [ua.Variant(event or alarm.EventId, ua.VariantType.ByteString), given]
    (found,) = await client.uaclient.call([asked])
    return str(found.StatusCode.name)


def rows(server: Server, instance: int) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = server.http.get(f"/api/instances/{instance}/errors").json()
    return found


def numbered(client: Client, number: int) -> Node:
    return client.get_node(f"ns=2;i={number}")


def recover(server: Server, instance: int) -> None:
    server.http.post(f"/api/instances/{instance}/errors/recover", json={"ids": ["battery-error"]}).raise_for_status()


def test_the_plc_is_a_device_with_its_identification(server: Server) -> None:
    instance = server.instance("opc ua device", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def story() -> None:
        async with client_at(address) as client:
            index = await client.get_namespace_index("http://opcfoundation.org/UA/DI/")
            devices = await client.nodes.objects.get_child(f"{index}:DeviceSet")
            assert devices.nodeid.Identifier == 5001
            (device,) = await devices.get_children()
            type = await device.read_type_definition()
            assert type is not None
            kind = client.get_node(type)
            above = await kind.get_references(ua.ObjectIds.HasSubtype, ua.BrowseDirection.Inverse)
            assert [(each.NodeId.Identifier, each.NodeId.NamespaceIndex) for each in above] == [(1002, index)]
            found = {
                str((await each.read_browse_name()).Name): await each.read_value()
                for each in await device.get_properties()
            }
            assert (found["Manufacturer"].Text, found["Model"].Text, found["SerialNumber"]) == ("Scanbench", MODEL, "")
            organized = await device.get_children(ua.ObjectIds.Organizes)
            assert [each.nodeid for each in organized] == [numbered(client, 1).nodeid]
            assert await write(client, "Main.level", 1, ua.VariantType.Int16) == "BadUserAccessDenied"

    run(story())


def test_who_gives_no_name_reads_and_a_wrong_token_is_refused(server: Server, tmp_path: Path) -> None:
    instance = server.instance("opc ua users", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def story() -> None:
        async with client_at(address) as client:
            assert await at(client, "Main.level").read_value() == 0
            level = await at(client, "Main.level").read_attribute(ua.AttributeIds.UserAccessLevel)
            assert level.Value == ua.Variant(1, ua.VariantType.Byte)
            assert await write(client, "Main.level", 1, ua.VariantType.Int16) == "BadUserAccessDenied"
            with pytest.raises(ua.uaerrors.BadUserAccessDenied):
                await numbered(client, 1).call_method("2:SetMode", "PROGRAM")
            with pytest.raises(ua.uaerrors.BadUserAccessDenied):
                await client.nodes.objects.add_folder(2, "mine")
            names = [each["name"] for each in (await asyncio.to_thread(seen, server, instance, "opcua"))["clients"]]
            assert names == ["OPC UA anonymous, HMI"]
        with pytest.raises(ua.uaerrors.BadUserAccessDenied):
            await client_at(address, "not the token").connect()

        secure = client_at(address, server.token)
        key, certificate = tmp_path / "key.pem", tmp_path / "certificate.der"
        uses = [ExtendedKeyUsageOID.CLIENT_AUTH]
        await setup_self_signed_certificate(key, certificate, "urn:test", "localhost", uses, {})
        await secure.set_security(SecurityPolicyBasic256Sha256, certificate, key)
        async with secure as client:
            assert await write(client, "Main.level", 7, ua.VariantType.Int16) == "Good"

    run(story())
    kept = server.data / "opcua" / "key.pem"
    assert kept.stat().st_mode & 0o077 == 0, "nobody else reads the key"
    open_to_all = switch_on(server, instance, anonymous_writes=True)

    async def anybody() -> None:
        async with client_at(open_to_all) as client:
            assert await write(client, "Main.level", 1, ua.VariantType.Int16) == "Good"

    run(anybody())


CHANGED = """
PROGRAM Main
VAR level AT D100 : INT; n : DINT; fresh : REAL := 0.5; END_VAR
  n := n + 1;
END_PROGRAM
"""


def build(server: Server, instance: int, text: str) -> None:
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    server.http.put(f"/api/projects/{project}/files/main.st", json={"text": text, "version": 1}).raise_for_status()
    built = server.http.post(f"/api/projects/{project}/build", json={}).json()
    assert built["ok"], built


@slow
def test_a_changed_program_a_kill_and_a_plc_that_is_off(server: Server, tmp_path: Path) -> None:
    instance = server.instance("opc ua life", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    def die() -> None:
        before = server.state(instance)
        os.kill(before["pid"], signal.SIGKILL)
        until(lambda: server.state(instance)["restarts"] > before["restarts"])

    async def story() -> None:
        changes = Changes()
        async with client_at(address, server.token) as client:
            subscription = await client.create_subscription(50, changes)
            await subscription.subscribe_data_change(
                [at(client, "Main.n"), at(client, "Main.twice"), numbered(client, 10)]
            )
            for value in range(1, 6):
                assert await write(client, "Main.level", value, ua.VariantType.Int16) == "Good"
            await asyncio.to_thread(die)
            level = at(client, "Main.level")
            while (found := await level.read_data_value(raise_on_bad_status=False)).StatusCode != ua.StatusCode():
                assert found.StatusCode == ua.StatusCode(ua.UInt32(ua.StatusCodes.BadNoCommunication))
            assert found.Value == ua.Variant(5, ua.VariantType.Int16), "what was acknowledged is not lost"
            n = await at(client, "Main.n").read_value()
            await changes.until("Main.n", lambda value, _: value is not None and value > n)

            await asyncio.to_thread(build, server, instance, CHANGED)
            await changes.until("Main.twice", lambda _, status: status.name == "BadNodeIdUnknown")
            n = await at(client, "Main.n").read_value()
            await changes.until("Main.n", lambda value, _: value is not None and value > n)
            assert await at(client, "Main.fresh").read_value() == 0.5
            with pytest.raises(ua.uaerrors.BadNodeIdUnknown):
                await at(client, "Main.twice").read_value()

            power = f"/api/instances/{instance}"
            await asyncio.to_thread(server.http.patch, power, json={"power": False})
            await changes.until("10", lambda _, status: status.name == "BadNoCommunication")
            with pytest.raises(ua.uaerrors.BadNoCommunication):
                await at(client, "Main.level").read_value()
            assert await write(client, "Main.level", 9, ua.VariantType.Int16) == "BadNoCommunication"

    run(story())
    run_file = tmp_path / "run.scanrun"
    run_file.write_bytes(server.http.get(f"/api/instances/{instance}/export").content)
    file = RunFile.open(run_file, read_only=True)
    entries = read_contents(file, ENTRIES).found.entries
    file.close()
    writes = [each.command for each in entries if isinstance(each.command, WriteVariables)]
    assert [each.author for each in writes] == ["OPC UA Ada, HMI"] * 5
    replayed = scanbench("replay", str(run_file))
    assert replayed.returncode == 0, replayed.stderr


def test_what_is_no_opc_ua_does_no_harm(server: Server) -> None:
    instance = server.instance("opc ua garbage", MODEL, main=SOURCE)
    address = switch_on(server, instance)
    port, chance = int(address.rpartition(":")[2]), random.Random(7)
    hello = (
        b"HELF" + struct.pack("<IIIIII", 52, 0, 65535, 65535, 0, 0) + struct.pack("<i", 20) + b"opc.tcp://127.0.0.1/"
    )

    async def story() -> None:
        async with client_at(address, server.token) as client:
            for number in range(200):
                frame = bytearray(hello if number % 2 else b"OPNF" + struct.pack("<I", 40) + chance.randbytes(32))
                for _ in range(number % 4):
                    frame[chance.randrange(4, len(frame))] = chance.randrange(256)
                with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as sock:
                    sock.sendall(frame + chance.randbytes(number))
            assert await write(client, "Main.level", 3, ua.VariantType.Int16) == "Good"
            assert await at(client, "Main.level").read_value() == 3

    run(story())


@slow
def test_faults_of_the_line(server: Server) -> None:
    instance = server.instance("opc ua line", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def broken(fault: str, late_ms: int = 1000) -> None:
        await asyncio.to_thread(break_line, server, instance, "opcua", fault, late_ms)

    async def story() -> None:
        client = client_at(address)
        await client.connect()
        level = at(client, "Main.level")
        await broken("late", 1)
        assert await level.read_value() == 0
        await broken("silent")
        waiting = asyncio.create_task(level.read_value())
        assert not (await asyncio.wait((waiting,), timeout=0.2))[0]
        await broken("cut")
        with pytest.raises(ConnectionError):
            await level.read_value()
        with pytest.raises(ConnectionError):
            await waiting
        client.disconnect_socket()
        await broken("refused")
        with pytest.raises(ConnectionRefusedError):
            await client_at(address).connect()

    run(story())
    break_line(server, instance, "opcua", "none")
    assert seen(server, instance, "opcua")["address"] == address, "it has the port again that it had"
