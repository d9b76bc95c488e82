"""Wire shapes of histories by version and of test records. See `messages.py`."""

from typing import Literal

from pydantic import Field

from scanbench.web.messages_base import Wire
from scanbench.web.messages_errors import Accepted, ErrorHistoryRow, Reaction, Severity, SweepStatus, Verdict


class HistoryVersion(Wire):
    """A version of the program that has an error history on a PLC."""

    version: int
    running: bool
    raised: int = Field(description="errors that were raised on it")
    at: str | None = Field(description="when it was built; null where the project does not know it")
    author: str


class HistoryOfVersion(Wire):
    """The error history of one version, in the order of the catalogue."""

    version: int
    running: bool
    rows: list[ErrorHistoryRow]


class RecordAccepted(Accepted):
    state: str


class RecordError(Wire):
    """One error of the catalogue, as the record has it."""

    id: str
    name: str
    group: str = Field(description="from the top, with ` / ` between")
    code: str
    flag: str
    severity: Severity
    status: Literal["never", "generated", "cleared"]
    details: str
    generated_at: str | None
    recovered_at: str | None
    generated_scan: int | None
    recovered_scan: int | None
    by: str
    origin: Literal["simulator", "plc", "program"] | None
    count: int
    verdict: Verdict | None = Field(description="of the PLC itself, else of sweeps")
    verdict_from: Literal["plc", "sweep", ""]
    scans: int | None = Field(description="until the first effect, from 1")
    reaction: Reaction | None = Field(description="on the PLC itself; of its differences the outputs")
    reaction_note: str
    accepted: list[RecordAccepted]


class RecordSummary(Wire):
    errors: int
    tested: int
    generated: int = Field(description="still present")
    verdicts: dict[Verdict, int]
    unknown: int = Field(description="tested, without a verdict")
    accepted: int = Field(description="findings, one for each error and state, that were accepted")
    open: int = Field(description="findings that were not")


class RecordCell(Wire):
    error: str
    state: str
    verdict: Verdict | None
    scans: int | None
    note: str


class RecordSweep(Wire):
    at: str
    by: str
    instance: str
    status: SweepStatus
    window: int
    states: list[str]
    cells: list[RecordCell]


class RecordLine(Wire):
    at: str
    scan: int
    by: str
    text: str


class TestRecord(Wire):
    """What one version of a program was tested against on one PLC."""

    project: str
    model: str
    instance: str
    program_version: int
    program_hash: str
    exported_at: str
    exported_by: str
    tool: str
    summary: RecordSummary
    errors: list[RecordError]
    sweeps: list[RecordSweep]
    log: list[RecordLine]


class RecordInfo(Wire):
    """A test record that was brought into a project."""

    id: int
    project: int
    title: str
    by: str = Field(description="who brought it in")
    at: str


class ImportedRecord(Wire):
    info: RecordInfo
    record: TestRecord
