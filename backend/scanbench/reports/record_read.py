"""A test record from its XML. Whatever is wrong with the file is told with its place."""

import re
from collections.abc import Iterator
from datetime import UTC, datetime
from functools import cache
from importlib.resources import files
from itertools import chain
from typing import cast

from lxml import etree

from scanbench.faults.history import Status
from scanbench.faults.present import Origin
from scanbench.faults.reaction.reaction import (
    Basis,
    Carried,
    Difference,
    Line,
    Obstacle,
    Outcome,
    OutputRestart,
    Reaction,
    Reader,
    RequiredResult,
    Unchecked,
    Unreached,
    ValueThen,
    Verdict,
    What,
)
from scanbench.plcmodel.document import Document, first_of, parse
from scanbench.plcmodel.model import Severity
from scanbench.problems import Problem, Span
from scanbench.reports.record import (
    RecordAccepted,
    RecordCell,
    RecordError,
    RecordHead,
    RecordProblem,
    RecordSweep,
    SweepStatus,
    TestRecord,
)
from scanbench.reports.record_text import RecordLine
from scanbench.reports.record_xml import READ

FILE = "record.xml"
_BEGINNING = 10_000
"""Characters among which the version is."""
_ROOT = re.compile(r"<TestRecord\s[^>]*?\bVersion=[\"'](\d{1,9})[\"']")


def from_xml(text: str, file: str = FILE) -> TestRecord | list[Problem]:
    """The record, or everything that is wrong with the text."""
    document = parse(text, file, _schema(), "TestRecord", "a test record")
    if not isinstance(document, Document):
        return _of_another_version(text, file) or document
    root = document.root
    if wrong := first_of(chain(_bad_moments(document), _bad_cells(document))):
        return wrong
    head = RecordHead(
        project=_text(root, "Project"), model=_text(root, "Model"), instance=_text(root, "Instance"),
        program_version=int(_text(root, "ProgramVersion")), program_hash=_text(root, "ProgramHash"),
        exported_at=datetime.fromisoformat(_text(root, "ExportedAt")), exported_by=_text(root, "ExportedBy"),
        tool=_text(root, "Tool"),
    )  # fmt: skip
    return TestRecord(
        head,
        tuple(map(_error, root.findall("Error"))),
        tuple(map(_sweep, root.findall("Sweep"))),
        tuple(
            RecordLine(
                datetime.fromisoformat(_text(node, "At")), _count(node, "Scan"), _text(node, "By"), _text(node, "Text")
            )
            for node in root.findall("Line")
        ),
    )


def _of_another_version(text: str, file: str) -> list[Problem]:
    """All else that is wrong with it is so for this version only."""
    match = _ROOT.search(text, 0, _BEGINNING)
    if match is None or match[1] in READ:
        return []
    line, column = text.count("\n", 0, match.start(1)) + 1, match.start(1) - text.rfind("\n", 0, match.start(1))
    message = (
        f"this is a test record of Version {match[1]}, and this Scanbench reads Version {', '.join(READ[:-1])} and {READ[-1]}: "
        "bring it in with the version that wrote it"
    )
    return [Problem("M002", message, Span(file, line, column, line, column + len(match[1])))]


def _bad_moments(document: Document) -> Iterator[Problem]:
    """The schema's moments know more days than there are."""
    for node in document.root.iter():
        for name in ("At", "ExportedAt", "GeneratedAt", "RecoveredAt"):
            value = node.get(name)
            if value is None:
                continue
            try:
                datetime.fromisoformat(value).astimezone(UTC)
            except (ValueError, OverflowError) as error:
                yield Problem("M002", f"{name} {value!r} is no moment: {error}", document.span(node, name))


def _bad_cells(document: Document) -> Iterator[Problem]:
    errors = {node.get("Id") for node in document.root.findall("Error")}
    for sweep in document.root.findall("Sweep"):
        states, told = {node.get("Name") for node in sweep.findall("State")}, set()
        for cell in sweep.findall("Cell"):
            error, state = cell.get("Error"), cell.get("State")
            if error not in errors:
                message = f"there is no Error with the Id {error!r} in this record"
                yield Problem("M002", message, document.span(cell, "Error"))
            if state not in states:
                message = f"this Sweep has no State with the Name {state!r}"
                yield Problem("M002", message, document.span(cell, "State"))
            if (error, state) in told:
                message = f"this Sweep has two Cells for {error} from {state!r}: one error has one Cell for each State"
                yield Problem("M002", message, document.span(cell))
            told.add((error, state))


