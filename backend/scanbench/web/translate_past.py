"""Findings about the past -> wire shapes. Nothing is decided here."""

from scanbench.history.contract import Change, Changes, Divergence, Writer
from scanbench.web import messages_past as wire
from scanbench.web.translate_verify import place
from scanbench.wire import events


def writer(of: Writer) -> wire.LastWriter:
    """Who last wrote a variable."""
    return wire.LastWriter(
        path=of.path, by=of.by, scan=of.scan, count=of.count, place=place(of.place), author=of.author, text=of.text,
        value=of.value.hex(), shown=of.shown,
    )  # fmt: skip


def changes(of: Changes) -> wire.RunChanges:
    """What changed."""
    return wire.RunChanges(
        first=of.first, last=of.last, changes=list(map(_change, of.changes)), count=of.count, note=of.note,
        entries=[wire.BetweenEntry(scan=scan, run="", author=author, text=text) for scan, author, text in of.entries],
    )  # fmt: skip


def _change(of: Change) -> wire.VariableChange:
    return wire.VariableChange(
        path=of.path, type=of.type, kind=of.kind, size=of.size, values=list(of.values), before=of.before.hex(),
        after=of.after.hex(), before_shown=of.before_shown, after_shown=of.after_shown,
    )  # fmt: skip


def comparison(of: events.ComparisonChanged) -> wire.Comparison:
    """How far a comparison is."""
    result = None if of.result is None else _divergence(of.result)
    return wire.Comparison(
        id=of.id, a=of.a, b=of.b, by=of.by, done=of.done, of=of.of, result=result, message=of.message
    )


def _divergence(of: Divergence) -> wire.RunDivergence:
    return wire.RunDivergence(
        compared=of.compared, first=of.first, last=of.last, scan=of.scan, cause=of.cause, text=of.text,
        place=place(of.place), changes=None if of.changes is None else changes(of.changes), marks=list(of.marks),
        entries=[
            wire.BetweenEntry.model_validate({"scan": scan, "run": run, "author": author, "text": text})
            for scan, run, author, text in of.entries
        ],
    )  # fmt: skip


def rerun(of: events.RerunChanged) -> wire.Rerun:
    """How far a replay with a change is."""
    return wire.Rerun(
        id=of.id, by=of.by, name=of.name, done=of.done, of=of.of, instance=of.instance, refused=list(of.refused),
        message=of.message,
    )  # fmt: skip
