"""Frozen dataclasses as msgpack, length first: the language between the parent and its hosts.

Only the classes listed here can be read, so that a message never makes anything but plain data.
"""

import struct
from collections.abc import Callable, Iterator
from dataclasses import fields

import msgpack  # type: ignore[import-untyped]

from scanbench.check.pou_infos import PouInfo
from scanbench.check.task_infos import TaskInfo, TaskProgram
from scanbench.debug.assign import Assign
from scanbench.debug.bound_to import Bound, BoundTo
from scanbench.debug.breakpoint import Breakpoint, Verdict
from scanbench.debug.flow_shown import Flow, FlowAsked, FlowElement, Flows, FlowValue, FlowWire
from scanbench.debug.halt import Halt, Left
from scanbench.debug.set_value import SetLocal
from scanbench.faults.absent import GenerateAbsent
from scanbench.faults.acknowledge import Acknowledge, Remark
from scanbench.faults.arm import ARMED, NUMBERED, Arm, ArmedInfo, Disarm, Missed
from scanbench.faults.clear import ClearErrorLog, ClearErrors
from scanbench.faults.device_shapes import (
    DeviceDetail,
    DeviceError,
    DeviceErrors,
    DeviceMessage,
    DeviceRecord,
    DeviceStandby,
)
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import DISTURBED, Calm, Disturb, DisturbanceInfo
from scanbench.faults.disturb.fire import Corrupt, Flip, Hold, Unfired, Unhold
from scanbench.faults.inject import INSTANCES, Generate, Recover
from scanbench.faults.line_faults import BROKEN_LINES, BreakLine, BrokenLine, LineFault, LineStep, MendLine
from scanbench.faults.network import WAITING, NetworkAnswer, NetworkRequest, PortsReady
from scanbench.faults.present import Active, Raised
from scanbench.faults.preview import PreviewedWrite
from scanbench.faults.raised_numbers import RaisedNumber
from scanbench.faults.reaction.reaction import (
    Carried,
    Difference,
    Line,
    OutputRestart,
    Reaction,
    Reader,
    RequiredResult,
    Unreached,
    ValueThen,
)
from scanbench.faults.reference import ErrorRef
from scanbench.faults.shapes import Shape, Wanted
from scanbench.faults.shapes import Start as FaultStart
from scanbench.history.campaign.contract import CampaignWanted, Trial
from scanbench.history.contract import BetweenEntry, Change, Changes, Divergence, NotCompared, RerunChange, Writer
from scanbench.history.whatif.contract import SetValue, Try, WhatIf, WhatIfWanted
from scanbench.problems import Problem, Span
from scanbench.program.sites import CheckSite
from scanbench.recording.gaps import LostScans
from scanbench.recording.recording import RecordingInfo
from scanbench.runtime.clear_violations import ClearViolations
from scanbench.runtime.command import Entry, Freed, Held, Numbered, Patch, Plan, Restarted, Swapped
from scanbench.runtime.copy_areas import CopyAreas
from scanbench.runtime.counted_variables import Counted
from scanbench.runtime.forces import FORCED, Force, ForcedValue, ForceSeveral, Release
from scanbench.runtime.holds import HELD
from scanbench.runtime.migrate_image import Lost
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.restart import Restart
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.trap import TRAPPED, TrapInfo, Trapped
from scanbench.runtime.write import Write
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.runtime.write_variables import VariableWrite, WriteVariables
from scanbench.symbols.violations import Calling, Violation, Violations
from scanbench.taps.covered import CoveredFile, CoveredOutcome, CoveredSite
from scanbench.taps.trace import TraceDefinition, TraceSignal, TraceTrigger
from scanbench.typed import check
from scanbench.verify.contract import (
    Column,
    Compared,
    Input,
    Mismatch,
    Output,
    Place,
    Range,
    Row,
    VerifyCoverage,
    VerifyFlows,
)
from scanbench.verify.trace.growing import Sample
from scanbench.wire import campaigns as campaign_protocol
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import events, memory, opcua, symbols, variables, verifying
from scanbench.wire import host as protocol
from scanbench.wire import jobs as job_protocol
from scanbench.wire import traces as trace_protocol
from scanbench.wire import verification as verify_protocol
from scanbench.wire import whatif as whatif_protocol
from scanbench.wire.comparisons import Comparison