def _error(node: etree._Element) -> RecordError:
    reaction = node.find("Reaction")
    return RecordError(
        id=_text(node, "Id"), name=_text(node, "Name"), group=_text(node, "Group"), code=_text(node, "Code"),
        flag=_text(node, "Flag"), severity=cast(Severity, _text(node, "Severity")),
        status=cast(Status, _text(node, "Status")), details=_text(node, "Details"),
        generated_at=_moment(node, "GeneratedAt"), recovered_at=_moment(node, "RecoveredAt"),
        generated_scan=_number(node, "GeneratedScan"), recovered_scan=_number(node, "RecoveredScan"),
        by=_text(node, "By"), origin=cast(Origin | None, node.get("Origin")), count=_count(node, "Count"),
        reaction=None if reaction is None else _reaction(reaction), reaction_note=_text(node, "ReactionNote"),
        accepted=tuple(
            RecordAccepted(
                _text(one, "State"), _text(one, "Reason"), _text(one, "By"), datetime.fromisoformat(_text(one, "At"))
            )
            for one in node.findall("Accepted")
        ),
        details_text=_text(node, "DetailsText"),
    )  # fmt: skip


def _reaction(node: etree._Element) -> Reaction:
    return Reaction(
        verdict=cast(Verdict, _text(node, "Verdict")), window=_count(node, "Window"),
        first_read=_number(node, "FirstRead"), first_effect=_number(node, "FirstEffect"),
        readers=tuple(
            Reader(
                _text(one, "File"), _count(one, "Line"), _text(one, "Pou"), cast(What, _text(one, "What")),
                _count(one, "Scan"),
            )
            for one in node.findall("Reader")
        ),
        differences=tuple(
            Difference(_text(one, "Path"), _text(one, "Without"), _text(one, "Value"), True, _count(one, "Scan"))
            for one in node.findall("Output")
        ),
        difference_count=_count(node, "Differences"),
        lines=tuple(Line(_text(one, "File"), _count(one, "Line")) for one in node.findall("Handler")),
        note=_text(node, "Note"),
        basis=cast(Basis, _text(node, "Basis")),
        carried=tuple(
            Carried(_text(one, "Path"), _count(one, "Scan"), tuple(_text(by, "Place") for by in one.findall("By")))
            for one in node.findall("Carried")
        ),
        decided_by=tuple(_text(one, "Place") for one in node.findall("DecidedBy")),
        displayed=tuple(_text(one, "Path") for one in node.findall("Displayed")),
        unreached=tuple(
            Unreached(
                _text(one, "File"), _count(one, "Line"), tuple(_text(on, "Path") for on in one.findall("On")),
                cast(Obstacle, _text(one, "Why")), _text(one, "Around"),
            )
            for one in node.findall("Unreached")
        ),
        required=tuple(map(_required, node.findall("Required"))),
        restarts=tuple(
            OutputRestart(_text(one, "Path"), _count(one, "Scan"), _text(one, "AllowedBy")) for one in node.findall("Restart")
        ),
        recovery=_count(node, "Recovery"),
    )  # fmt: skip


def _required(node: etree._Element) -> RequiredResult:
    return RequiredResult(
        _text(node, "Text"), _count(node, "Line"), cast(Outcome, _text(node, "Outcome")),
        recovery=node.get("Recovery") in ("true", "1"), scan=_number(node, "Scan"),
        values=tuple(ValueThen(_text(one, "Path"), _text(one, "Value")) for one in node.findall("Value")),
        reason=cast(Unchecked, _text(node, "Reason")), note=_text(node, "Note"),
    )  # fmt: skip


def _sweep(node: etree._Element) -> RecordSweep:
    return RecordSweep(
        at=datetime.fromisoformat(_text(node, "At")), by=_text(node, "By"), instance=_text(node, "Instance"),
        status=cast(SweepStatus, _text(node, "Status")), window=_count(node, "Window"),
        states=tuple(_text(one, "Name") for one in node.findall("State")),
        cells=tuple(
            RecordCell(
                _text(one, "Error"), _text(one, "State"), cast(Verdict | None, one.get("Verdict")),
                _number(one, "Scans"), _text(one, "Note"), _count(one, "Required"), _count(one, "Unmet"),
                tuple(map(_required, one.findall("Required"))),
            )
            for one in node.findall("Cell")
        ),
        problems=tuple(
            RecordProblem(_count(one, "Line"), _count(one, "Column"), _text(one, "Message")) for one in node.findall("Problem")
        ),
    )  # fmt: skip


def _text(node: etree._Element, name: str) -> str:
    return node.get(name, "")


def _number(node: etree._Element, name: str) -> int | None:
    value = node.get(name)
    return None if value is None else int(value)


def _count(node: etree._Element, name: str) -> int:
    return _number(node, name) or 0


def _moment(node: etree._Element, name: str) -> datetime | None:
    value = node.get(name)
    return None if value is None else datetime.fromisoformat(value)


@cache
def _schema() -> etree.XMLSchema:
    text = files("scanbench.faults").joinpath("record.xsd").read_bytes()
    return etree.XMLSchema(etree.fromstring(text, etree.XMLParser(resolve_entities=False, no_network=True)))
