"""ClearViolations: empties the list of subrange violations, and what the program sees of it."""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.runtime.command import Category, Command, Patch, Plan, Refusal, View
from scanbench.symbols.violations import cleared, read_violations


@dataclass(frozen=True, slots=True)
class ClearViolations(Command):
    """Also sets `_SubrangeError` to FALSE and `_SubrangeErrorCount` to 0, in every mode."""

    category: ClassVar[Category] = "run"

    def plan(self, view: View) -> Plan | Refusal:
        """Zeros over the list."""
        patches = tuple(Patch.whole(offset, data) for offset, data in cleared(view.program.layout))
        if not patches:
            return Plan((), "this program has no subrange checks, so there is nothing to clear")
        count = read_violations(view.program, view.memory).count
        return Plan(patches, f"runtime diagnostics cleared: {count} violation{'s' * (count != 1)}")
