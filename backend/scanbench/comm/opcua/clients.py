"""Who is connected, what each asks, and what that comes to: sessions of asyncua that reach the PLC."""

import hmac
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from hashlib import sha256
from typing import Any, cast

from asyncua import ua
from asyncua.crypto.permission_rules import USER_TYPES, SimpleRoleRuleset, User, UserRole
from asyncua.server.internal_server import InternalServer
from asyncua.server.internal_session import InternalSession
from asyncua.server.monitored_item_service import MonitoredItemData
from asyncua.server.user_managers import UserManager

from scanbench.comm.opcua.errors import METHODS, Errors
from scanbench.comm.opcua.forms import NoValue
from scanbench.comm.opcua.ids import standard
from scanbench.comm.opcua.items import refusal
from scanbench.comm.opcua.link import Link, NotThere
from scanbench.comm.opcua.space import READ, WRITE, Space, Variable
from scanbench.comm.opcua.values import FASTEST_MS, SLOWEST_MS, Values
from scanbench.runtime.clock import fresh_token
from scanbench.runtime.command import Command
from scanbench.runtime.write_variables import VariableWrite, WriteVariables
from scanbench.wire.opcua import OpcUaClient, OpcUaStart

Method = Callable[[str, Sequence[ua.Variant]], Command | None]
"""Makes a command of its author and arguments; None where they are wrong."""
_PROTOCOL = "OPC UA"
_NAME_LENGTH = 40
_TEXT_LENGTH = 80
_NAMED = 2
"""Variables that are named in the log, where many are asked for."""
_MOST_ITEMS = 20_000


@dataclass(slots=True)
class Desk:
    """What all sessions share."""

    start: OpcUaStart
    link: Link
    space: Space
    values: Values
    methods: dict[ua.NodeId, tuple[str, Method]]
    alarms: Errors | None
    """None: not made yet."""
    tellers: tuple[ua.NodeId, ...]
    """Objects whose events are those of the server."""


class Users(UserManager):
    """Anybody may say who they are; a name counts with the token of the server."""

    def __init__(self, start: OpcUaStart) -> None:
        self._start = start

    def get_user(
        self, iserver: InternalServer, username: str | None = None, password: str | None = None, certificate: Any = None
    ) -> User | None:  # fmt: skip
        """Who it is; None: nobody who may be here."""
        if username is None:
            return User(UserRole.Anonymous)
        given = sha256((password or "").encode()).digest()
        name = plain(username)
        return (
            User(UserRole.User, name) if name and password and hmac.compare_digest(given, self._start.token) else None
        )


class Rights(SimpleRoleRuleset):
    """Nobody changes the address space from outside; who may write is decided for each value."""

    def __init__(self) -> None:
        self._allowed = {standard(each) for each in USER_TYPES}

    def check_validity(self, user: User, action_type: ua.NodeId, body: Any) -> bool:
        """Whether anybody may ask this."""
        return action_type in self._allowed


class ToPlc(InternalServer):
    """asyncua's, whose sessions reach the PLC."""

    def __init__(self, desk: Desk) -> None:
        self.desk = desk
        super().__init__(Users(desk.start))

    def create_session(self, name: str, user: User = User(UserRole.Anonymous), external: bool = False) -> "Session":  # noqa: B008
        """See asyncua."""
        return Session(self, self.aspace, self.subscription_service, name, user=user, external=external)

    def register_external_session(self, session: InternalSession) -> None:
        """Who knows the token of a session can ask for it on another connection: asyncua counts them, so nobody shall know that."""
        session.auth_token = ua.NodeId(cast(ua.ByteString, fresh_token().encode()))
        super().register_external_session(session)


