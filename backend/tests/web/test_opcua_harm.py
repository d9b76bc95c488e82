"""OPC UA at a virtual PLC: what clients do wrong harms nobody else."""

import asyncio
import random
from contextlib import suppress
from pathlib import Path
from typing import Any, cast

import pytest
from asyncua import Client, ua

from bench.broken_frames import AT_ONCE, broken_opcua, messages_of_opcua
from tests.amounts import amount, nightly, slow
from tests.web.server import PATIENCE_S, Server
from tests.web.test_communication import MODEL, seen, until
from tests.web.test_opcua import SOURCE, Changes, at, client_at, run, switch_on, write


async def channel(address: str, password: str = "") -> Client:
    """A client without a session."""
    client = client_at(address, password)
    await client.connect_socket()
    await client.send_hello()
    await client.open_secure_channel()
    return client


def token_of(client: Client) -> ua.NodeId:
    assert client.uaclient.protocol is not None
    return client.uaclient.protocol.authentication_token


async def activate(client: Client, ada: Client, password: str) -> None:
    """Asks for Ada's session."""
    assert client.uaclient.protocol is not None
    client.uaclient.protocol.authentication_token = token_of(ada)
    client.security_policy.peer_certificate = ada.security_policy.peer_certificate
    client._server_nonce, client._policy_ids = ada._server_nonce, ada._policy_ids
    await client.activate_session("Ada", password)


def names(server: Server, instance: int) -> list[str]:
    return [each["name"] for each in seen(server, instance, "opcua")["clients"]]


