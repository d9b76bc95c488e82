"""Write: gives a variable or an address a value, once."""

from dataclasses import dataclass

from scanbench.runtime.command import Command, Patch, Plan, Refusal, View
from scanbench.runtime.forces import read_table
from scanbench.runtime.rights import Right
from scanbench.runtime.target import writable_target


@dataclass(frozen=True, slots=True)
class Write(Command):
    """`value` as typed: TRUE, 42, 16#FF, T#5s, 1.5, 'text'."""

    path: str
    value: str

    def plan(self, view: View) -> Plan | Refusal:
        """One patch of the value's bytes."""
        target = writable_target(view, self.path, Right.WRITE)
        if isinstance(target, Refusal):
            return target
        patch = target.patch(self.value)
        if not isinstance(patch, Patch):
            return patch
        table = read_table(view.memory)
        forced = any(table.get(at, (0, 0))[0] & mask for at, mask in enumerate(patch.mask, patch.offset))
        if forced:
            return Refusal(f"{target.symbol.path} is forced, so a write would be lost: release the force first")
        return Plan((patch,), f"{target.symbol.path} := {self.value.strip()}")
