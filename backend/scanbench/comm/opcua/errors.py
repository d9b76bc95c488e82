"""The errors of the PLC: what is present as variables, and each as an alarm that comes, goes, and is acknowledged."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from typing import Any

from asyncua import Server, ua
from asyncua.server.event_generator import EventGenerator

from scanbench.comm.opcua.ids import own, standard
from scanbench.comm.opcua.space import Variable
from scanbench.comm.opcua.values import Values, bad, good
from scanbench.faults.acknowledge import LONGEST_REMARK, Acknowledge, Remark
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Command
from scanbench.wire.opcua import OpcUaErrors, RaisedError

FATAL, NON_FATAL = 900, 500
"""Severities, of 1 to 1000."""
ACKNOWLEDGE, ADD_COMMENT, CONFIRM = (
    standard(each)
    for each in (
        ua.ObjectIds.AcknowledgeableConditionType_Acknowledge, ua.ObjectIds.ConditionType_AddComment,
        ua.ObjectIds.AcknowledgeableConditionType_Confirm,
    )
)  # fmt: skip
METHODS: Mapping[ua.NodeId, str] = {ACKNOWLEDGE: "Acknowledge", ADD_COMMENT: "AddComment", CONFIRM: "Confirm"}
"""Of the alarms, which have no nodes: a client calls the method of the type, and gives the alarm's id as the object."""
_ALARM = "alarm:"
_EVENTS_KEPT = 8


@dataclass(eq=False, slots=True)
class _Alarm:
    told: RaisedError
    events: EventGenerator
    ids: list[bytes] = field(default_factory=list)
    """Of what was told of it since it was raised: what a client acknowledges is one of them."""


