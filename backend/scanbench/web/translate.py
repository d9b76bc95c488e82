"""The session's dataclasses -> wire shapes. Nothing is decided here."""

from scanbench.faults.history import ErrorRow
from scanbench.faults.line_faults import servers_of
from scanbench.plcmodel import model as plc
from scanbench.plcmodel.facts import share
from scanbench.plcmodel.hardware import Fitted
from scanbench.plcmodel.read_hardware import ranges
from scanbench.problems import Problem
from scanbench.program.sites import CheckSite
from scanbench.public import iso
from scanbench.session.session import Session
from scanbench.store.records import FileInfo, FileRow, ProjectRow
from scanbench.symbols.violations import Calling, Violation, Violations
from scanbench.web import messages as wire
from scanbench.web import messages_debug as debugger
from scanbench.web import messages_diagnostics as diagnosed
from scanbench.web import messages_errors as simulator
from scanbench.web import (
    messages_models,
    messages_values,
    translate_debug,
    translate_errors,
    translate_sweeps,
    translate_verify,
)
from scanbench.web.messages_projects import OnlineChange
from scanbench.web.messages_watch import WatchListChanged
from scanbench.wire import events
from scanbench.wire.events import BuildOutcome, Change, CheckOutcome, User
from scanbench.wire.host import PlcState
from scanbench.wire.symbols import WatchItem


def user(who: User) -> wire.User:
    """A user with initials."""
    return wire.User(name=who.name, initials=who.initials, client=who.client)


def project(row: ProjectRow) -> wire.Project:
    """A project."""
    return wire.Project(id=row.id, name=row.name, model=row.model, version=row.version, watch=list(row.watch))


def file_info(row: FileInfo | FileRow) -> wire.FileInfo:
    """A file without its text."""
    return wire.FileInfo(path=row.path, version=row.version, author=row.author, saved=iso(row.saved))


def file_text(row: FileRow) -> wire.FileText:
    """A file with its text."""
    return wire.FileText(path=row.path, version=row.version, author=row.author, saved=iso(row.saved), text=row.text)


def problem(found: Problem) -> wire.Problem:
    """A problem with its place."""
    span = found.span
    return wire.Problem(
        code=found.code, severity=found.severity.value, message=found.message, file=span.file, line=span.line,
        column=span.column, end_line=span.end_line, end_column=span.end_column,
    )  # fmt: skip


def check_result(found: CheckOutcome) -> wire.CheckResult:
    """Problems and declarations."""
    return wire.CheckResult(
        problems=list(map(problem, found.problems)),
        pous=found.pous,
        checks=list(map(embedded_check, found.checks)),
        numbers=found.numbers,
        tasks=found.tasks,
    )  # fmt: skip


def embedded_check(site: CheckSite) -> wire.EmbeddedCheck:
    """A subrange check with its place."""
    span = site.span
    return wire.EmbeddedCheck(
        file=span.file, line=span.line, column=span.column, end_line=span.end_line, end_column=span.end_column,
        variable=site.variable, low=str(site.low), high=str(site.high), needless=site.needless,
    )  # fmt: skip


def build_result(outcome: BuildOutcome) -> wire.BuildResult:
    """What became of a build."""
    return wire.BuildResult(
        ok=outcome.ok,
        message=outcome.message,
        problems=list(map(problem, outcome.found.problems)),
        project=project(outcome.project),
        pous=outcome.found.pous,
        changes=list(map(_change, outcome.changes)),
        needs_agreement=outcome.needs_agreement,
    )  # fmt: skip


def _change(change: Change) -> OnlineChange:
    found, counted = change.previewed, change.previewed.counted
    return OnlineChange(
        instance=change.instance, name=change.name, kept=counted.kept, reinitialized=counted.reinitialised, new=counted.new, removed=counted.removed,
        lost=found.lost, lost_count=found.lost_count, refusal=found.refusal,
    )  # fmt: skip


