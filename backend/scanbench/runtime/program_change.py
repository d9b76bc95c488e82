"""ProgramChange: the mark in the journal where a new program took over. The swap itself is the resource's."""

from dataclasses import dataclass

from scanbench.runtime.command import Command, Plan, Refusal, View


@dataclass(frozen=True, slots=True)
class ProgramChange(Command):
    """Program `version` runs from here on; `report` says what became of the variables."""

    version: int
    report: str

    def plan(self, view: View) -> Plan | Refusal:
        """No patches: the image was made anew."""
        return Plan((), f"program version {self.version}: {self.report}")
