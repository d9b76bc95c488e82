"""The ways through a body of IL: what the current result is at each label, whichever way came there."""

from dataclasses import dataclass, field

from scanbench.program.types import Type
from scanbench.syntax import tree

ROUNDS = 8
"""After so many, labels that jumps back still disagree on have no current result: the rest is sure in one round more."""


@dataclass(frozen=True, slots=True)
class Current:
    """The current result: an expression of a type; nothing (`type` None); or unknown, after a problem told already.

    A literal has its default type unless the context asks for a different one. At a label that is the target of jumps, only the
    type is known, and the value is in the temporary for it.
    """

    node: tree.Expression | None = None
    type: Type | None = None
    broken: bool = False
    why: str = field(default="", compare=False)
    """Why there is nothing, to be told after "load a value first"."""


NOTHING = Current()
BROKEN = Current(broken=True)


@dataclass(slots=True)
class Label:
    name: str
    block: int
    """Number of the block that begins here; block 0 comes before all labels."""
    used: bool = False
    """Whether any JMP names it."""
    wanted: Type | None = None
    """What a literal becomes on its way here."""
    ways: list[Current] = field(default_factory=list)
    """The current result on each way to here, in this round."""
    taken: Current = BROKEN
    """What was gone on with."""
    known: Current | None = None
    """What earlier rounds found that jumps back bring."""


class Flow:
    """Goes through the body in rounds: jumps back tell at the end of one what the next has to begin with."""

    def __init__(self, body: tree.IlBody) -> None:
        self.labels: dict[str, Label] = {}
        self.falls = True
        """Whether the next instruction is reached from the one before."""
        self._rounds = 0
        for node in body.instructions:
            if node.label is not None and node.label.upper() not in self.labels:
                self.labels[node.label.upper()] = Label(node.label, len(self.labels) + 1)
        for node in body.instructions:
            if node.operator == "JMP" and isinstance(node.operand, tree.Name):
                label = self.labels.get(node.operand.name.upper())
                if label is not None:
                    label.used = True

    def start(self) -> None:
        """Before each round."""
        self.falls = True
        self._rounds += 1
        for label in self.labels.values():
            label.ways, label.taken = [], BROKEN

    def jump(self, name: str, current: Current) -> None:
        """A way to a label; none where the jump itself is never reached."""
        if self.falls:
            self.labels[name.upper()].ways.append(current)

    def enter(self, name: str, current: Current) -> Current:
        """The current result at a label, where the instruction before left `current`."""
        label = self.labels[name.upper()]
        if self.falls:
            label.ways.append(current)
        if not label.used:
            return current if self.falls else BROKEN
        self.falls = True
        label.taken = join([*label.ways, *([] if label.known is None else [label.known])])
        if label.taken == NOTHING:
            return Current(why=f" (the ways to the label `{label.name}` bring different types, or none)")
        return label.taken

    def revised(self) -> bool:
        """After a round: whether a jump back brought something else than was gone on with, so that one more is due."""
        again = False
        for label in self.labels.values():
            full = join(label.ways)
            agreed = full.broken or (full.type == label.taken.type and not label.taken.broken)
            if not label.used or agreed or label.known == NOTHING:
                continue
            # a label that nothing had reached yet learns its type; where two ways differ there is none
            fresh = label.known is None and label.taken.broken and self._rounds < ROUNDS
            label.known = full if fresh else NOTHING
            again = True
        if again and self._rounds == ROUNDS:
            for label in self.labels.values():
                label.known = NOTHING if label.used else None
        return again


def join(ways: list[Current]) -> Current:
    """What holds whichever way was taken: the type that all have, else nothing."""
    if not ways or any(way.broken for way in ways):
        return BROKEN
    first = ways[0].type
    return Current(None, first) if all(way.type == first for way in ways) else NOTHING
