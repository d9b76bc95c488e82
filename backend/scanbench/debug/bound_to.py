"""What is said of the binding of an in-out."""

from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.public import Public

Convention = Literal["reference", "value"]


@dataclass(frozen=True, slots=True)
class BoundTo(Public):
    """One call site of an in-out, and what it passes."""

    actual: str
    """Path of the variable, `Main.tank[3].level`; empty when it is not known yet."""
    address: str
    """Vendor notation where it is located; else empty."""
    file: str
    line: int
    column: int
    call: str
    """The path of the calling instance, `Main.line`."""
    scan: int | None
    """Scan of the last execution; None: never, or nobody noted it, as the call does not run in every scan of its task."""
    last: bool
    """It is the one that ran last: what a write goes to."""
    message: str = ""
    """Why a write cannot go there: a constant, a read-only area."""


@dataclass(frozen=True, slots=True)
class Bound(Public):
    """What an in-out is bound to, and all that may be passed to it."""

    PUBLIC: ClassVar = "Binding"

    ok: bool
    message: str
    """Why it is bound to nothing: `not called yet`, ..."""
    convention: Convention
    sites: tuple[BoundTo, ...]
