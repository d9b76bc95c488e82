"""Traces and their records -> wire shapes, and back. Nothing is decided here."""

from dataclasses import replace

from scanbench.public import iso
from scanbench.server.trace_records import TraceRecord
from scanbench.taps import trace as tap
from scanbench.web import messages_trace as wire


def wanted(of: wire.DefineTrace) -> tap.TraceDefinition:
    """What somebody wants recorded."""
    return tap.TraceDefinition(
        of.name.strip(), tuple(text.strip() for text in of.signals), of.every, of.scans, _trigger(of.trigger), of.repeat
    )


def changed(now: tap.TraceDefinition, by: wire.ChangeTrace) -> tap.TraceDefinition:
    """The definition with what changes; null counts only for the trigger, where it is said."""
    removed = {text.strip() for text in by.remove}
    signals = dict.fromkeys([*now.signals, *(text.strip() for text in by.add)])
    return tap.TraceDefinition(
        now.name if by.name is None else by.name.strip(),
        tuple(text for text in signals if text not in removed),
        now.every if by.every is None else by.every,
        now.scans if by.scans is None else by.scans,
        _trigger(by.trigger) if "trigger" in by.model_fields_set else now.trigger,
        now.repeat if by.repeat is None else by.repeat,
    )


def _trigger(of: tap.TraceTrigger | None) -> tap.TraceTrigger | None:
    return None if of is None else replace(of, text=of.text.strip(), value=of.value.strip())


def record(of: TraceRecord) -> wire.TraceRecordInfo:
    """A kept record."""
    row = of.row
    return wire.TraceRecordInfo.model_validate(
        {
            "id": row.id, "project": row.project, "name": row.name, "instance": row.instance, "origin": of.origin,
            "by": row.by, "at": iso(row.at), "signals": of.signals, "every": of.every,
            "triggered": of.triggered, "first": of.first, "end": of.end, "rows": of.rows,
            "interval_ns": of.interval_ns, "program_version": of.version,
        }
    )  # fmt: skip
