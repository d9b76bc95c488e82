"""SetMode, and what stopping does to the outputs."""

from dataclasses import dataclass

from scanbench.check.layout import Layout
from scanbench.runtime.command import Command, Patch, Plan, Refusal, View
from scanbench.runtime.header import Halt, Mode


@dataclass(frozen=True, slots=True)
class SetMode(Command):
    """PROGRAM: the program does not run. MONITOR: it runs, tools may write. RUN: it runs, tools may only look."""

    mode: str

    def plan(self, view: View) -> Plan | Refusal:
        """The mode byte; on the way to PROGRAM also the outputs, and the trap that it ends."""
        if self.mode not in Mode.__members__:
            return Refusal(f"{self.mode} is not a mode", tuple(Mode.__members__))
        mode, header = Mode[self.mode], view.header
        if mode is header.mode and not (mode is Mode.PROGRAM and header.halt):
            return Plan((), f"already in {mode.name}")
        patch = Patch.whole(Layout.MODE, bytes((mode,)))
        if mode is Mode.PROGRAM:
            halt = header.halt & ~Halt.TRAP
            halt_patch = Patch.whole(Layout.FATAL, bytes((halt,)))
            return Plan((patch, halt_patch, *outputs_off(view)), "mode PROGRAM: the program is stopped")
        if header.halt & Halt.FATAL_ERROR:
            return Refusal(f"cannot change to {mode.name}: a fatal error is present. Recover it, then set {mode.name}")
        if header.halt & Halt.TRAP:
            return Refusal(
                f"cannot change to {mode.name}: the program stopped by a run-time error. "
                "Correct it and build, or restart, or change to PROGRAM first"
            )
        return Plan((patch,), f"mode {mode.name}: the program runs")


def outputs_off(view: View) -> tuple[Patch, ...]:
    """Patches that switch every output off, as the model does when its program stops."""
    areas = view.program.layout.areas
    return tuple(
        Patch.whole(areas[words.area.name] + 2 * words.first, bytes(2 * (words.last - words.first + 1)))
        for words in view.model.fatal.outputs
    )


def memory_cleared(view: View) -> tuple[Patch, ...]:
    """Patches that clear what a fatal error clears; none when the model's hold bit is on."""
    areas, hold = view.program.layout.areas, view.model.fatal.hold
    if hold is not None and hold.bit is not None and view.memory[areas[hold.area.name] + hold.byte] >> hold.bit & 1:
        return ()
    return tuple(Patch.whole(areas[area.name], bytes(area.size)) for area in view.model.fatal.cleared)