class Session(InternalSession):
    """One client."""

    iserver: ToPlc
    client = ""
    """Its name, as commands have it for their author; empty before it has said who it is."""
    application = ""
    holder: object = None
    """The connection that activated it last."""

    @property
    def _desk(self) -> Desk:
        return self.iserver.desk

    @property
    def may_write(self) -> bool:
        """Whether the server lets this client change anything."""
        start = self._desk.start
        return start.writable and (self.user.role is UserRole.User or start.anonymous_writes)

    # ---- here and gone --------------------------------------------------------------------------------------------

    async def create_session(
        self, params: ua.CreateSessionParameters, sockname: tuple[str, int] | None = None
    ) -> ua.CreateSessionResult:
        """Takes down what the client calls itself."""
        described = params.ClientDescription.ApplicationName
        self.application = plain((described.Text if described else None) or params.SessionName or "")
        return await super().create_session(params, sockname)

    def activate_session(
        self, params: ua.ActivateSessionParameters, peer_certificate: bytes | None
    ) -> ua.ActivateSessionResult:
        """From now on it is here."""
        result = super().activate_session(params, peer_certificate)
        self.leave()
        who = self.user.name or "anonymous"
        self.client = ", ".join(filter(None, (f"{_PROTOCOL} {who}", self.application)))
        self._desk.link.tell(OpcUaClient(self.client, True))
        return result

    def leave(self) -> None:
        """It is not here any more."""
        if self.client:
            self._desk.link.tell(OpcUaClient(self.client, False))
            self.client = ""

    async def close_session(self, delete_subs: bool = True) -> None:
        """See asyncua."""
        self.leave()
        await super().close_session(delete_subs)

    # ---- what it asks ---------------------------------------------------------------------------------------------

    async def read(self, params: ua.ReadParameters) -> list[ua.DataValue]:
        """Values are read from the present scan, all of one."""
        asked = params.NodesToRead or []
        wanted = {each.NodeId: found for each in asked if (found := self._variable(each.NodeId, each.AttributeId))}
        values = dict(zip(wanted, await self._desk.values.now(list(wanted.values())), strict=True)) if wanted else {}
        results = [_cut(values[each.NodeId], each.IndexRange) if each.NodeId in values and each.AttributeId == ua.AttributeIds.Value
                   else self._attribute(each) for each in asked]  # fmt: skip
        if wanted:
            outcome = next((_why(each.StatusCode) for each in values.values() if _is_bad(each)), "")
            self._note("read", list(wanted.values()), outcome)
        return results

    def _variable(self, id: ua.NodeId, attribute: int) -> Variable | None:
        if attribute != ua.AttributeIds.Value or id not in self._desk.space:
            return None
        found = self._desk.space.variables.get(id)
        return None if found is None or (found.head is None and not found.path) else found

    def _attribute(self, asked: ua.ReadValueId) -> ua.DataValue:
        found = self.aspace.read_attribute_value(asked.NodeId, asked.AttributeId)
        if asked.AttributeId == ua.AttributeIds.UserAccessLevel and not self.may_write and not _is_bad(found):
            if found.Value is not None and found.Value.Value == WRITE:
                return ua.DataValue(ua.Variant(READ, ua.VariantType.Byte))
        return found

    async def write(self, params: ua.WriteParameters) -> list[ua.StatusCode]:
        """What can be written is one command, all of it in one seam; what cannot is answered with why."""
        results: list[ua.StatusCode | None] = []
        writes: list[VariableWrite] = []
        texts: list[str] = []
        for each in params.NodesToWrite or []:
            found = self._write_of(each)
            texts.append(_id_text(each.NodeId))
            if isinstance(found, VariableWrite):
                writes.append(found)
                results.append(None)
            else:
                results.append(_status(found))
        outcome = next((_why(each) for each in results if each is not None), "")
        done = _status(ua.StatusCodes.Good)
        if writes:
            done, said = await self._entered(WriteVariables(self.client, tuple(writes)))
            outcome = said or outcome
        self._desk.link.asked(self.client, f"write {_listed(texts)}", outcome)
        return [each or done for each in results]

    def _write_of(self, asked: ua.WriteValue) -> VariableWrite | int:
        """The write that is meant, or why there is none."""
        codes = ua.StatusCodes
        if asked.NodeId not in self._desk.space:
            return codes.BadNodeIdUnknown
        variable = self._variable(asked.NodeId, asked.AttributeId)
        value = asked.Value.Value
        if variable is None or not variable.writable or not self.may_write:
            return (
                codes.BadUserAccessDenied if asked.AttributeId == ua.AttributeIds.Value else codes.BadWriteNotSupported
            )
        if asked.IndexRange:
            return codes.BadWriteNotSupported
        if value is None:
            return codes.BadTypeMismatch
        try:
            return VariableWrite(variable.path, variable.type, variable.form.data(value))
        except NoValue:
            return codes.BadOutOfRange
        except TypeError:
            return codes.BadTypeMismatch

    async def _entered(self, command: Command) -> tuple[ua.StatusCode, str]:
        """What became of a command, as a status and in words."""
        try:
            done = await self._desk.link.submit(self.client, command)
        except NotThere as error:
            return _status(ua.StatusCodes.BadNoCommunication), str(error)
        if done.ok:
            return _status(ua.StatusCodes.Good), ""
        return _status(ua.StatusCodes.BadInvalidState), done.message

    async def call(self, params: list[ua.CallMethodRequest]) -> list[ua.CallMethodResult]:
        """Methods of the PLC are commands; the others are OPC UA's own."""
        return [await self._called(each) for each in params]

    async def _called(self, request: ua.CallMethodRequest) -> ua.CallMethodResult:
        if request.MethodId in METHODS:
            return await self._said_of_alarm(request)
        own = self._desk.methods.get(request.MethodId)
        if own is None:
            return (await super().call([request]))[0]
        name, make = own
        if not self.may_write:
            status, outcome = _status(ua.StatusCodes.BadUserAccessDenied), "BadUserAccessDenied"
        elif (command := make(self.client, request.InputArguments or [])) is None:
            status, outcome = _status(ua.StatusCodes.BadInvalidArgument), "BadInvalidArgument"
        else:
            status, outcome = await self._entered(command)
        self._desk.link.asked(self.client, f"call {name}", outcome)
        return ua.CallMethodResult(status)

    async def _said_of_alarm(self, request: ua.CallMethodRequest) -> ua.CallMethodResult:
        alarms, codes = self._desk.alarms, ua.StatusCodes
        found: Command | int = codes.BadUserAccessDenied if not self.may_write else codes.BadNodeIdUnknown
        if self.may_write and alarms is not None:
            found = alarms.command(self.client, request)
        if isinstance(found, Command):
            status, outcome = await self._entered(found)
            if alarms is not None and status.is_good():
                await alarms.done(found)
        else:
            status = _status(found)
            outcome = status.name
        self._desk.link.asked(self.client, f"call {METHODS[request.MethodId]} {_id_text(request.ObjectId)}", outcome)
        return ua.CallMethodResult(status)

    # ---- subscriptions --------------------------------------------------------------------------------------------

    async def create_subscription(
        self, params: ua.CreateSubscriptionParameters, callback: Callable[..., Any],
        request_callback: Callable[..., Any] | None = None,
    ) -> ua.CreateSubscriptionResult:  # fmt: skip
        """Within bounds: what is subscribed to is read as often as the fastest of all clients wants."""
        params.RequestedPublishingInterval = max(FASTEST_MS, params.RequestedPublishingInterval)
        result = await super().create_subscription(params, callback, request_callback)
        self._pace()
        return result

    async def delete_subscriptions(self, ids: list[int]) -> list[ua.StatusCode]:
        """See asyncua."""
        results = await super().delete_subscriptions(ids)
        self._pace()
        return results

    def _pace(self) -> None:
        wanted = [each.data.RevisedPublishingInterval for each in self.subscription_service.subscriptions.values()]
        self._desk.values.interval_ms = min([SLOWEST_MS, *wanted])

    async def create_monitored_items(
        self, params: ua.CreateMonitoredItemsParameters
    ) -> list[ua.MonitoredItemCreateResult]:
        """Each begins with its present value."""
        asked = params.ItemsToCreate or []
        for each in asked:
            if (
                each.ItemToMonitor.AttributeId == ua.AttributeIds.EventNotifier
                and each.ItemToMonitor.NodeId in self._desk.tellers
            ):
                each.ItemToMonitor.NodeId = standard(ua.ObjectIds.Server)  # which tells of everything
        there = sum(
            len(each.monitored_item_srv._monitored_items) for each in self.subscription_service.subscriptions.values()
        )
        if there + len(asked) > _MOST_ITEMS:
            refused = ua.MonitoredItemCreateResult(_status(ua.StatusCodes.BadTooManyMonitoredItems))
            self._desk.link.asked(self.client, f"subscribe {len(asked)}", "BadTooManyMonitoredItems")
            return [refused] * len(asked)
        found = [self._variable(each.ItemToMonitor.NodeId, each.ItemToMonitor.AttributeId) for each in asked]
        refusals = [refusal(*each) for each in zip(asked, found, strict=True)]
        variables = [each for each in found if each is not None]
        wanted = {each.id: each for each, why in zip(found, refusals, strict=True) if each is not None and not why}
        if wanted:
            await self._desk.values.refresh(list(wanted.values()))
        params.ItemsToCreate = [each for each, why in zip(asked, refusals, strict=True) if not why]
        made = iter(await super().create_monitored_items(params))
        results = [ua.MonitoredItemCreateResult(_status(why)) if why else next(made) for why in refusals]
        self._desk.values.watch(wanted)
        if variables:
            outcome = next((_why(each.StatusCode) for each in results if not each.StatusCode.is_good()), "")
            self._note("subscribe", variables, outcome)
        return results

    async def modify_monitored_items(
        self, params: ua.ModifyMonitoredItemsParameters
    ) -> list[ua.MonitoredItemModifyResult]:
        """Another filter is refused where a new item with it would be."""
        subscription = self.subscription_service.subscriptions.get(params.SubscriptionId)
        if subscription is None:
            raise ua.uaerrors.BadSubscriptionIdInvalid
        there = subscription.monitored_item_srv._monitored_items
        asked = params.ItemsToModify or []
        refusals = [self._refused_change(each, there.get(each.MonitoredItemId)) for each in asked]
        params.ItemsToModify = [each for each, why in zip(asked, refusals, strict=True) if not why]
        made = iter(await super().modify_monitored_items(params))
        return [ua.MonitoredItemModifyResult(_status(why)) if why else next(made) for why in refusals]

    def _refused_change(self, asked: ua.MonitoredItemModifyRequest, item: MonitoredItemData | None) -> int:
        if item is None or item.read_value_id is None:
            return int(ua.StatusCodes.BadMonitoredItemIdInvalid)
        about = item.read_value_id
        changed = ua.MonitoredItemCreateRequest(about, RequestedParameters=asked.RequestedParameters)
        return refusal(changed, self._variable(about.NodeId, about.AttributeId))

    def _note(self, what: str, variables: Sequence[Variable], outcome: str) -> None:
        names = [plain(each.path, _TEXT_LENGTH) or _id_text(each.id) for each in variables]
        spans = [each.span for each in variables if each.span is not None]
        self._desk.link.asked(self.client, f"{what} {_listed(names)}", outcome, spans)


