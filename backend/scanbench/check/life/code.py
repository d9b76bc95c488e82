"""The code that initialises instances, as others call it."""

from dataclasses import dataclass, field

from scanbench.check.life.needs import Needs
from scanbench.check.life.numbers import Numbers
from scanbench.program.program import Pou


@dataclass(slots=True)
class Code:
    """Of one program: a POU for each block that has something to initialise, and one that looks after a program change."""

    needs: Needs
    numbers: Numbers = field(default_factory=Numbers)
    starts: dict[str, Pou] = field(default_factory=dict)
    """By the name of the block, in upper case."""
    changes: dict[str, Pou] = field(default_factory=dict)
