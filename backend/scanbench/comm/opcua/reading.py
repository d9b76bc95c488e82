"""A controller by OPC UA: its variables, and their values again and again. What it is asked is Browse and Read, and never Write."""

import asyncio
import logging
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from asyncua import Client, ua

from scanbench.comm.controller.contract import MOST, Connection, Found, Unreachable

ANSWER_S = 4.0
"""So long it may take to answer."""
_AT_ONCE = 500
"""Values in one question, and nodes that are asked for what is below them."""
_MOST_NODES = 20_000
"""That are looked at."""
_SERVER = 2253
"""The node Server of every server: what it says of itself is no variable of a program."""
_NO_VALUE = {ua.StatusCodes.BadWaitingForInitialData, ua.StatusCodes.BadNoCommunication, ua.StatusCodes.BadOutOfService}
"""There will be one."""
_1970 = datetime(1970, 1, 1, tzinfo=UTC)
_TROUBLES = (OSError, TimeoutError, asyncio.TimeoutError, ua.UaError)


@dataclass(frozen=True, slots=True)
class _Node:
    id: ua.NodeId
    path: str
    """Names from the folder Objects on."""
    name: str


async def open_opcua(connection: Connection) -> "OpcUaSource":
    """Connects; `Unreachable`."""
    logging.getLogger("asyncua").setLevel(logging.CRITICAL)  # whatever is wrong is told to who asked
    client = Client(connection.address, timeout=ANSWER_S)
    client.name = client.description = "Scanbench"
    if connection.user:
        client.set_user(connection.user)
        client.set_password(connection.password)
    try:
        async with asyncio.timeout(3 * ANSWER_S):
            await client.connect()
    except _TROUBLES as error:
        with suppress(Exception):
            client.disconnect_socket()
        raise _unreachable(connection.address, error) from error
    return OpcUaSource(connection, client)


class OpcUaSource:
    """See `Source`."""

    def __init__(self, connection: Connection, client: Client) -> None:
        self._connection, self._client = connection, client
        self._nodes: list[ua.NodeId] = []

    async def find(self) -> Found:
        """See `Source`."""
        try:
            return await (self._named() if self._connection.nodes else self._all())
        except _TROUBLES as error:
            raise _unreachable(self._connection.address, error) from error

    async def read(self, wanted: Sequence[int]) -> Sequence[str]:
        """See `Source`."""
        try:
            values = await self._values([self._nodes[each] for each in wanted])
        except _TROUBLES as error:
            raise _unreachable(self._connection.address, error) from error
        return [self._cell(self._nodes[at], value) for at, value in zip(wanted, values, strict=True)]

    async def close(self) -> None:
        """See `Source`."""
        with suppress(Exception):
            async with asyncio.timeout(ANSWER_S):
                await self._client.disconnect()

    # ---- what there is --------------------------------------------------------------------------------------------

    async def _named(self) -> Found:
        """The nodes that somebody named, each of which has to be there and to have a single value."""
        wanted = tuple(dict.fromkeys(self._connection.nodes))
        for text in wanted:
            try:
                self._nodes.append(ua.NodeId.from_string(text))
            except (ua.UaError, ValueError) as error:
                raise Unreachable(
                    f"`{text}` is no id of a node: write ns=2;s=NAME or ns=2;i=NUMBER", for_good=True
                ) from error
        for text, node, value in zip(wanted, self._nodes, await self._values(self._nodes), strict=True):
            self._cell(node, value)
            if value.Value is not None and not _is_single(value):
                raise Unreachable(f"the node {text} has no single value: name its elements", for_good=True)
        names = [
            str(each.Identifier) if isinstance(each.Identifier, str) else text
            for each, text in zip(self._nodes, wanted, strict=True)
        ]
        return Found(_apart(names, list(wanted)))

    async def _all(self) -> Found:
        """All variables that the server shows below its folder Objects, and that have a single value."""
        nodes, more = await self._browsed()
        values = await self._values([each.id for each in nodes])
        good = [
            (node, value) for node, value in zip(nodes, values, strict=True)
            if value.StatusCode is None or value.StatusCode.is_good() or value.StatusCode.value in _NO_VALUE
        ]  # fmt: skip
        single = [node for node, value in good if value.Value is None or value.Value.Value is None or _is_single(value)]
        kept = single[:MOST]
        left_out = []
        if len(nodes) > len(good):
            left_out.append(f"{len(nodes) - len(good):,} variables that the server does not let read.")
        if len(good) > len(single):
            left_out.append(f"Arrays and structures ({len(good) - len(single):,}): name the nodes of their elements.")
        if len(single) > len(kept):
            left_out.append(
                f"{len(single) - len(kept):,} variables after the first {MOST:,}: name the nodes that are wanted."
            )
        if more:
            left_out.append(f"What is beyond the first {_MOST_NODES:,} nodes: name the nodes that are wanted.")
        if not kept:
            raise Unreachable(f"{self._connection.address} shows no variable that can be read", for_good=True)
        self._nodes = [each.id for each in kept]
        short = [each.name if not isinstance(each.id.Identifier, str) else each.id.Identifier for each in kept]
        return Found(_apart(short, [each.path for each in kept]), tuple(left_out))

    async def _browsed(self) -> tuple[list[_Node], bool]:
        """Variables by breadth; and whether there are more than are looked at."""
        ahead = [_Node(ua.NodeId(ua.Int32(ua.ObjectIds.ObjectsFolder)), "", "")]
        seen, found = {ahead[0].id}, list[_Node]()
        while ahead and len(seen) < _MOST_NODES:
            now, ahead = ahead[:_AT_ONCE], ahead[_AT_ONCE:]
            for parent, children in zip(now, await self._below([each.id for each in now]), strict=True):
                for each in children:
                    if each.NodeId in seen or (each.NodeId.NamespaceIndex == 0 and each.NodeId.Identifier == _SERVER):
                        continue
                    seen.add(each.NodeId)
                    name = each.BrowseName.Name or ""
                    node = _Node(each.NodeId, f"{parent.path}/{name}" if parent.path else name, name)
                    ahead.append(node)
                    if each.NodeClass == ua.NodeClass.Variable and each.NodeId.NamespaceIndex != 0:
                        found.append(node)
        return found, bool(ahead)

    async def _below(self, nodes: Sequence[ua.NodeId]) -> list[list[ua.ReferenceDescription]]:
        asked = ua.BrowseParameters()
        asked.RequestedMaxReferencesPerNode = ua.UInt32(0)
        asked.NodesToBrowse = [_children_of(each) for each in nodes]
        results = await self._client.uaclient.browse(asked)
        found = [list(each.References) for each in results]
        for at, each in enumerate(results):
            point = each.ContinuationPoint
            while point:  # the server gives them in parts
                next = ua.BrowseNextParameters(ReleaseContinuationPoints=False, ContinuationPoints=[point])
                (part,) = await self._client.uaclient.browse_next(next)
                found[at] += part.References
                point = part.ContinuationPoint
        return found

    # ---- values -----------------------------------------------------------------------------------------------------

    async def _values(self, nodes: Sequence[ua.NodeId]) -> list[ua.DataValue]:
        found: list[ua.DataValue] = []
        for at in range(0, len(nodes), _AT_ONCE):
            found += await self._client.uaclient.read_attributes(list(nodes[at : at + _AT_ONCE]), ua.AttributeIds.Value)
        return found

    def _cell(self, node: ua.NodeId, value: ua.DataValue) -> str:
        """The value as a log has it. A node that is not there, or may not be read, is `Unreachable`."""
        status = value.StatusCode
        if status is not None and not status.is_good():
            if status.value in _NO_VALUE:
                return ""
            raise Unreachable(f"the controller gives no value of {node.to_string()}: {status.name}", for_good=True)
        return "" if value.Value is None else cell_text(value.Value)