class Errors:
    """Below a node of its own, which also tells of what comes and goes."""

    def __init__(self, server: Server, values: Values, node: ua.NodeId, shown: Mapping[str, Variable]) -> None:
        """`shown`: variables `Present`, `Count` and `Fatal`."""
        self._server, self._values, self._node, self._shown = server, values, node, shown
        self._alarms: dict[str, _Alarm] = {}
        """Those that are present, or were and nobody has acknowledged it."""

    async def take(self, told: OpcUaErrors) -> None:
        """Shows what is present now, and tells of the difference."""
        if not told.known:
            for variable in self._shown.values():
                await self._values.give(variable, None, bad(ua.StatusCodes.BadNoCommunication))
            return
        present = [each for each in told.errors if each.present]
        at = wall_time()
        for name, value in (
            ("Present", ua.Variant(list(map(text_of, present)), ua.VariantType.String, is_array=True)),
            ("Count", ua.Variant(len(present), ua.VariantType.UInt32)),
            ("Fatal", ua.Variant(any(each.fatal for each in present), ua.VariantType.Boolean)),
        ):
            await self._values.give(self._shown[name], None, good(value, at))
        now = {each.key: each for each in told.errors}
        for key, each in now.items():
            await self._follow(key, each)
        for key, alarm in list(self._alarms.items()):
            if key not in now:  # another program has no such error
                await self._tell(alarm, replace(alarm.told, present=False), retain=False)
                del self._alarms[key]

    async def _follow(self, key: str, error: RaisedError) -> None:
        """Tells of one error what is new. What was over before this server looked is none of its alarms."""
        alarm = self._alarms.get(key)
        if alarm is None:
            if not error.present:
                return
            alarm = self._alarms[key] = _Alarm(error, await self._generator(key))
        elif alarm.told == error:
            return
        elif (alarm.told.since, alarm.told.scan) != (error.since, error.scan):
            alarm.ids.clear()
        retain = error.present or not error.acknowledged_by
        await self._tell(alarm, error, retain)
        if not retain:
            del self._alarms[key]

    async def _generator(self, key: str) -> EventGenerator:
        """Of OffNormalAlarms, with what is the same in all of its events."""
        made = EventGenerator(self._server.iserver.isession)
        await made.init(ua.ObjectIds.OffNormalAlarmType, ua.ObjectIds.Server, add_generates_event=False)
        event: Any = made.event
        event.NodeId, event.SourceNode, event.ConditionName = own(_ALARM + key), self._node, key
        event.ConditionClassName = ua.LocalizedText("SystemConditionClassType")
        event.ConditionClassId = standard(ua.ObjectIds.SystemConditionClassType)
        event.Enabled, event.EnabledState = True, ua.LocalizedText("Enabled")
        setattr(event, "EnabledState/Id", True)
        event.BranchId = event.InputNode = event.NormalState = ua.NodeId()
        event.Quality = ua.StatusCode(ua.UInt32(ua.StatusCodes.Good))
        event.SuppressedOrShelved = False
        event.Comment, event.ClientUserId = ua.LocalizedText(""), ""
        return made

    async def _tell(self, alarm: _Alarm, error: RaisedError, retain: bool) -> None:
        """What is the case with an error now."""
        event: Any = alarm.events.event
        before, alarm.told = alarm.told, error
        event.SourceName, event.Retain = error.name, retain
        event.Severity = event.LastSeverity = FATAL if error.fatal else NON_FATAL
        acknowledged = bool(error.acknowledged_by)
        event.ActiveState = ua.LocalizedText("Active" if error.present else "Inactive")
        event.AckedState = ua.LocalizedText("Acknowledged" if acknowledged else "Unacknowledged")
        setattr(event, "ActiveState/Id", error.present)
        setattr(event, "AckedState/Id", acknowledged)
        came, went = before is error or before.since != error.since, before.present and not error.present
        if came or (acknowledged and not before.acknowledged_by):
            event.ClientUserId, event.Comment = error.acknowledged_by, ua.LocalizedText(error.remark)
        at = (error.since if came else error.until if went else None) or datetime.now(UTC)
        await self._trigger(alarm, at)

    async def _trigger(self, alarm: _Alarm, at: datetime) -> None:
        text = text_of(alarm.told)
        await alarm.events.trigger(at, text if alarm.told.present else f"recovered: {text}")
        alarm.ids = [*alarm.ids[1 - _EVENTS_KEPT :], alarm.events.event.EventId.Value]

    # ---- what clients say of it -----------------------------------------------------------------------------------

    def command(self, author: str, request: ua.CallMethodRequest) -> Command | int:
        """What a client means that calls one of `METHODS`; or why it cannot be, as a status code."""
        codes, given = ua.StatusCodes, [each.Value for each in request.InputArguments or []]
        if request.MethodId == CONFIRM:
            return codes.BadNotSupported  # a second acknowledgement, which is optional in OPC UA
        alarm = self._alarm(request.ObjectId)
        if alarm is None:
            return codes.BadNodeIdUnknown
        if not _are_event_and_comment(given):
            return codes.BadInvalidArgument if len(given) == 2 else codes.BadArgumentsMissing
        if given[0] not in alarm.ids:
            return codes.BadEventIdUnknown
        remark = "".join(each for each in given[1].Text or "" if each.isprintable()).strip()[:LONGEST_REMARK]
        if request.MethodId == ADD_COMMENT:
            return Remark(author, alarm.told.key, remark)
        if alarm.told.acknowledged_by:
            return codes.BadConditionBranchAlreadyAcked
        return Acknowledge(author, alarm.told.key, remark, alarm.told.scan)

    async def done(self, command: Command) -> None:
        """A remark was entered: others who have subscribed are told. (Acknowledgements come with the errors.)"""
        alarm = self._alarms.get(command.error) if isinstance(command, Remark) else None
        if isinstance(command, Remark) and alarm is not None:
            event: Any = alarm.events.event
            event.ClientUserId, event.Comment = command.author, ua.LocalizedText(command.remark)
            await self._trigger(alarm, datetime.now(UTC))

    def _alarm(self, id: ua.NodeId) -> _Alarm | None:
        name = id.Identifier
        if id.NamespaceIndex != own(0).NamespaceIndex or not isinstance(name, str) or not name.startswith(_ALARM):
            return None
        return self._alarms.get(name[len(_ALARM) :])


def _are_event_and_comment(given: Sequence[object]) -> bool:
    return len(given) == 2 and isinstance(given[0], bytes) and isinstance(given[1], ua.LocalizedText)


def text_of(error: RaisedError) -> str:
    """`00F7 battery error (unit=3)`."""
    text = " ".join(filter(None, (error.code, error.name)))
    return f"{text} ({error.details})" if error.details else text