def test_who_does_not_know_the_password_gets_nobodys_session(server: Server) -> None:
    instance = server.instance("opc ua intruder", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def story() -> None:
        async with client_at(address, server.token) as ada:
            token = token_of(ada)
            assert isinstance(token.Identifier, bytes), "nobody can guess it"
            assert len(token.Identifier) == 32
            changes = Changes()
            subscription = await ada.create_subscription(50, changes)
            await subscription.subscribe_data_change(at(ada, "Main.level"))

            intruder = await channel(address)
            with pytest.raises(ua.uaerrors.BadUserAccessDenied):
                await activate(intruder, ada, "not the token")
            with pytest.raises(ua.uaerrors.BadUserAccessDenied):
                await write(intruder, "Main.level", 666, ua.VariantType.Int16)
            intruder.disconnect_socket()
            assert await write(ada, "Main.level", 3, ua.VariantType.Int16) == "Good"
            await changes.until("Main.level", lambda value, _: value == 3)
            assert await asyncio.to_thread(names, server, instance) == ["OPC UA Ada, HMI"]

    run(story())


def test_a_session_goes_on_where_its_client_came_again(server: Server) -> None:
    instance = server.instance("opc ua again", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def story() -> None:
        first = client_at(address, server.token)
        await first.connect()
        second = await channel(address, server.token)
        await activate(second, first, server.token)
        with pytest.raises(ua.uaerrors.BadUserAccessDenied):
            await write(first, "Main.level", 1, ua.VariantType.Int16)
        first.disconnect_socket()
        assert await write(second, "Main.level", 3, ua.VariantType.Int16) == "Good"
        assert await asyncio.to_thread(names, server, instance) == ["OPC UA Ada, HMI"]
        await second.close_session()
        second.disconnect_socket()

    run(story())


def monitored(client: Client, path: str, filter: Any, part: str | None = None) -> ua.MonitoredItemCreateRequest:
    asked = ua.MonitoredItemCreateRequest(ua.ReadValueId(at(client, path).nodeid, ua.AttributeIds.Value, part))
    asked.MonitoringMode = ua.MonitoringMode.Reporting
    asked.RequestedParameters = ua.MonitoringParameters(10_000, 50.0, filter, 10, True)
    return asked


def deadband(width: float, kind: ua.DeadbandType = ua.DeadbandType.Absolute) -> ua.DataChangeFilter:
    return ua.DataChangeFilter(ua.DataChangeTrigger.StatusValue, ua.UInt32(kind), width)


@slow
def test_a_deadband_is_for_numbers_and_ends_nothing(server: Server) -> None:
    instance = server.instance("opc ua deadband", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def story() -> None:
        changes = Changes()
        async with client_at(address, server.token) as client:
            subscription = await client.create_subscription(50, changes)
            wanted = [
                (monitored(client, "Main.n", None), "Good"),
                (monitored(client, "Main.name", deadband(1)), "BadFilterNotAllowed"),
                (monitored(client, "Main.numbers", deadband(1)), "BadFilterNotAllowed"),
                (monitored(client, "Main.lamp", deadband(1)), "BadFilterNotAllowed"),
                (monitored(client, "Main.ratio", deadband(1, ua.DeadbandType.Percent)), "BadFilterNotAllowed"),
                (monitored(client, "Main.ratio", ua.EventFilter()), "BadMonitoredItemFilterUnsupported"),
                (monitored(client, "Main.numbers", None, "1"), "BadIndexRangeInvalid"),
                (monitored(client, "Main.name", deadband(0, ua.DeadbandType.None_)), "Good"),
            ]
            params = ua.CreateMonitoredItemsParameters(
                subscription.subscription_id, ItemsToCreate=[each for each, _ in wanted]
            )
            made = await client.uaclient.create_monitored_items(params)
            assert [each.StatusCode.name for each in made] == [status for _, status in wanted]

            changed = ua.MonitoredItemModifyRequest(made[-1].MonitoredItemId, wanted[1][0].RequestedParameters)
            both = ua.ModifyMonitoredItemsParameters(subscription.subscription_id, ItemsToModify=[changed])
            (refused,) = await client.uaclient.modify_monitored_items(both)
            assert refused.StatusCode.name == "BadFilterNotAllowed"

            await subscription.subscribe_data_change([at(client, "Main.n")])
            await subscription.deadband_monitor(at(client, "Main.level"), cast(ua.Double, 5.0))
            await changes.until("Main.level", lambda value, _: value == 0)
            for level in (4, 6):
                assert await write(client, "Main.level", level, ua.VariantType.Int16) == "Good"
            await changes.until("Main.level", lambda value, _: value == 6)

            power = f"/api/instances/{instance}"
            (await asyncio.to_thread(server.http.patch, power, json={"power": False})).raise_for_status()
            await changes.until("Main.level", lambda _, status: status.is_bad())
            (await asyncio.to_thread(server.http.patch, power, json={"power": True})).raise_for_status()
            await changes.until("Main.level", lambda _, status: status.is_good())
            before = await at(client, "Main.n").read_value()
            await changes.until("Main.n", lambda value, _: value is not None and value > before)

    run(story())


@slow
def test_a_connection_has_one_session_and_the_log_short_names(server: Server) -> None:
    instance = server.instance("opc ua sessions", MODEL, main=SOURCE)
    address = switch_on(server, instance)

    async def story() -> None:
        first = await channel(address, server.token)
        await first.create_session()
        early = token_of(first)
        await first.create_session()
        late = token_of(first)
        other = await channel(address, server.token)
        assert first.uaclient.protocol is not None
        first.uaclient.protocol.authentication_token = early
        with pytest.raises(ua.uaerrors.BadSessionIdInvalid):
            await activate(other, first, server.token)
        first.uaclient.protocol.authentication_token = late
        await first.activate_session("Ada", server.token)
        assert await write(first, "x\n" * 1000, 1, ua.VariantType.Int16) == "BadNodeIdUnknown"
        await first.close_session()
        for each in (first, other):
            each.disconnect_socket()

    run(story())
    assert seen(server, instance, "opcua")["frames"][-1]["text"] == f"write {'x' * 80}"


FRAMES = amount(100_000, 400)
MOST_KIB = 64 << 10
"""More than this the process of OPC UA may not have grown."""


def process_of(server: Server) -> tuple[int, int]:
    """The process of OPC UA, which is the one that has a listening socket besides the server; its memory in KiB."""
    children = Path(f"/proc/{server.process.pid}/task").glob("*/children")
    pids = [int(pid) for each in children for pid in each.read_text().split()]
    sizes = {}
    for pid in pids:
        with suppress(FileNotFoundError, ProcessLookupError):
            resident = Path(f"/proc/{pid}/status").read_text().partition("VmRSS:")[2].split()
            sizes[pid] = int(resident[0]) if resident else 0  # one that has ended has no memory
    largest = max(sizes, key=lambda pid: sizes[pid])
    return largest, sizes[largest]


@nightly
def test_broken_messages_harm_nobody(server: Server) -> None:
    instance = server.instance("opc ua storm", MODEL, main=SOURCE)
    address = switch_on(server, instance)
    port = int(address.rpartition(":")[2].rstrip("/"))
    whole, chance = asyncio.run(asyncio.wait_for(messages_of_opcua(port), PATIENCE_S)), random.Random(7)
    assert len(whole) > 5

    async def storm(connections: int) -> None:
        for _ in range(connections):
            await broken_opcua(port, whole, chance)

    run(storm(FRAMES // AT_ONCE // 4))
    process, before = process_of(server)
    run(storm(FRAMES // AT_ONCE))
    assert process_of(server)[0] == process, "it did not end"
    assert process_of(server)[1] - before < MOST_KIB

    async def still() -> None:
        async with client_at(address, server.token) as ada:
            assert await write(ada, "Main.level", 5, ua.VariantType.Int16) == "Good"

    run(still())
    assert names(server, instance) == []
    scan = server.http.get(f"/api/instances/{instance}").json()["state"]["scan"]
    until(lambda: server.http.get(f"/api/instances/{instance}").json()["state"]["scan"] > scan)