def _children_of(id: ua.NodeId) -> ua.BrowseDescription:
    wanted = ua.BrowseDescription()
    wanted.NodeId, wanted.BrowseDirection, wanted.IncludeSubtypes = id, ua.BrowseDirection.Forward, True
    wanted.ReferenceTypeId = ua.NodeId(ua.Int32(ua.ObjectIds.HierarchicalReferences))
    wanted.NodeClassMask = ua.UInt32(ua.NodeClass.Object | ua.NodeClass.Variable)
    wanted.ResultMask = ua.UInt32(ua.BrowseResultMask.All)
    return wanted


def _is_single(value: ua.DataValue) -> bool:
    variant = value.Value
    return (
        variant is not None and not variant.is_array and isinstance(variant.Value, bool | int | float | str | datetime)
    )


def cell_text(variant: ua.Variant) -> str:
    """A single value as the cell of a log. A text is a literal in quotes: its spaces, and quotes of its own, are kept."""
    value: Any = variant.Value
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, float):
        return f"{value:.9g}" if variant.VariantType == ua.VariantType.Float else repr(value)
    if isinstance(value, datetime):
        aware = value if value.tzinfo is not None else value.replace(tzinfo=UTC)
        passed = aware - _1970
        return str((passed.days * 86_400 + passed.seconds) * 1_000_000_000 + passed.microseconds * 1000)
    if isinstance(value, str):
        return "'{}'".format(value.replace("$", "$$").replace("'", "$'"))
    return "" if value is None else str(int(value) if isinstance(value, int) else value)


def _apart(names: Sequence[str], longer: Sequence[str]) -> tuple[str, ...]:
    """The names; of those that are there twice the longer ones, with a number where that does not help."""
    found: list[str] = []
    for at, name in enumerate(names):
        made = name if names.count(name) == 1 and name.strip() else longer[at]
        number = 2
        while made in found:
            made, number = f"{longer[at]} ({number})", number + 1
        found.append(made.strip())
    return tuple(found)


def _unreachable(address: str, error: Exception) -> Unreachable:
    if isinstance(error, ua.UaStatusCodeError):
        name = ua.StatusCode(ua.UInt32(error.code)).name
        denied = name in ("BadUserAccessDenied", "BadIdentityTokenRejected", "BadIdentityTokenInvalid")
        hint = ": give a user and a password that it knows" if denied else ""
        return Unreachable(f"the controller at {address} refuses: {name}{hint}", for_good=denied)
    if isinstance(error, ConnectionRefusedError):
        return Unreachable(f"nothing listens at {address}: is the controller on, and is its OPC UA server?")
    if isinstance(error, TimeoutError | asyncio.TimeoutError):
        return Unreachable(f"the controller at {address} does not answer")
    if isinstance(error, ConnectionError) or not str(error):
        return Unreachable(f"the connection to {address} was lost")
    return Unreachable(f"{address} cannot be reached: {getattr(error, 'strerror', None) or error}")
