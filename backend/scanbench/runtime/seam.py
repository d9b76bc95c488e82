"""The seam between two scans: the only place where anything from outside enters the image."""

from scanbench.runtime.command import Effect, Patch, Plan, Restarted, Swapped
from scanbench.runtime.programs import Loaded, Programs
from scanbench.runtime.restart import restarted
from scanbench.runtime.swap import swapped


def apply(loaded: Loaded, programs: Programs, plan: Plan) -> Loaded:
    """Applies a plan whole; the program that runs after it."""
    if plan.effect is not None:
        loaded = _take_effect(loaded, programs, plan.effect)
    for patch in plan.patches:
        _apply(loaded.memory, patch)
    return loaded


def _take_effect(loaded: Loaded, programs: Programs, effect: Effect) -> Loaded:
    if isinstance(effect, Restarted):
        loaded.memory[:] = restarted(loaded.program, loaded.memory, effect.kind)
        return loaded
    if not isinstance(effect, Swapped):
        return loaded
    new = programs.get(effect.version)
    new.memory[:], _ = swapped(loaded.program, loaded.memory, new.program, effect.fresh)
    return new


def _apply(memory: bytearray, patch: Patch) -> None:
    end = patch.offset + len(patch.data)
    if end > len(memory) or patch.offset <= 0:
        raise ValueError(f"plan reaches byte {end} of an image of {len(memory)}")
    if patch.mask.count(0xFF) == len(patch.mask):
        memory[patch.offset : end] = patch.data
        return
    for index, (mask, data) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
        memory[index] = memory[index] & ~mask | data & mask
