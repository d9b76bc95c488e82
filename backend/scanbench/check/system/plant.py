"""The plant: the files in `plant/` of a project. They drive the inputs in every scan, before the forces (phase 2).

Its programs run without a task, in the order of their file names; a CONFIGURATION does not name them. They write with the
rights of the engine interface, so inputs and system words too. Blocks and functions of the plant are for the plant only.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from scanbench.check.context import Report
from scanbench.check.declare.scopes import Pous
from scanbench.problems import Span
from scanbench.program.origin import is_system
from scanbench.program.program import Pou
from scanbench.syntax import tree
from scanbench.syntax.parse_file import is_stimulus

FOLDER = "plant"


def plant_files(names: Iterable[str]) -> frozenset[str]:
    """Which files of a project are its plant: those in `plant/`, below what all files have in common, and stimuli."""
    parts = {name: name.replace("\\", "/").split("/") for name in names}
    common = _common([each[:-1] for each in parts.values()])
    return frozenset(name for name, each in parts.items() if _is_plant(each, common) or is_stimulus(name))


def _is_plant(parts: Sequence[str], common: int) -> bool:
    folders = [each.lower() for each in parts[:-1]]
    return folders[:1] == [FOLDER] or folders[common : common + 1] == [FOLDER]


def _common(folders: list[list[str]]) -> int:
    """How many folders all of them begin with."""
    count = 0
    while folders and all(len(each) > count and each[count] == folders[0][count] for each in folders):
        count += 1
    return count


@dataclass(slots=True)
class Plant:
    """The plant of one project."""

    report: Report
    pous: Pous
    files: frozenset[str]

    def holds(self, span: Span) -> bool:
        """Whether this span is in a file of the plant."""
        return span.file in self.files

    def programs(self) -> list[Pou]:
        """In the order in which they run."""
        own = [pou for pou in self.pous.blocks.values() if pou.kind == "program" and self.holds(pou.span)]
        return sorted(own, key=lambda pou: pou.span.file)

    def check(self, parsed: list[tree.File]) -> None:
        """Refuses what does not belong here, and what is used elsewhere."""
        for file in parsed:
            for configuration in file.configurations if file.name in self.files else ():
                self.report.error(
                    "D010", "A CONFIGURATION belongs outside of plant/: programs of the plant run by themselves.",
                    configuration.span,
                )  # fmt: skip
        for caller, called in self.pous.uses.items():
            if caller.inline or is_system(caller.span) or self.holds(caller.span):
                continue
            for callee in called:
                if not callee.inline and self.holds(callee.span):
                    self.report.error(
                        "T010",
                        f"`{caller.name}` uses `{callee.name}`, which is of the plant ({callee.span.file}) and only for what "
                        "is there. Move it to a file outside of plant/.",
                        caller.span,
                    )
