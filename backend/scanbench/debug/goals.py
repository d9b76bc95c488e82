"""Where a step ends."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

from scanbench.engines.debug import Frame

Frames = Callable[[], tuple[Frame, ...]]


class Within(Protocol):
    """A range of the program."""

    @property
    def sites(self) -> frozenset[int]:
        """Its statements."""

    def holds(self, frames: tuple[Frame, ...]) -> bool:
        """Whether the statement that is next, or a call that leads to it, is one of them. `frames`: innermost first."""


@dataclass(frozen=True, slots=True)
class Goal:
    """A step that is under way, and where it began. In a scan's seam it began in no frame."""

    action: str
    author: str
    scan: int
    frames: tuple[Frame, ...] = ()
    sites: frozenset[int] = field(default_factory=frozenset)
    """`to`: the statements of the line."""
    minor: frozenset[int] = field(default_factory=frozenset)
    """`over`: the contacts, which it does not end at."""
    within: Within | None = None
    """`within`: what it ends at."""

    def listens(self, scan: int) -> frozenset[int] | None:
        """The statements at which it may end in a scan; None: at any."""
        if self.within is not None:  # it can be inside of its calls only where it began there
            return None if scan == self.scan and self.within.holds(self.frames) else self.within.sites
        return self.sites if self.action == "to" else None

    def reached(self, site: int, count: int, depth: int, frames: Frames, scan: int) -> bool:
        """Whether it ends before this statement."""
        match self.action:
            case "continue":
                return False
            case "to":
                return site in self.sites
            case "within":
                return self.within is not None and self.within.holds(frames())
            case "scan":
                return scan > self.scan
            case "entry":
                return count == 1
            case "over":
                return site not in self.minor and self._back_in(depth, frames, scan)
            case "out":
                return self._out_of(depth, frames, scan)
            case _:
                return True

    def _back_in(self, depth: int, frames: Frames, scan: int) -> bool:
        begun = len(self.frames)
        if depth != begun or depth <= 1 or scan != self.scan:
            return depth < begun or depth <= 1
        now, then = frames()[0], self.frames[0]
        return now.pou is then.pou and now.instance == then.instance

    def _out_of(self, depth: int, frames: Frames, scan: int) -> bool:
        begun = len(self.frames)
        if begun > 1 and scan == self.scan:
            return depth < begun
        if depth > 1:
            return False
        if scan != self.scan or not self.frames:
            return True
        now, then = frames()[-1], self.frames[-1]
        return now.pou is not then.pou or now.instance != then.instance

    @property
    def words(self) -> str:
        """For people."""
        return {
            "in": "step in", "within": "step in the range", "over": "step over", "out": "step out", "statement": "single statement",
            "scan": "single scan", "to": "run to line", "pause": "pause", "entry": "entry", "continue": "continue",
        }.get(self.action, self.action) + f" by {self.author}"  # fmt: skip
