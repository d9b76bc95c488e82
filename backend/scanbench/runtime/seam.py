"""The seam between two scans: the only place where anything from outside enters the image."""

from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Command, Entry, Patch, Plan, Refusal, View
from scanbench.runtime.journal import Journal


def apply(memory: bytearray, plan: Plan) -> None:
    """Applies a plan whole."""
    for patch in plan.patches:
        _apply(memory, patch)


def enter(command: Command, view: View, memory: bytearray, journal: Journal) -> Entry | Refusal:
    """Plans a command, applies the plan, and keeps both in the journal under the number of the next scan."""
    plan = command.plan(view)
    if isinstance(plan, Refusal):
        return plan
    entry = Entry(view.header.scan, wall_time(), command, plan)
    apply(memory, plan)
    journal.append(entry)
    return entry


def _apply(memory: bytearray, patch: Patch) -> None:
    end = patch.offset + len(patch.data)
    if end > len(memory) or patch.offset <= 0:
        raise ValueError(f"plan reaches byte {end} of an image of {len(memory)}")
    if patch.mask.count(0xFF) == len(patch.mask):
        memory[patch.offset : end] = patch.data
        return
    for index, (mask, data) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
        memory[index] = memory[index] & ~mask | data & mask
