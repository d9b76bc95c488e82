"""What the session says of debugging -> wire shapes."""

from scanbench.debug.breakpoint import Verdict
from scanbench.debug.halt import Halt
from scanbench.web import messages_debug as wire


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
        line=one.line, column=one.column, path=one.path, access=one.access, error=one.error, scan=one.scan, condition=one.condition,
        hits=one.hits, log=one.log, assign=one.assign, instance=one.instance, task=one.task,
        verified=verdict.verified, message=verdict.message, at_line=verdict.line, at_column=verdict.column,
        reached=verdict.hits,
    )  # fmt: skip
