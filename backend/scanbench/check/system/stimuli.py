"""The programs that the tables of inputs in plant/ became."""

from dataclasses import dataclass, field

from scanbench.check.context import Report
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.scopes import Pous
from scanbench.check.system.driven import Driven, warn_of_contention
from scanbench.check.system.stimulus import StimulusChecker
from scanbench.program.program import Pou
from scanbench.program.types import Record
from scanbench.syntax import tree


@dataclass(slots=True)
class Stimuli:
    """Made once each, as they depend on declarations only."""

    programs: dict[tree.Stimulus, Pou] = field(default_factory=dict)
    driven: dict[Pou, list[Driven]] = field(default_factory=dict)

    def check(
        self, report: Report, declarations: Declarations, pous: Pous, variables: Record, parsed: list[tree.File]
    ) -> None:
        """Makes those of `parsed` that are new, and forgets those that are gone."""
        tables = [stimulus for file in parsed for stimulus in file.stimuli]
        self._forget(report, pous, set(tables))
        known, self.programs = self.programs, {}  # in the order of their files, whatever was edited last
        for stimulus in tables:
            pou = known.get(stimulus)
            if pou is None:
                with report.apart() as part:
                    instances = _program_variables(parsed, pous)
                    checker = StimulusChecker(report, declarations, pous, variables, stimulus, instances)
                    pou = checker.make()
                report.parts[pou] = part
                self.driven[pou] = checker.driven
            self.programs[stimulus] = pou
        for stimulus, pou in self.programs.items():
            first = pous.blocks.setdefault(pou.name.upper(), pou)
            if first is not pou:
                report.error(
                    "D001", f"This file's program `{pou.name}` is declared already in {first.span}; rename the file.",
                    stimulus.span,
                )  # fmt: skip
        self.driven = {pou: self.driven[pou] for pou in self.programs.values()}
        warn_of_contention(report, self.driven)

    def _forget(self, report: Report, pous: Pous, tables: set[tree.Stimulus]) -> None:
        for stimulus, pou in self.programs.items():
            if pous.blocks.get(pou.name.upper()) is pou:
                del pous.blocks[pou.name.upper()]
            if stimulus not in tables:
                report.parts.pop(pou, None)


def _program_variables(parsed: list[tree.File], pous: Pous) -> dict[str, Record]:
    """By the name of the program instance."""
    programs = {key: pou.instance for key, pou in pous.blocks.items() if pou.kind == "program" and not pou.inline}
    for configuration in (each for file in parsed for each in file.configurations):
        resources = configuration.resources
        for each in (*configuration.programs, *(program for resource in resources for program in resource.programs)):
            if each.type.name.upper() in programs:
                programs[each.name.upper()] = programs[each.type.name.upper()]
    return programs