def plain(text: str, length: int = _NAME_LENGTH) -> str:
    """A name that somebody gives, fit to be shown."""
    return "".join(each for each in text if each.isprintable()).strip()[:length]


def _id_text(id: ua.NodeId) -> str:
    """What a client calls a node, as the log keeps it: a client may give any number of characters."""
    return plain(id.Identifier if isinstance(id.Identifier, str) else str(id.Identifier), _TEXT_LENGTH)


def _listed(names: Sequence[str]) -> str:
    more = len(names) - _NAMED
    return ", ".join(names[:_NAMED]) + (f" and {more} more" if more > 0 else "")


def _status(code: int) -> ua.StatusCode:
    return ua.StatusCode(ua.UInt32(code))


def _is_bad(value: ua.DataValue) -> bool:
    return value.StatusCode is not None and value.StatusCode.is_bad()


def _why(status: ua.StatusCode | None) -> str:
    return "" if status is None else status.name


def _cut(value: ua.DataValue, part: str | None) -> ua.DataValue:
    """Of an array the elements that are asked for: `3`, or `2:5`."""
    if not part or _is_bad(value) or value.Value is None:
        return value
    first, _, last = part.partition(":")
    found = value.Value.Value
    if (
        not isinstance(found, list)
        or (found and isinstance(found[0], list))
        or not (first.isdigit() and (last or "0").isdigit())
    ):
        return ua.DataValue(ua.Variant(), _status(ua.StatusCodes.BadIndexRangeInvalid))
    piece = found[int(first) : int(last or first) + 1]
    if not piece:
        return ua.DataValue(ua.Variant(), _status(ua.StatusCodes.BadIndexRangeNoData))
    variant = ua.Variant(piece, value.Value.VariantType, is_array=True)
    return ua.DataValue(variant, SourceTimestamp=value.SourceTimestamp, ServerTimestamp=value.ServerTimestamp)
