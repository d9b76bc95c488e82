"""ProgramChange: a new program takes over in the seam, and keeps the variables that both have."""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.program.layout import Layout
from scanbench.runtime.command import Category, Command, Patch, Plan, Refusal, Swapped, View
from scanbench.runtime.forces import FORCED, hold, table_patches
from scanbench.runtime.header import Mode
from scanbench.runtime.programs import Loaded, NoProgram
from scanbench.runtime.rights import Right, may
from scanbench.runtime.swap import swapped

_WARM = "warm start, as the old program had stopped by a run-time error: what is retained is kept"


@dataclass(frozen=True, slots=True)
class ProgramChange(Command):
    """Program `version` runs from here on. The version that ran before is a roll back."""

    category: ClassVar[Category] = "build"

    version: int

    def plan(self, view: View) -> Plan | Refusal:
        """The swap, and the forces at their new places. After a run-time error the new program starts warm."""
        loaded = self._loaded(view)
        if isinstance(loaded, Refusal):
            return loaded
        fresh = view.header.halted_by_trap
        image, change = swapped(view.program, view.memory, loaded.program, fresh)
        image[Layout.MODE] = Mode.MONITOR  # what is forced stays so, also where nobody may force it again
        patches, released = _forces(view, View(loaded.program, image))
        report = f"program version {self.version}: {_WARM if fresh else change.counted}"
        if released:
            report += f"; forces released: {', '.join(released)}"
        return Plan(patches, report, Swapped(self.version, fresh, released))

    def _loaded(self, view: View) -> Loaded | Refusal:
        """The new program, or why it cannot take over."""
        mode = view.header.mode
        if not view.header.halted_by_trap:
            refused = may(mode, Right.TRANSFER if mode is Mode.PROGRAM else Right.CHANGE)
            if refused is not None:
                return refused
        if self.version == view.version:
            return Refusal(f"program version {self.version} runs already")
        try:
            loaded = view.programs.get(self.version)
        except NoProgram as error:
            return Refusal(str(error))
        if loaded.program.layout.model.name != view.model.name:
            return Refusal(
                f"program version {self.version} is for a {loaded.program.layout.model.name}, this PLC is a "
                f"{view.model.name}: create an instance of the other model for it"
            )
        return loaded


def _forces(old: View, new: View) -> tuple[tuple[Patch, ...], tuple[str, ...]]:
    """The forces in the new image, and the paths of those that have no place there any more."""
    table: dict[int, tuple[int, int]] = {}
    values: list[Patch] = []
    released: list[str] = []
    for force in old.derived(FORCED).values():
        found = force.bits(new)
        if isinstance(found, Refusal):
            released.append(force.path)
            continue
        hold(table, found)
        values.append(found)
    return ((*table_patches(new, table), *values) if table else ()), tuple(released)
