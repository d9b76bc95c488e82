"""Disturbances of the control device, as commands."""

from dataclasses import dataclass
from typing import Literal

from scanbench.runtime.command import Command, Plan, Refusal, View


@dataclass(frozen=True, slots=True)
class DisturbanceInfo:
    """A disturbance that is defined and not over, for people."""

    id: int
    text: str
    kind: Literal["flip", "late", "stuck", "result"]
    by: str
    state: Literal["waiting", "active"]
    fired: int
    next_scan: int | None


@dataclass(frozen=True, slots=True)
class Disturbance:
    """See web NewDisturbance."""

    kind: str
    path: str = ""
    bit: int | None = None
    site: str = ""
    scan: int | None = None
    probability: float = 0.0
    seed: int = 0
    scans: int = 1
    times: int = 0


@dataclass(frozen=True, slots=True)
class Disturb(Command):
    """Defines one."""

    wanted: Disturbance

    def plan(self, view: View) -> Plan | Refusal:
        """To come."""
        return Refusal("to come")


@dataclass(frozen=True, slots=True)
class Calm(Command):
    """Takes back."""

    ids: tuple[int, ...] | None

    def plan(self, view: View) -> Plan | Refusal:
        """To come."""
        return Refusal("to come")