def state(now: PlcState) -> wire.InstanceState:
    """The state of a PLC."""
    trap = now.trap
    return wire.InstanceState.model_validate(
        {
            "state": now.state, "mode": now.mode, "message": now.message, "scan": now.scan, "time_ns": now.time_ns,
            "interval_ns": now.interval_ns, "cycle_us": now.cycle_us, "speed": now.speed, "pid": now.pid,
            "restarts": now.restarts, "forces": now.forces, "program_version": now.version,
            "past": {"live_scan": now.live_scan, "by": now.past_by} if now.past_by else None,
            "previous_version": now.previous_version,
            "target": now.target, "late_percent": round(now.late_percent, 2),
            "late_us": now.late_us, "worst_us": now.worst_us,
            "halt": translate_debug.halt(now.halt), "flavour": now.flavour, "startable": now.startable,
            "trap": None if trap is None else {
                "kind": trap.kind, "message": trap.message, "file": trap.file, "line": trap.line,
                "column": trap.column, "scan": trap.scan,
            },
        }
    )  # fmt: skip


def instance(session: Session, row: ProjectRow) -> wire.Instance:
    """An instance."""
    load, limits = session.load, session.row.limits
    return wire.Instance(
        id=session.id, name=session.name, project=project(row), model=session.model.name, state=state(session.state),
        load=wire.InstanceLoad(
            cpu_percent=round(load.cpu_percent, 1), memory_bytes=load.memory_bytes, run_bytes=session.log.timeline.info.bytes
        ),
        limits=wire.InstanceLimits(
            memory_mib=limits.memory_mib, cpu_percent=limits.cpu_percent, run_mib=limits.run_mib
        ),
        users=list(map(user, session.users)),
    )  # fmt: skip


def watched(item: WatchItem) -> wire.Watched:
    """One watched path."""
    refusal = None if item.symbol is not None else wire.Refusal(message=item.message, near=list(item.near))
    return wire.Watched(
        path=item.path,
        id=item.id if item.sent else None,
        symbol=item.symbol,
        refusal=refusal,
    )


def error_row(row: ErrorRow) -> simulator.ErrorHistoryRow:
    """A row of the error history."""
    return simulator.ErrorHistoryRow(
        id=row.id, instance=row.instance, fitted=row.fitted, label=row.label, name=row.name, severity=row.severity, status=row.status, code=row.code, details=row.details,
        generated_at=None if row.generated_at is None else iso(row.generated_at),
        recovered_at=None if row.recovered_at is None else iso(row.recovered_at),
        generated_scan=row.generated_scan, recovered_scan=row.recovered_scan,
        recovered_by=row.recovered_by, recovered_way=row.recovered_way, acknowledged=_acknowledged(row), by=row.by, origin=row.origin,
        count=row.count, reaction=translate_errors.in_short(row.reaction), swept=translate_errors.swept(row.swept),
    )  # fmt: skip


def _acknowledged(row: ErrorRow) -> simulator.ErrorAcknowledged | None:
    found = row.acknowledged
    if found is None:
        return None
    return simulator.ErrorAcknowledged(by=found.by, at=iso(found.at), scan=found.scan, remark=found.remark)


def diagnostics(found: Violations) -> diagnosed.Diagnostics:
    """The runtime diagnostics."""
    return diagnosed.Diagnostics(
        violations=list(map(_violation, found.entries)), dropped=found.dropped, count=found.count
    )


def _violation(found: Violation) -> diagnosed.Violation:
    span = found.span
    return diagnosed.Violation(
        file=span.file, line=span.line, column=span.column, end_line=span.end_line, end_column=span.end_column,
        pou=found.pou, instance=found.instance, variable=found.variable, target=found.target, value=str(found.value), low=str(found.low),
        high=str(found.high), text=str(found), times=found.times, first_scan=found.first_scan,
        last_scan=found.last_scan, beyond=found.beyond, calls=list(map(_calling, found.calls)), cut=found.cut,
    )  # fmt: skip