LENGTH = struct.Struct("<I")
LARGEST = 1 << 30
"""Bytes of a message. Who says that more are coming does not speak this protocol, and the link to it ends."""
_OBJECT = 1
_LARGEST_NUMBER = 1 << 63
_DEEPEST = 64
_Read = Callable[[int, bytes], object]

_CLASSES: dict[str, type] = {
    cls.__name__: cls
    for cls in (
        Active, ClearErrorLog, ClearErrors, ClearViolations, Entry, Force, Generate, Patch, Plan, ErrorRef, ProgramChange, Recover, Release, SetMode, Span, TrapInfo, Trapped,
        Calling, Violation, Violations, Write,
        Counted, Lost, LostScans, RecordingInfo, Restart, Restarted, SetClock, Swapped,
        protocol.Ack, protocol.Attend, protocol.Build, protocol.Copy, protocol.Diagnosed, protocol.Drive, protocol.Driven,
        protocol.Entered, protocol.Found, protocol.Frame, protocol.PlcState, protocol.Lookup, protocol.Preview,
        protocol.Ping, protocol.Pong, protocol.Previewed, protocol.Quit, protocol.Ready, protocol.NowRuns, protocol.RollBack, protocol.RunMark, protocol.RunMarks,
        protocol.SetLimits, protocol.Sources, protocol.InEffect, protocol.Start, protocol.StartFailed,
        protocol.Submit, symbols.SymbolInfo, protocol.Travel, protocol.UnwatchIds, protocol.WantSnapshot,
        symbols.WatchItem, memory.WantWords, memory.WantPlace, memory.PlaceIs, memory.WordInfo, memory.WordsAre, memory.FindWords, memory.WordsFound, memory.AreaSpan, memory.ReadAreas, memory.AreasAre, variables.ReadVariables, variables.VariablesAre, variables.DescribeVariables, variables.VariablesDescribed, AreaWrite, WriteAreas, CopyAreas, VariableWrite, WriteVariables, NetworkRequest, NetworkAnswer, PortsReady, LineFault, BreakLine, LineStep, MendLine, BrokenLine, Acknowledge, Remark, protocol.WatchPaths, protocol.Watching, protocol.WantSources, protocol.SourcesOf,
        Arm, ArmedInfo, Disarm, Missed, Numbered, PreviewedWrite, Shape, Wanted, protocol.PreviewErrors,
        protocol.PreviewedErrors, protocol.ErrorsPreviewed, symbols.EnumValue, Carried, Difference, Line, Reaction, Reader, RequiredResult, OutputRestart, Unreached, ValueThen, job_protocol.SweepPlanned,
        job_protocol.CellFound, job_protocol.FindReaction, job_protocol.JobDone, job_protocol.JobRefused, job_protocol.Check, job_protocol.Checked, job_protocol.KeepProgram,
        events.CheckOutcome, Problem, PouInfo, CheckSite, TaskInfo, TaskProgram, RaisedNumber, job_protocol.Reacted,
        job_protocol.RunSweep, job_protocol.StartPoint, job_protocol.Trying, Raised,
        DeviceDetail, DeviceError, DeviceErrors, DeviceMessage, DeviceRecord, DeviceStandby, protocol.DeviceIs, protocol.WantDevice,
        GenerateAbsent, ForcedValue, ForceSeveral, protocol.ForcesAre, protocol.WantForces, Breakpoint, Verdict, Halt, Left, Assign, SetLocal, debug_protocol.SetBreakpoints, debug_protocol.Step, debug_protocol.WantStack,
        debug_protocol.WantScopes, debug_protocol.WantVariables, debug_protocol.Evaluate, debug_protocol.SetExpression,
        debug_protocol.WantPlaces, debug_protocol.WantBinding, debug_protocol.SetCoverage, debug_protocol.WantCoverage,
        debug_protocol.BreakpointsAre, debug_protocol.LogpointSaid, debug_protocol.FrameInfo,
        debug_protocol.Stack, debug_protocol.WantTasks, debug_protocol.Tasks, debug_protocol.ScopeInfo, debug_protocol.Scopes, debug_protocol.VariableInfo,
        debug_protocol.Variables, debug_protocol.Evaluated, debug_protocol.PlaceInfo, debug_protocol.Places,
        Flow, FlowAsked, FlowElement, Flows, FlowValue, FlowWire, debug_protocol.FlowIs, debug_protocol.WantFlow,
        Bound, BoundTo, debug_protocol.BindingIs, CoveredOutcome, CoveredSite, CoveredFile,
        debug_protocol.Coverage, debug_protocol.CoverageIs,
        TraceDefinition, TraceSignal, TraceTrigger, trace_protocol.DefineTrace, trace_protocol.DriveTrace,
        trace_protocol.ReadTrace, trace_protocol.TraceStatus, trace_protocol.TracesAre, trace_protocol.TraceRead,
        trace_protocol.RecordRetrospective, trace_protocol.RetrospectiveAt, trace_protocol.RetrospectiveDone,
        Calm, Corrupt, Disturb, Disturbance, DisturbanceInfo, Flip, Freed, Held, Hold, Unfired, Unhold,
        Column, Compared, VerifyCoverage, Input, Mismatch, Output, Place, Range, Row, BetweenEntry, Change, Changes, Divergence, NotCompared, RerunChange, Writer, DisturbanceInfo,
        verify_protocol.BeginVerify, verify_protocol.BeginTrace, verify_protocol.BeginController, verify_protocol.TakeSamples, Sample, verify_protocol.VerifyScans, verify_protocol.VerifyStep,
        verify_protocol.SetInputs, verify_protocol.UsesOf, verify_protocol.VerifyBegun, verify_protocol.ScansDone,
        verify_protocol.PackedRow, verify_protocol.KeptRows, verify_protocol.ScansVerified, verify_protocol.UseRow, verify_protocol.UsesAre,
        VerifyFlows, verify_protocol.RowFlowsOf, verify_protocol.RowFlowsAre,
        verify_protocol.MakeScenario, verify_protocol.ScenarioMade, verify_protocol.FindWriter, verify_protocol.WriterFound, verify_protocol.FindChanges, verify_protocol.ChangesFound,
        verify_protocol.CompareRuns, verify_protocol.PastAt, verify_protocol.RunsCompared, verify_protocol.RerunRun,
        Comparison, WhatIfWanted, SetValue, Try, WhatIf, whatif_protocol.RunWhatIf, whatif_protocol.TryDone, whatif_protocol.WhatIfDone,
        CampaignWanted, Trial, campaign_protocol.RunCampaign, campaign_protocol.TrialDone, campaign_protocol.CampaignDone, campaign_protocol.CampaignCount, campaign_protocol.CampaignState,
        verify_protocol.RerunDone, verifying.VerificationStatus, verifying.VerifyWish,
        Disturb, Disturbance, Calm, Flip, Hold, Unhold, Corrupt, Unfired, Held, Freed,
        opcua.OpcUaStart, opcua.OpcUaProgram, opcua.RaisedError, opcua.OpcUaErrors, opcua.OpcUaFault, opcua.OpcUaReady, opcua.OpcUaFailed,
        opcua.OpcUaClient, opcua.OpcUaAsked, opcua.OpcUaSubmit, opcua.OpcUaDone,
    )
}  # fmt: skip
_CLASSES["FaultStart"] = FaultStart  # `protocol.Start` has the same name
_NAMES = {cls: name for name, cls in _CLASSES.items()}
_FIELDS = {name: tuple(field.name for field in fields(cls)) for name, cls in _CLASSES.items()}


