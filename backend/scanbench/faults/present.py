"""The errors that are present: by kind, and each instance of them in the order in which they came."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from scanbench.faults.reference import ErrorRef

Origin = Literal["simulator", "plc", "program"]
"""Who raised an error: somebody at the error simulator, the PLC that found it itself, an instruction of the program."""

Way = Literal["simulator", "tool", "program"]
"""How an error went: recovered at the error simulator, which removes its cause, too; or cleared in the device's own way, by a tool or
by the program."""


@dataclass(frozen=True, slots=True)
class Raised:
    """An error with its details, as somebody raised it."""

    ref: ErrorRef
    by: str
    scan: int
    origin: Origin
    standby: bool = False
    """The standby CPU Unit took over for it, so it does not stop the program."""


@dataclass(frozen=True, slots=True)
class Active:
    """A kind of error that is present."""

    raised: tuple[Raised, ...]
    """Its instances (unit 3 and unit 20, FAL 5 and FAL 7); what the program raised may be there with several details. The
    latest last."""

    @property
    def refs(self) -> tuple[ErrorRef, ...]:
        """With all details that it is present with."""
        return tuple(each.ref for each in self.raised)

    @property
    def by(self) -> str:
        """Who raised it last."""
        return self.raised[-1].by

    @property
    def scan(self) -> int:
        """When it was raised last."""
        return self.raised[-1].scan

    @property
    def origin(self) -> Origin:
        """Whence it came last."""
        return self.raised[-1].origin


Instances = Mapping[str, Raised]
"""By their text, in the order in which they were raised."""


class Present(Mapping[str, Active]):
    """The kinds that are present, that of the latest instance last. Never changed."""

    __slots__ = ("_kinds", "instances")

    def __init__(self, instances: Instances) -> None:
        self.instances = instances
        kinds: dict[str, tuple[Raised, ...]] = {}
        for raised in instances.values():
            kinds[raised.ref.id] = (*kinds.pop(raised.ref.id, ()), raised)
        self._kinds = {id: Active(several) for id, several in kinds.items()}

    def __getitem__(self, id: str) -> Active:
        return self._kinds[id]

    def __iter__(self) -> Iterator[str]:
        return iter(self._kinds)

    def __len__(self) -> int:
        return len(self._kinds)

    def __repr__(self) -> str:
        return f"Present({self._kinds})"


NOTHING = Present({})


def instances_in(present: Mapping[str, Active]) -> Instances:
    """Each instance of what is present."""
    if isinstance(present, Present):
        return present.instances
    return {str(raised.ref): raised for active in present.values() for raised in active.raised}
