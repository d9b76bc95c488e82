"""Sequential function charts as text: steps, their actions, transitions. The drawing follows from FROM and TO."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.networks import NetworkBody, Rung
from scanbench.syntax.tree import node

STEP = "SFC_STEP"
"""The type of a step, in the standard library."""
TIMED = frozenset(("L", "D", "SD", "DS", "SL"))
"""Qualifiers that need a duration."""
QUALIFIERS = frozenset(("N", "R", "S", "P", "P0", "P1")) | TIMED
MEMORIES = {
    "N": (), "R": (), "S": ("S",), "P": ("P",), "P0": ("P0",), "P1": ("P1",), "L": (), "D": (),
    "SD": ("SD",), "DS": ("DS",), "SL": ("SL",),
}  # fmt: skip
"""What an action keeps for each of its qualifiers, BOOL each; a timed one also has whether its time runs, since when, and how long."""
OF = "/"
"""In the name of a hidden variable: between the POU, the ACTION whose chart has it, and what it is of."""


@node
class Association:
    """`action(qualifier, duration, indicator)` in a step."""

    action: tree.Expression
    """A BOOL variable, or the name of an ACTION."""
    name: str
    """The action as written, without blanks."""
    qualifier: str
    duration: tree.Expression | None
    indicator: tree.Expression | None
    span: Span


@node
class Step:
    name: tree.Name
    initial: bool
    actions: tuple[Association, ...]
    span: Span
    """Of STEP and the name."""


@node
class Transition:
    name: str
    priority: int | None
    sources: tuple[tree.Name, ...]
    targets: tuple[tree.Name, ...]
    condition: tree.Expression | Rung | None
    """A rung gives the power at its end. None where it could not be read."""
    span: Span
    """From TRANSITION to the last step."""


@node
class Chart:
    steps: tuple[Step, ...]
    transitions: tuple[Transition, ...]
    span: Span
    owner: str = ""
    """The name of the POU, or of POU and ACTION."""
    action: str = ""
    """The name of the ACTION whose body it is; '' where it is the body of the POU."""
    whole: bool = True
    """False: a step or transition of it could not be read, and is not in here."""

    @property
    def conditions(self) -> NetworkBody:
        """The rungs of the transitions."""
        rungs = tuple(each.condition for each in self.transitions if isinstance(each.condition, Rung))
        return NetworkBody(rungs, self.span, self.owner)

    @property
    def in_order(self) -> tuple[Transition, ...]:
        """Transitions in the order in which they are tested: by priority, those without one last, then as written."""
        return tuple(sorted(self.transitions, key=lambda each: (each.priority is None, each.priority or 0)))


@dataclass(frozen=True, slots=True)
class Use:
    """All that a chart says of one action."""

    first: Association
    by_qualifier: dict[str, tuple[tuple[Step, Association], ...]]

    @property
    def name(self) -> str:
        return self.first.name


def uses(chart: Chart) -> tuple[Use, ...]:
    """The actions in the order of their first use."""
    found: dict[str, list[tuple[Step, Association]]] = {}
    for step in chart.steps:
        for each in step.actions:
            found.setdefault(each.name.upper(), []).append((step, each))
    made = []
    for all_ in found.values():
        qualifiers = dict.fromkeys(each.qualifier for _, each in all_)
        made.append(
            Use(all_[0][1], {name: tuple(pair for pair in all_ if pair[1].qualifier == name) for name in qualifiers})
        )
    return tuple(made)


def kept(chart: Chart, name: str, what: str) -> str:
    """The hidden variable of an action: its Q, what a qualifier remembers; of a timed one `L.on`, `L.since` and `L.time`.
    Each chart of a POU has a control of its own, and so has one that takes the place of a chart of a base."""
    pou = chart.owner.removesuffix(f".{chart.action}")
    return f"${OF.join((pou, chart.action, name))}.{what}"


def controls(name: str, members: Iterable[str]) -> list[str]:
    """Of members of an instance, those of bases first, the Q of this action in each chart that names it; all in upper
    case. A chart that a POU has in place of one of its base counts, not that one."""
    ends = f"{OF}{name}.Q".upper()
    found = [each for each in members if each.startswith("$") and each.endswith(ends)]
    return list({each.split(OF)[1]: each for each in found if each.count(OF) == 2}.values())


def begun(chart: Chart) -> str:
    """The hidden variable that is TRUE from the first evaluation on."""
    return f"${chart.owner}.begun"


def variables(chart: Chart) -> tuple[tree.VariableSection, ...]:
    """The steps, and what the chart remembers between two evaluations."""
    return (tree.VariableSection("VAR", (), tuple(_variables(chart)), chart.span),)


def _variables(chart: Chart) -> Iterator[tree.Variable]:
    def made(name: str, type: str, span: Span) -> tree.Variable:
        return tree.Variable(name, tree.NamedType(type, span), None, None, span)

    for step in chart.steps:
        yield made(step.name.name, STEP, step.name.span)
    yield made(begun(chart), "BOOL", chart.span)
    for use in uses(chart):
        yield made(kept(chart, use.name, "Q"), "BOOL", use.first.span)
        for qualifier in use.by_qualifier:
            for memory in MEMORIES[qualifier]:
                yield made(kept(chart, use.name, memory), "BOOL", use.first.span)
            if qualifier in TIMED:
                yield made(kept(chart, use.name, f"{qualifier}.on"), "BOOL", use.first.span)
                yield made(kept(chart, use.name, f"{qualifier}.since"), "TIME", use.first.span)
                yield made(kept(chart, use.name, f"{qualifier}.time"), "TIME", use.first.span)