class BadMessage(Exception):
    """Bytes that are no message."""


def pack(message: object) -> bytes:
    """A message with its length in front."""
    body = pack_body(message)
    return LENGTH.pack(len(body)) + body


def unpack(body: bytes, read: _Read | None = None) -> object:
    """The message in `body`, which comes without its length."""
    try:
        return msgpack.unpackb(body, ext_hook=read or _read, use_list=False, strict_map_key=False, timestamp=3)
    except (ValueError, TypeError, KeyError) as error:
        raise BadMessage(f"{len(body)} bytes that are no message: {error}") from error


def body_length(start: bytes | bytearray) -> int:
    """How many bytes of message follow on its length; `BadMessage` where nobody waits for so many."""
    length: int = LENGTH.unpack_from(start)[0]
    if length > LARGEST:
        raise BadMessage(f"a message of {length} bytes; the largest has {LARGEST}")
    return length


def unpack_kept(body: bytes) -> object:
    """The message that was kept in `body`, perhaps by a newer version: the fields that it knows besides, which are the last
    ones, are left alone, whatever they hold."""
    return unpack(body, _read_kept)


class Splitter:
    """Cuts a stream of bytes into messages."""

    def __init__(self) -> None:
        self._buffer = bytearray()

    def feed(self, data: bytes) -> Iterator[object]:
        """Takes the next bytes; the messages that are complete now."""
        self._buffer += data
        while len(self._buffer) >= LENGTH.size:
            end = LENGTH.size + body_length(self._buffer)
            if len(self._buffer) < end:
                return
            body = bytes(memoryview(self._buffer)[LENGTH.size : end])
            del self._buffer[:end]
            yield unpack(body)


