"""Traces and their records -> wire shapes, and back. Nothing is decided here."""

from scanbench.public import iso
from scanbench.server.trace_records import TraceRecord
from scanbench.taps import trace as tap
from scanbench.web import messages_trace as wire
from scanbench.wire import events
from scanbench.wire.traces import TraceStatus


def wanted(of: wire.TraceDefinition) -> tap.TraceDefinition:
    """What somebody wants recorded."""
    trigger = of.trigger
    return tap.TraceDefinition(
        of.name.strip(), tuple(text.strip() for text in of.signals), of.every, of.scans,
        None if trigger is None else tap.TraceTrigger(trigger.text.strip(), trigger.when, trigger.value.strip(), trigger.before),
        of.repeat,
    )  # fmt: skip


def definition(of: tap.TraceDefinition) -> wire.TraceDefinition:
    """What is recorded."""
    trigger = of.trigger
    return wire.TraceDefinition(
        name=of.name, signals=list(of.signals), every=of.every, scans=of.scans, repeat=of.repeat,
        trigger=None if trigger is None else wire.TraceTrigger.model_validate(
            {"text": trigger.text, "when": trigger.when, "value": trigger.value, "before": trigger.before}
        ),
    )  # fmt: skip


def info(of: TraceStatus) -> wire.TraceInfo:
    """How a trace stands."""
    return wire.TraceInfo.model_validate(
        {
            "id": of.id, "definition": definition(of.definition), "by": of.by, "state": of.state,
            "signals": of.signals, "generation": of.generation, "triggered": of.triggered,
            "hits": of.hits, "rows": of.rows, "first": of.first, "end": of.end, "bytes": of.bytes,
            "interval_ns": of.interval_ns, "note": of.note,
        }
    )  # fmt: skip


def traces(happened: events.TracesChanged) -> wire.Traces:
    """All traces."""
    return wire.Traces(traces=list(map(info, happened.traces)))


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
