"""Wire shapes of histories by version and of test records. See `messages.py`."""

from typing import Literal

from pydantic import Field

from scanbench.faults.reaction.reaction import Reaction, Verdict
from scanbench.reports.record import RecordAccepted, RecordSweep, Summary
from scanbench.reports.record_text import RecordLine
from scanbench.store.records import RecordInfo
from scanbench.web.messages_base import Wire
from scanbench.web.messages_errors import ErrorHistoryRow, Severity


class HistoryOfVersion(Wire):
    """The error history of one version, in the order of the catalogue."""

    version: int
    running: bool
    rows: list[ErrorHistoryRow]


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
    unmet: int = Field(default=0, description="so much is not as it is required, unexpected restarts counted")
    reaction: Reaction | None = Field(description="on the PLC itself; of its differences the outputs")
    reaction_note: str
    accepted: tuple[RecordAccepted, ...]


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
    summary: Summary
    errors: list[RecordError]
    sweeps: tuple[RecordSweep, ...]
    log: tuple[RecordLine, ...]


class ImportedRecord(Wire):
    info: RecordInfo
    record: TestRecord
