"""Which fields of which shapes hold a sentence of Scanbench: these alone are said in the language of the reader.

An object is known by all of its keys together. Whatever is not listed belongs to users, or to a model file, and passes as it is: texts of files, names,
comments, labels, messages of versions and commits, descriptions, values.
"""

from collections.abc import Iterator
from dataclasses import fields
from typing import TYPE_CHECKING

from scanbench.debug.bound_to import Bound, BoundTo
from scanbench.faults.arm import ArmedInfo
from scanbench.faults.disturb.disturb import DisturbanceInfo
from scanbench.faults.reaction.reaction import Reaction, RequiredResult
from scanbench.history.campaign.contract import Trial
from scanbench.history.contract import BetweenEntry, Changes, Divergence, NotCompared
from scanbench.history.whatif.contract import Try, WhatIf
from scanbench.recording.recording import RecordingInfo
from scanbench.reports.record import RecordCell
from scanbench.reports.record_text import RecordLine
from scanbench.runtime.migrate_image import Lost
from scanbench.server.communication_shapes import CommunicationSeen, PlantSeen, ServerSeen
from scanbench.verify.contract import Mismatch, Row
from scanbench.verify.trace.table import TraceProblem
from scanbench.web import (
    messages,
    messages_debug,
    messages_diagnostics,
    messages_errors,
    messages_projects,
    messages_records,
    messages_user_errors,
    messages_verify,
    messages_watch,
)
from scanbench.web.messages_base import Wire
from scanbench.wire import events
from scanbench.wire.campaigns import CampaignState
from scanbench.wire.comparisons import Comparison, Rerun
from scanbench.wire.host import PreviewedErrors, RunMark
from scanbench.wire.traces import TraceStatus

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

WIRE: tuple[tuple[type[Wire], str], ...] = (
    (messages.Problem, "message"),
    (messages.SaveConflict, "message"),
    (messages.EmbeddedCheck, "needless"),
    (messages_projects.OnlineChange, "refusal"),
    (messages.BuildResult, "message"),
    (messages.TrapInfo, "message"),
    (messages.InstanceState, "message"),
    (messages.ImportedInstance, "damage"),
    (messages_diagnostics.Violation, "text"),
    (messages.Refusal, "message"),
    (messages.Done, "message"),
    (messages_debug.HaltInfo, "text"),
    (messages_debug.BreakpointInfo, "message"),
    (messages_errors.ReactionState, "message"),
    (messages_errors.CommandResult, "message"),
    (messages_errors.SweepSummary, "message"),
    (messages_errors.Sweep, "message"),
    (messages_errors.SweepCell, "note"),
    (messages_errors.SweepProgress, "now"),
    (messages_records.RecordError, "reaction_note"),
    (messages_user_errors.UserProblem, "message"),
    (messages_verify.UploadedTrace, "layout"),
    (messages_verify.UploadedTrace, "left_out"),
    (messages_projects.ExchangeFile, "left_out"),
    (messages_projects.ProjectArchive, "notes"),
    (messages_verify.VerificationInfo, "message"),
    (messages_watch.WatchListConflict, "message"),
)
PUBLIC: "tuple[tuple[type[DataclassInstance], str], ...]" = (
    (ArmedInfo, "text"),
    (BetweenEntry, "text"),
    (Bound, "message"),
    (BoundTo, "message"),
    (Changes, "note"),
    (DisturbanceInfo, "text"),
    (DisturbanceInfo, "why"),
    (Divergence, "text"),
    (Lost, "reason"),
    (Mismatch, "message"),
    (NotCompared, "reason"),
    (PlantSeen, "trouble"),
    (PreviewedErrors, "message"),
    (Reaction, "note"),
    (RequiredResult, "note"),
    (RecordCell, "note"),
    (RecordLine, "text"),
    (RecordingInfo, "damage"),
    (Row, "note"),
    (ServerSeen, "trouble"),
    (RunMark, "text"),
    (TraceProblem, "message"),
    (TraceStatus, "note"),
    (Trial, "text"),
    (Trial, "verification"),
    (Trial, "program"),
    (Trial, "refused"),
    (Trial, "why"),
    (WhatIf, "note"),
    (Try, "refused"),
    (Try, "trapped"),
    (CampaignState, "message"),
    (CommunicationSeen, "map_trouble"),
    (Comparison, "message"),
    (events.LogEntry, "text"),
    (Rerun, "message"),
    (Rerun, "refused"),
    (events.RetrospectiveChanged, "message"),
)


def _listed() -> Iterator[tuple[frozenset[str], str]]:
    for shape, name in WIRE:
        yield frozenset(shape.model_fields), name
    for public, name in PUBLIC:
        yield frozenset(each.name for each in fields(public)), name


def _by_keys() -> dict[frozenset[str], frozenset[str]]:
    found: dict[frozenset[str], frozenset[str]] = {}
    for keys, name in _listed():
        found[keys] = found.get(keys, frozenset()) | {name}
    return found


SHAPES = _by_keys()
DAP = frozenset({"type", "message"})
"""The keys of a message that carries one of the debugger's: it has rules of its own."""