class EntryCodec:
    """How a run file keeps journal entries."""

    folds = (FORCED, INSTANCES, TRAPPED, ARMED, NUMBERED, DISTURBED, HELD, WAITING, BROKEN_LINES)

    def pack(self, entry: Entry) -> bytes:
        """The bytes of an entry."""
        return pack_body(entry)

    def unpack(self, data: bytes) -> Entry:
        """The entry in these bytes; `BadMessage` when there is none."""
        entry = unpack(data, _read_entry)
        if not isinstance(entry, Entry):
            raise BadMessage(f"{type(entry).__name__} where a journal entry should be")
        return entry


ENTRIES = EntryCodec()


def pack_body(message: object) -> bytes:
    """A message without its length."""
    packed = msgpack.packb(message, default=_write, datetime=True)
    assert isinstance(packed, bytes)
    return packed


def _write(value: object) -> msgpack.ExtType:
    name = _NAMES.get(type(value))
    if name is None:
        raise TypeError(f"{type(value).__name__} is not in the protocol")
    return msgpack.ExtType(_OBJECT, pack_body([name, *(getattr(value, field) for field in _FIELDS[name])]))


def _reader(deeper: _Read, bounded: bool, kept: bool) -> _Read:
    split = _known_values if kept else _all_values

    def read(code: int, data: bytes) -> object:
        if code != _OBJECT:
            raise ValueError(f"unknown kind of value {code}")
        name, values = split(data, deeper)
        if bounded:
            for value in values:
                if isinstance(value, int) and not -_LARGEST_NUMBER <= value < _LARGEST_NUMBER:
                    raise ValueError(f"{value} is too large a number for anything in {name}")
        cls = _CLASSES[name]
        check(cls, values)
        return cls(*values)

    return read


def _all_values(data: bytes, deeper: _Read) -> tuple[str, list[object]]:
    """The name of a class, and the values of its fields."""
    name, *values = msgpack.unpackb(data, ext_hook=deeper, use_list=False, strict_map_key=False, timestamp=3)
    return name, values


def _known_values(data: bytes, deeper: _Read) -> tuple[str, list[object]]:
    """The same, without the fields that this version does not know: nobody looks into them, as their classes may be new too."""
    unpacker = msgpack.Unpacker(
        ext_hook=deeper, use_list=False, strict_map_key=False, timestamp=3, max_buffer_size=len(data)
    )
    unpacker.feed(data)
    try:
        count = unpacker.read_array_header() - 1
        name = unpacker.unpack()
        known = min(count, len(_FIELDS[name]))
        values = [unpacker.unpack() for _ in range(known)]
        for _ in range(count - known):
            unpacker.skip()
    except msgpack.OutOfData as error:
        raise ValueError("it is cut off") from error
    return name, values


def _too_deep(code: int, data: bytes) -> object:
    raise ValueError(f"objects within objects, more than {_DEEPEST} deep")


def _readers(bounded: bool = False, kept: bool = False) -> _Read:
    """Reads an object and what is within it. A file may come from anywhere: each level takes its part of the C stack."""
    read: _Read = _too_deep
    for _ in range(_DEEPEST):
        read = _reader(read, bounded, kept)
    return read


_read = _readers()
_read_kept = _readers(kept=True)
_read_entry = _readers(bounded=True)
"""Of a run file: what is counted on from a number has to stay one that can be written."""
