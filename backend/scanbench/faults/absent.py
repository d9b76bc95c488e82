"""Raising a batch of which some are present already: those stay as they are, and the others come."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from scanbench.faults.inject import ACTIVE, Generate
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.command import Category, Command, Plan, Refusal, View


@dataclass(frozen=True, slots=True)
class GenerateAbsent(Command):
    """As `Generate`, without those that are present. Journaled as the `Generate` it comes to."""

    category: ClassVar[Category] = "error"

    errors: tuple[ErrorRef, ...]

    def settled(self, view: View) -> Command:
        """The Generate of those that are not present; itself where all of them are."""
        left = tuple(self._absent(view))
        return Generate(self.author, left) if left else self

    def plan(self, view: View) -> Plan | Refusal:
        """What the Generate plans; nothing where all of them are present."""
        left = tuple(self._absent(view))
        if left:
            return Generate(self.author, left).plan(view)
        return Plan((), "nothing to generate: all of these errors are present already")

    def _absent(self, view: View) -> Iterator[ErrorRef]:
        present = view.derived(ACTIVE)
        for ref in self.errors:
            # one that is refused for a different reason stays, so that the reason is told
            if ref.id not in present or not isinstance(Generate(self.author, (ref,)).plan(view), Refusal):
                yield ref
