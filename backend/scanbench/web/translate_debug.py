"""What the session says of debugging -> wire shapes."""

from dataclasses import asdict

from scanbench.debug.breakpoint import Verdict
from scanbench.debug.halt import Halt
from scanbench.taps.covered import CoveredSite
from scanbench.web import messages_debug as wire
from scanbench.wire import debugging as debug_protocol


def halt(now: Halt | None) -> wire.HaltInfo | None:
    """Where the PLC is halted."""
    if now is None:
        return None
    span = now.span
    return wire.HaltInfo(
        number=now.number, reason=now.reason, text=now.text, by=now.by, file=span.file if span else "",
        line=span.line if span else 0, column=span.column if span else 0, end_line=span.end_line if span else 0,
        end_column=span.end_column if span else 0, pou=now.pou, instance=now.instance, task=now.task, count=now.count,
        past=now.past,
    )  # fmt: skip


def breakpoint(verdict: Verdict) -> wire.BreakpointInfo:
    """A breakpoint, and what became of it."""
    one = verdict.breakpoint
    return wire.BreakpointInfo(
        id=one.id, kind=one.kind, author=one.author, group=one.group, enabled=one.enabled, file=one.file,
        line=one.line, path=one.path, access=one.access, error=one.error, scan=one.scan, condition=one.condition,
        hits=one.hits, log=one.log, assign=one.assign, instance=one.instance, task=one.task,
        verified=verdict.verified, message=verdict.message, at_line=verdict.line, at_column=verdict.column,
        reached=verdict.hits,
    )  # fmt: skip


def binding(found: debug_protocol.Binding) -> wire.Binding:
    """What an in-out is bound to."""
    return wire.Binding(
        ok=found.ok, message=found.message, convention=found.convention,
        sites=[wire.BoundTo.model_validate(asdict(site)) for site in found.sites],
    )  # fmt: skip


def coverage(found: debug_protocol.Coverage) -> wire.Coverage:
    """What was reached."""
    return wire.Coverage(
        on=found.on, since_scan=found.since_scan, scans=found.scans,
        files=[wire.CoveredFile(file=each.file, sites=list(map(_site, each.sites))) for each in found.files],
    )  # fmt: skip


def _site(site: CoveredSite) -> wire.CoveredSite:
    return wire.CoveredSite(
        line=site.line, column=site.column, end_line=site.end_line, end_column=site.end_column, pou=site.pou,
        reached=site.reached, outcomes=[wire.CoveredOutcome(name=name, taken=taken) for name, taken in site.outcomes],
    )  # fmt: skip
