"""Write: gives a variable or an address a value, once."""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.runtime.command import Category, Patch, Plan, Refusal, View
from scanbench.runtime.forces import forced_table
from scanbench.runtime.rights import Right
from scanbench.runtime.target import Naming, everywhere, writable_target


@dataclass(frozen=True, slots=True)
class Write(Naming):
    """`value` as typed: TRUE, 42, 16#FF, T#5s, 1.5, 'text'.

    A path through an in-out means the variable that the block's last execution was given, or, with `site` (`Main.st:12`), what
    that call passes; the journal has the path of the variable, and the in-out in `through`.
    """

    category: ClassVar[Category] = "write"

    def plan(self, view: View) -> Plan | Refusal:
        """The patch of the value's bytes, and of copies of them."""
        refusal = self.unsettled(view)
        if refusal is not None:
            return refusal
        target = writable_target(view, self.path, Right.WRITE, self.through)
        if isinstance(target, Refusal):
            return target
        patch = target.patch(self.value)
        if not isinstance(patch, Patch):
            return patch
        table = forced_table(view)
        forced = any(table.get(at, (0, 0))[0] & mask for at, mask in enumerate(patch.mask, patch.offset))
        if forced:
            return Refusal(f"{target.shown} is forced, so a write would be lost: release the force first")
        return Plan(everywhere(view, patch), f"{target.shown} := {self.value.strip()}{target.outside(self.value)}")
