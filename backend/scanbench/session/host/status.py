"""The state of a PLC in words, derived from its image and journal."""

from scanbench.faults.inject import active
from scanbench.runtime.forces import forced
from scanbench.runtime.header import Halt, Mode
from scanbench.runtime.resource import Resource
from scanbench.session.protocol import HostState


def host_state(resource: Resource, speed: float, paused: bool, version: int, note: str) -> HostState:
    """What the top bar shows. `note` stands where nothing more pressing is to be said."""
    header = resource.header
    state, message = _state(resource, paused, note)
    return HostState(
        state=state,
        mode=header.mode.name,
        message=message,
        scan=header.scan,
        time_ns=header.scan * resource.program.interval_ns,
        interval_ns=resource.program.interval_ns,
        cycle_us=round(resource.measured.cycle_us, 2),
        speed=speed,
        paused=paused,
        trap=resource.trap,
        forces=len(resource.journal.derived(forced)),
        version=version,
    )


def _state(resource: Resource, paused: bool, note: str) -> tuple[str, str]:
    header = resource.header
    if resource.trap is not None:
        return "trapped", f"stopped by a run-time error: {resource.trap}"
    present = resource.journal.derived(active)
    if header.halt & Halt.FATAL_ERROR:
        errors = (resource.program.layout.model.error(id) for id in present)
        names = ", ".join(error.name for error in errors if error is not None and error.severity == "fatal")
        return "fatal", f"fatal error{_code(resource)}: {names}. Recover it, then change to MONITOR or RUN"
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
    return f" {int.from_bytes(resource.memory[start : start + 2], 'little'):04X}"
