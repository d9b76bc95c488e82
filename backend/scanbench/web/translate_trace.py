"""Traces and their records -> wire shapes, and back. Nothing is decided here."""

from dataclasses import replace

from scanbench.public import iso
from scanbench.server.trace_records import TraceRecord
from scanbench.taps import trace as tap
from scanbench.web import messages_trace as wire


def wanted(of: wire.DefineTrace) -> tap.TraceDefinition:
    """What somebody wants recorded."""
    trigger = of.trigger
    return tap.TraceDefinition(
        of.name.strip(), tuple(text.strip() for text in of.signals), of.every, of.scans,
        None if trigger is None else replace(trigger, text=trigger.text.strip(), value=trigger.value.strip()), of.repeat,
    )  # fmt: skip


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
