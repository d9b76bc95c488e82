"""What the names in a routine mean."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Parameter:
    """A required one of an Add-On Instruction."""

    name: str
    usage: str
    """`Input`, `Output` or `InOut`."""


@dataclass(frozen=True, slots=True)
class Passed:
    """What a routine is given and gives back, as it is written there."""

    inputs: tuple[str, ...] = ()
    results: tuple[str, ...] = ()


@dataclass(slots=True)
class Known:
    """What the names in a routine mean; all names in upper case."""

    aliases: Mapping[str, str] = field(default_factory=dict)
    """What an alias is written for."""
    routines: Mapping[str, str] = field(default_factory=dict)
    """The action that each routine of the program is."""
    instructions: Mapping[str, Sequence[Parameter]] = field(default_factory=dict)
    """Add-On Instructions."""
    types: Mapping[str, tuple[str, Sequence[int]]] = field(default_factory=dict)
    """The type of each tag, in upper case, and its dimensions."""
    passed: Mapping[str, Passed] = field(default_factory=dict)
    """What each routine of the program is given and gives back, where that is read."""
    routine: str = ""
    """The one that is written, in upper case."""
    members: Mapping[str, Mapping[str, tuple[str, Sequence[int]]]] = field(default_factory=dict)
    """The members of each data type, as `types` has tags."""
    stubs: dict[str, str] = field(default_factory=dict)
    """What the texts use of the library `Controller`, and what each is: the type of a result, `BOOL` of a flag, nothing of an instruction."""
