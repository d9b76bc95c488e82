"""The errors of the PLC: what is present as variables, and each as an alarm that comes and goes."""

from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

from asyncua import Server, ua
from asyncua.server.event_generator import EventGenerator

from scanbench.comm.opcua.ids import own, standard
from scanbench.comm.opcua.space import Variable
from scanbench.comm.opcua.values import Values, bad, good
from scanbench.runtime.clock import wall_time
from scanbench.wire.opcua import OpcUaErrors, PresentError

FATAL, NON_FATAL = 900, 500
"""Severities, of 1 to 1000."""


class Errors:
    """Below a node of its own, which also tells of what comes and goes."""

    def __init__(self, server: Server, values: Values, node: ua.NodeId, shown: Mapping[str, Variable]) -> None:
        """`shown`: variables `Present`, `Count` and `Fatal`."""
        self._server, self._values, self._node, self._shown = server, values, node, shown
        self._present: dict[str, PresentError] = {}
        self._alarms: dict[str, EventGenerator] = {}

    async def take(self, told: OpcUaErrors) -> None:
        """Shows what is present now, and tells of the difference."""
        if not told.known:
            for variable in self._shown.values():
                await self._values.give(variable, None, bad(ua.StatusCodes.BadNoCommunication))
            return
        now = {each.key: each for each in told.errors}
        texts = [text_of(each) for each in now.values()]
        fatal = any(each.fatal for each in now.values())
        at = wall_time()
        for name, value in (
            ("Present", ua.Variant(texts, ua.VariantType.String, is_array=True)),
            ("Count", ua.Variant(len(now), ua.VariantType.UInt32)),
            ("Fatal", ua.Variant(fatal, ua.VariantType.Boolean)),
        ):
            await self._values.give(self._shown[name], None, good(value, at))
        before, self._present = self._present, now
        for key, each in now.items():
            if before.get(key) != each:
                await self._tell(each, active=True)
        for key, each in before.items():
            if key not in now:
                await self._tell(each, active=False)

    async def _tell(self, error: PresentError, active: bool) -> None:
        """An OffNormalAlarm: raised, or gone."""
        alarm = self._alarms.get(error.key)
        if alarm is None:
            alarm = self._alarms[error.key] = EventGenerator(self._server.iserver.isession)
            await alarm.init(ua.ObjectIds.OffNormalAlarmType, ua.ObjectIds.Server, add_generates_event=False)
        event: Any = alarm.event
        event.NodeId = own(f"alarm:{error.key}")
        event.SourceNode = self._node
        event.ConditionName, event.SourceName = error.key, error.name
        event.ConditionClassName = ua.LocalizedText("SystemConditionClassType")
        event.ConditionClassId = standard(ua.ObjectIds.SystemConditionClassType)
        event.Severity = FATAL if error.fatal else NON_FATAL
        event.Retain, event.Enabled = active, True
        event.EnabledState = ua.LocalizedText("Enabled")
        setattr(event, "EnabledState/Id", True)
        event.ActiveState = ua.LocalizedText("Active" if active else "Inactive")
        setattr(event, "ActiveState/Id", active)
        event.AckedState = ua.LocalizedText("Acknowledged")
        setattr(event, "AckedState/Id", True)
        at = error.since if active and error.since is not None else datetime.now(UTC)
        await alarm.trigger(at, text_of(error) if active else f"recovered: {text_of(error)}")


def text_of(error: PresentError) -> str:
    """`00F7 battery error (unit=3)`."""
    text = " ".join(filter(None, (error.code, error.name)))
    return f"{text} ({error.details})" if error.details else text
