"""ProgramChange: another program takes over in the seam, with the variables that both have."""

from dataclasses import dataclass

from scanbench.runtime.command import Command, Patch, Plan, Refusal, Swapped, View
from scanbench.runtime.forces import FORCED, hold, table_patches
from scanbench.runtime.header import Mode
from scanbench.runtime.programs import Loaded
from scanbench.runtime.rights import Right, may
from scanbench.runtime.swap import swapped


@dataclass(frozen=True, slots=True)
class ProgramChange(Command):
    """Program `version` runs from here on. The version that ran before is a roll back."""

    version: int

    def plan(self, view: View) -> Plan | Refusal:
        """The swap, and the forces at their new places. After a run-time error the new program starts cold."""
        loaded = self._loaded(view)
        if isinstance(loaded, Refusal):
            return loaded
        if view.header.halted_by_trap:
            report = "cold start, as the old program had stopped by a run-time error"
            return Plan((), f"program version {self.version}: {report}", Swapped(self.version, fresh=True))
        image, change = swapped(view.program, view.memory, loaded.program, fresh=False)
        patches, released = _forces(view, View(loaded.program, image))
        report = f"program version {self.version}: {change}"
        if released:
            report += f"; forces released: {', '.join(released)}"
        return Plan(patches, report, Swapped(self.version, fresh=False, released=released))

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
        except LookupError as error:
            return Refusal(str(error.args[0]) if error.args else f"there is no program version {self.version}")
        if loaded.program.layout.model.name != view.model.name:
            return Refusal(
                f"program version {self.version} is for a {loaded.program.layout.model.name}, this PLC is a "
                f"{view.model.name}: create an instance of the other model for it"
            )
        return loaded


def _forces(old: View, new: View) -> tuple[tuple[Patch, ...], tuple[str, ...]]:
    """The force table of the new image, and the paths of those that have no place there any more."""
    table: dict[int, tuple[int, int]] = {}
    released: list[str] = []
    for force in old.derived(FORCED).values():
        found = force.bits(new)
        if isinstance(found, Refusal):
            released.append(force.path)
            continue
        hold(table, found)
    return (table_patches(new, table) if table else ()), tuple(released)