def _calling(found: Calling) -> diagnosed.Calling:
    span = found.span
    return diagnosed.Calling(
        pou=found.pou, instance=found.instance, method=found.method, file=span.file, line=span.line, column=span.column
    )


def event(happened: events.Told) -> wire.ServerMessage:
    """What a session tells, as a message."""
    match happened:
        case (
            events.ProgramBuilt() | events.FileSaved() | events.SweepChanged() | events.WatchListChanged()
        ):  # fmt: skip
            return _of_project(happened)
        case events.BreakpointsChanged():
            return debugger.Breakpoints(breakpoints=list(map(translate_debug.breakpoint, happened.verdicts)))
        case events.VerificationsChanged():
            return translate_verify.told(happened)
        case events.StateChanged():
            return wire.State(state=state(happened.state))
        case events.ErrorsChanged():
            return wire.Errors(rows=list(map(error_row, happened.rows)), whole=happened.whole)
        case events.UsersChanged():
            return wire.Users(users=list(map(user, happened.users)))
        case events.DiagnosticsChanged():
            return diagnostics(happened.violations)
        case events.Watching():
            return wire.Watching(ref=happened.ref, items=list(map(watched, happened.items)))
        case _:
            return happened


def _of_project(
    happened: events.ProgramBuilt | events.FileSaved | events.SweepChanged | events.WatchListChanged,
) -> wire.ServerMessage:
    match happened:
        case events.ProgramBuilt():
            return wire.Built(author=happened.author, result=build_result(happened.outcome))
        case events.FileSaved():
            saved = iso(happened.saved)
            file = wire.FileInfo(path=happened.path, version=happened.version, author=happened.author, saved=saved)
            return wire.Saved(author=happened.author, file=file)
        case events.SweepChanged():
            return translate_sweeps.progress(happened)
        case events.WatchListChanged():
            return WatchListChanged(id=happened.id, version=happened.version, author=happened.author)


# ---- models ------------------------------------------------------------------------------------------------------


def model_summary(model: plc.Model) -> messages_models.ModelSummary:
    """A model in a list."""
    verified, facts = share(model.facts)
    return messages_models.ModelSummary(
        name=model.name, vendor=model.vendor, description=model.description, error_count=len(list(model.errors())),
        verified_count=sum(error.verified for error in model.errors()), fact_count=facts, verified_facts=verified,
    )  # fmt: skip


def model_info(model: plc.Model) -> messages_models.ModelInfo:
    """A model with its memory and its errors."""
    word = model.code_word
    return messages_models.ModelInfo(
        **model_summary(model).model_dump(),
        areas=[_area(model, area, part) for area in model.areas if not area.texts for part in area.ranges],
        code_word=None if word is None else model.format(word.area, word.byte, word.bit, word.bits),
        code_words=[]
        if word is None
        else [model.format(word.area, word.byte + at, None, 16) for at in range(0, word.bits // 8, 2)],
        servers=servers_of(model),
        status_words=list(model.status_words),
        hardware=model.fitted is not None,
        fits=[
            messages_models.HardwareKind(kind=kind, lowest=low, highest=high)
            for kind, (low, high) in ranges(model).items()
        ],
        catalogue=translate_errors.groups(model.catalogue, translate_errors.facts_by_error(model)),
    )


def channel_unit(fitted: Fitted) -> messages_values.ChannelUnit:
    """The unit that words of inputs and outputs lead to."""
    return messages_values.ChannelUnit(
        kind=fitted.kind, number=fitted.number, rack=fitted.rack, slot=fitted.slot, name=fitted.name
    )


def _area(model: plc.Model, area: plc.Area, part: plc.AccessRange) -> messages_models.Area:
    """Areas whose words differ in access are shown in parts."""
    first, last = model.range_text(plc.WordRange(area, part.first, part.last))
    return messages_models.Area(
        name=area.name,
        description=area.description,
        words=part.last - part.first + 1,
        retain=area.retain,
        first=first,
        last=last,
        program=part.program,
        tool=part.tool,
        engine=part.engine,
    )
