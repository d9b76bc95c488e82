"""A test record as XML (`record.xsd`), for archives and other tools; `record_read.py` reads it again."""

from collections.abc import Set
from datetime import UTC, datetime

from lxml import etree

from scanbench.faults.reaction.reaction import FINDINGS, Reaction, RequiredResult
from scanbench.plcmodel.document import xml_text
from scanbench.reports.record import RecordError, RecordSweep, TestRecord

VERSION = "5"
READ = ("1", "2", "3", "4", "5")
"""The versions that `record_read.py` reads."""
Told = str | int | datetime | None


def to_xml(record: TestRecord) -> str:
    """The record, whole; characters that XML cannot hold become U+FFFD."""
    head = record.head
    root = etree.Element("TestRecord")
    _set(
        root, Version=VERSION, Project=head.project, Model=head.model, Instance=head.instance,
        ProgramVersion=head.program_version, ProgramHash=head.program_hash, ExportedAt=head.exported_at,
        ExportedBy=head.exported_by, Tool=head.tool,
    )  # fmt: skip
    for error in record.errors:
        _error(root, error)
    accepted = {(each.error.id, each.state) for each in record.missed if each.accepted is not None}
    for sweep in record.sweeps:
        _sweep(root, sweep, accepted)
    for line in record.log:
        _add(root, "Line", At=line.at, Scan=line.scan, By=line.by, Text=line.text)
    etree.indent(root)
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True).decode() + "\n"


def _error(root: etree._Element, error: RecordError) -> None:
    node = _add(
        root, "Error", Id=error.id, Name=error.name, Group=error.group, Code=error.code, Flag=error.flag,
        Severity=error.severity, Status=error.status, Details=error.details or None,
        DetailsText=error.details_text or None, GeneratedAt=error.generated_at,
        RecoveredAt=error.recovered_at, GeneratedScan=error.generated_scan, RecoveredScan=error.recovered_scan,
        By=error.by or None, Origin=error.origin, Count=error.count or None,
        ReactionNote=error.reaction_note or None,
    )  # fmt: skip
    if error.reaction is not None:
        _reaction(node, error.reaction)
    for one in error.accepted:
        _add(node, "Accepted", State=one.state, Reason=one.reason, By=one.by, At=one.at)


def _reaction(error: etree._Element, reaction: Reaction) -> None:
    node = _add(
        error, "Reaction", Verdict=reaction.verdict, Basis=reaction.basis or None, Window=reaction.window, FirstRead=reaction.first_read,
        FirstEffect=reaction.first_effect, Differences=reaction.difference_count, Recovery=reaction.recovery or None, Note=reaction.note or None,
    )  # fmt: skip
    for reader in reaction.readers:
        _add(
            node, "Reader", File=reader.file, Line=reader.line, Pou=reader.pou, What=reader.what, Scan=reader.scan
        )  # fmt: skip
    for each in reaction.differences:
        _add(node, "Output", Path=each.path, Without=each.without, Value=each.value, Scan=each.scan)
    for line in reaction.lines:
        _add(node, "Handler", File=line.file, Line=line.line)
    for state in reaction.carried:
        carried = _add(node, "Carried", Path=state.path, Scan=state.scan)
        for at in state.readers:
            _add(carried, "By", Place=at)
    for at in reaction.decided_by:
        _add(node, "DecidedBy", Place=at)
    for path in reaction.displayed:
        _add(node, "Displayed", Path=path)
    for one in reaction.unreached:
        missed = _add(node, "Unreached", File=one.file, Line=one.line, Why=one.why, Around=one.at or None)
        for path in one.paths:
            _add(missed, "On", Path=path)
    for rule in reaction.required:
        _required(node, rule)
    for restart in reaction.restarts:
        _add(node, "Restart", Path=restart.path, Scan=restart.scan, AllowedBy=restart.allowed_by or None)


def _required(parent: etree._Element, rule: RequiredResult) -> None:
    node = _add(
        parent, "Required", Text=rule.text, Line=rule.line, Outcome=rule.outcome, Recovery="true" if rule.recovery else None,
        Scan=rule.scan, Reason=rule.reason or None, Note=rule.note or None,
    )  # fmt: skip
    for value in rule.values:
        _add(node, "Value", Path=value.path, Value=value.value)


def _sweep(root: etree._Element, sweep: RecordSweep, accepted: Set[tuple[str, str]]) -> None:
    node = _add(
        root, "Sweep", At=sweep.at, By=sweep.by, Instance=sweep.instance, Status=sweep.status, Window=sweep.window
    )  # fmt: skip
    for state in sweep.states:
        _add(node, "State", Name=state)
    for cell in sweep.cells:
        missed = cell.verdict in FINDINGS and (cell.error, cell.state) in accepted
        one = _add(
            node, "Cell", Error=cell.error, State=cell.state, Verdict=cell.verdict, Scans=cell.scans,
            Required=cell.required or None, Unmet=cell.unmet or None, Note=cell.note or None, Accepted="true" if missed else None,
        )  # fmt: skip
        for rule in cell.untried:
            _required(one, rule)
    for problem in sweep.problems:
        _add(node, "Problem", Line=problem.line, Column=problem.column, Message=problem.message)


def _add(parent: etree._Element, tag: str, **told: Told) -> etree._Element:
    node = etree.SubElement(parent, tag)
    _set(node, **told)
    return node


def _set(node: etree._Element, **told: Told) -> None:
    for name, value in told.items():
        if value is not None:
            text = value.astimezone(UTC).isoformat() if isinstance(value, datetime) else str(value)
            node.set(name, xml_text(text))
