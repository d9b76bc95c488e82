"""What clients may subscribe to and how, and when they are told."""

import logging
from typing import Any

from asyncua import ua
from asyncua.server import internal_subscription, monitored_item_service
from asyncua.server.monitored_item_service import MonitoredItemService, MonitoredItemValues, WhereClauseEvaluator
from asyncua.server.subscription_service import SubscriptionService
from asyncua.ua import uaprotocol_auto

from scanbench.comm.opcua.ids import standard
from scanbench.comm.opcua.space import Variable

log = logging.getLogger("scanbench")
_NUMBERS = frozenset({
    ua.VariantType.SByte, ua.VariantType.Byte, ua.VariantType.Int16, ua.VariantType.UInt16, ua.VariantType.Int32,
    ua.VariantType.UInt32, ua.VariantType.Int64, ua.VariantType.UInt64, ua.VariantType.Float, ua.VariantType.Double,
})  # fmt: skip

_SUBTYPE = standard(ua.ObjectIds.HasSubtype)


def refusal(asked: ua.MonitoredItemCreateRequest, variable: Variable | None) -> int:
    """Why this cannot be subscribed to, as a status code; 0: it can, as far as index and filter go. A filter that is none becomes
    None, which asyncua needs."""
    codes, what, how = ua.StatusCodes, asked.ItemToMonitor, asked.RequestedParameters
    if isinstance(how.Filter, ua.ExtensionObject) and how.Filter.TypeId == ua.NodeId():
        how.Filter = None
    if what.IndexRange:
        return int(codes.BadIndexRangeInvalid)
    if what.AttributeId == ua.AttributeIds.EventNotifier:
        return 0 if isinstance(how.Filter, uaprotocol_auto.EventFilter) else int(codes.BadMonitoredItemFilterInvalid)
    if how.Filter is None:
        return 0
    if not isinstance(how.Filter, uaprotocol_auto.DataChangeFilter):
        return int(codes.BadMonitoredItemFilterUnsupported)
    match how.Filter.DeadbandType:
        case ua.DeadbandType.None_:
            return 0
        case ua.DeadbandType.Absolute if variable is not None and _is_number(variable):
            return 0 if how.Filter.DeadbandValue >= 0 else int(codes.BadDeadbandFilterInvalid)
        case _:  # of a percentage one would have to know the range
            return int(codes.BadFilterNotAllowed)


def _is_number(variable: Variable) -> bool:
    return variable.form.variant in _NUMBERS and not variable.form.dimensions


class _Told(MonitoredItemValues):
    """What was told last, to compare with. A value is never changed here, so it need not be copied, which takes half of the time."""

    def set_current_datavalue(self, cur_val: ua.DataValue) -> None:
        """See asyncua."""
        self.old_dvalue, self.current_dvalue = self.current_dvalue, cur_val


class _Items(MonitoredItemService):
    """asyncua's, which no value and no filter can break."""

    def _is_deadband_exceeded(self, values: MonitoredItemValues, flt: ua.DataChangeFilter) -> bool:
        """Whether it is far enough from what was told last; where one of the two is no number, it is."""
        if flt.DeadbandType == ua.DeadbandType.None_:
            return True
        now, before = values.get_current_datavalue(), values.get_old_datavalue()
        this, last = _number(now), _number(before)
        if this is None or last is None or not abs(this - last) <= flt.DeadbandValue:
            return True
        values.current_dvalue = before
        return False

    async def _trigger_event(self, event: Any, mid: int) -> None:
        try:
            await super()._trigger_event(event, mid)
        except Exception:  # the others are told
            log.exception("a subscriber of OPC UA could not be told of an event")


class _Where(WhereClauseEvaluator):
    """asyncua's, for which an event is of a type also where it is of a subtype: lists of alarms ask for ConditionType, say."""

    def _eval_el(self, index: int, event: Any) -> Any:
        element = self.elements[index]
        if element.FilterOperator != ua.FilterOperator.OfType:
            return super()._eval_el(index, event)
        wanted, type = self._eval_op(element.FilterOperands[0], event), event.EventType
        while type is not None and type != wanted:
            type = self._above(type)
        return type is not None

    def _above(self, type: ua.NodeId) -> ua.NodeId | None:
        if type not in self._aspace:
            return None
        above = (
            each for each in self._aspace[type].references if each.ReferenceTypeId == _SUBTYPE and not each.IsForward
        )
        return next((each.NodeId for each in above), None)


class Publishing:
    """Tells clients right after values were read: in asyncua each subscription has a clock of its own, so that a value lies there for half
    of its interval in the mean. That clock goes on, for what is no value."""

    def __init__(self, service: SubscriptionService) -> None:
        self._service = service
        self._last: dict[int, float] = {}
        """When each subscription was told."""

    async def sampled(self, now: float, interval_s: float) -> None:
        """Values were read at `now`, and are every `interval_s`: each subscription is told as often as it wants."""
        there = self._service.subscriptions
        self._last = {id: at for id, at in self._last.items() if id in there}
        for id, each in list(there.items()):
            rest = each.data.RevisedPublishingInterval / 1000 - interval_s / 2
            if not each._triggered_datachanges or now - self._last.get(id, -rest) < rest:
                continue
            self._last[id] = now
            try:
                await each.publish_results()
            except Exception:  # the others are told
                log.exception("a subscription of OPC UA could not be told")


def _number(value: ua.DataValue | None) -> float | None:
    held = None if value is None or value.Value is None else value.Value.Value
    return held if isinstance(held, int | float) else None


vars(monitored_item_service)["MonitoredItemValues"] = _Told
vars(monitored_item_service)["WhereClauseEvaluator"] = _Where
vars(internal_subscription)["MonitoredItemService"] = _Items
