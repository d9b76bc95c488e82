"""Facts of a model, one by one: what is said about the device, where it comes from, and whether somebody looked it up."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

Kind = Literal["area", "system", "special", "instruction", "error"]


@dataclass(frozen=True, slots=True)
class Fact:
    """One statement about the device."""

    kind: Kind
    subject: str
    """What it is about: the name of an area, special or instruction, the id of an error, a part of the system."""
    of: str
    """Which fact: `flag`, `code`, `priority`, ..."""
    value: str
    """What the model file says, for people."""
    source: str
    verified: bool
    """Somebody found it on a page that `source` names."""
    inherited: bool
    """It has no Source of its own: that of the element around it."""


KINDS: Mapping[str, tuple[str, ...]] = {
    "Area": ("words", "access", "retention", "text"),
    "System": ("code-word",),
    "Fatal": ("outputs", "cleared", "hold"),
    "ErrorLog": ("place", "records", "format", "counter"),
    "ErrorReset": ("reset",),
    "ErrorTime": ("place", "format"),
    "Standby": ("status", "switches", "time"),
    "Special": ("address", "meaning", "text"),
    "Instruction": ("effect", "numbers", "clearing", "system-errors", "text"),
    "Message": ("numbers", "text"),
    "Query": ("effect", "numbers", "text"),
    "Reset": ("effect", "text"),
    "Error": ("flag", "code", "severity", "priority", "cause", "memory", "log", "details", "text"),
}
"""The facts that an element of a model file can state."""


def share(facts: Iterable[Fact]) -> tuple[int, int]:
    """How many were looked up, and how many there are."""
    all_ = list(facts)
    return sum(fact.verified for fact in all_), len(all_)
