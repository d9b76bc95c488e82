"""The state of a PLC in words, derived from its image and journal."""

from scanbench.debug.debugger import Debugger
from scanbench.debug.halt import Halt as Stopped
from scanbench.faults.inject import ACTIVE
from scanbench.host.pacer import Pacer
from scanbench.program.sites import TrapKind
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry, Swapped
from scanbench.runtime.forces import FORCED
from scanbench.runtime.header import Halt, Mode
from scanbench.runtime.journal import Fold
from scanbench.runtime.resource import Resource
from scanbench.wire.host import PlcState


def _swapped(versions: tuple[int, ...], entry: Entry) -> tuple[int, ...]:
    effect = entry.plan.effect
    return (*versions[-1:], effect.version) if isinstance(effect, Swapped) else versions


SWAPPED: Fold[tuple[int, ...]] = Fold((), _swapped)
"""The last two versions that were changed to."""


def previous_version(timeline: Timeline) -> int | None:
    """What ran before the last change of the program; None where there was none."""
    versions = (next(iter(timeline.recording.programs)), *timeline.live_journal.derived(SWAPPED))
    return versions[-2] if len(versions) > 1 else None


def host_state(timeline: Timeline, pacer: Pacer, past_by: str, note: str, debugger: Debugger) -> PlcState:
    """What the top bar shows. `note` is shown if there is nothing more urgent."""
    resource = timeline.resource
    header = resource.header
    state, message = _state(resource, pacer.paused, note)
    if state == "running" and timeline.recording.trouble:
        state = "no_space"
        message = (
            f"{timeline.recording.trouble}. Free some space on the disk: the PLC waits, and goes on when there is room"
        )
    halt = debugger.halt
    if halt is not None:
        state, message = "halted", _halted(halt)
    if timeline.past:
        state, message = "past", f"scan {header.scan} of {timeline.live_scan}, shown by {past_by}"
    return PlcState(
        state=state,
        mode=header.mode.name,
        message=message,
        scan=header.scan,
        time_ns=header.next_clock_ns(resource.program.interval_ns),
        interval_ns=resource.program.interval_ns,
        cycle_us=round(resource.measured.cycle_us, 2),
        speed=pacer.speed,
        paused=pacer.paused,
        trap=resource.trap,
        forces=len(resource.journal.derived(FORCED)),
        version=timeline.resource.version,
        live_scan=timeline.live_scan,
        past_by=past_by,
        target=pacer.target,
        previous_version=previous_version(timeline),
        late_percent=round(pacer.late_percent, 2),
        late_us=round(pacer.pace.late_ns / max(1, pacer.pace.scans) / 1000, 1),
        worst_us=round(pacer.pace.worst_ns / 1000, 1),
        halt=halt,
        flavour=debugger.flavour,
    )


def _halted(halt: Stopped) -> str:
    where = f" before {halt.span}" if halt.span is not None else ""
    return f"halted{where}: {halt.text}"


def _state(resource: Resource, paused: bool, note: str) -> tuple[str, str]:
    header = resource.header
    trap = resource.trap
    if trap is not None and trap.kind != TrapKind.FATAL:
        return "trapped", f"stopped by a run-time error{_code(resource)}: {trap}"
    present = resource.journal.derived(ACTIVE)
    if header.halt & Halt.FATAL_ERROR:
        errors = (resource.program.layout.model.error(id) for id in present)
        names = ", ".join(error.name for error in errors if error is not None and error.severity == "fatal")
        where = f", raised at {trap.file}:{trap.line}" if trap is not None else ""
        return "fatal", f"fatal error{_code(resource)}: {names}{where}. Recover it, then change to MONITOR or RUN"
    if header.mode is Mode.PROGRAM:
        return "stopped", "mode PROGRAM: the program is stopped"
    if present:
        count = len(present)
        note = f"{count} error{'s' * (count != 1)} present{_code(resource)}"
    return ("paused" if paused else "running"), note


def _code(resource: Resource) -> str:
    layout = resource.program.layout
    word = layout.model.code_word
    if word is None:
        return ""
    start = layout.areas[word.area.name] + word.byte
    code = int.from_bytes(resource.memory[start : start + word.bits // 8], "little")
    return f" {layout.model.show_code(code)}" if code else ""
