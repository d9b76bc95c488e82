"""Write: gives a variable or an address a value, once."""

from dataclasses import dataclass

from scanbench.runtime.command import Command, Patch, Plan, Refusal, View
from scanbench.runtime.target import writable_target


@dataclass(frozen=True, slots=True)
class Write(Command):
    """`value` as typed: TRUE, 42, 16#FF, T#5s, 1.5, 'text'."""

    path: str
    value: str

    def plan(self, view: View) -> Plan | Refusal:
        """One patch of the value's bytes."""
        target = writable_target(view, self.path, "write")
        if isinstance(target, Refusal):
            return target
        patch = target.patch(self.value)
        if not isinstance(patch, Patch):
            return patch
        return Plan((patch,), f"{target.symbol.path} := {self.value.strip()}")
