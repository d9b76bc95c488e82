"""All that a resource is at one moment, so that it can be put aside and put back."""

from bisect import bisect_right
from dataclasses import dataclass
from operator import attrgetter

from scanbench.recording.smaller import Ending
from scanbench.runtime.inside import Inside, front
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Measured, Resource
from scanbench.runtime.trap import Trapped


@dataclass(frozen=True, slots=True)
class Moment:
    """It holds the program itself, so that going back to it cannot fail."""

    loaded: Loaded
    scan: int
    state: bytes
    """The whole image where a scan is halted."""
    journal: Journal
    measured: Measured
    inside: Inside | None

    @staticmethod
    def of(resource: Resource) -> "Moment":
        """As it is now."""
        state = resource.state if resource.listening.inside is None else bytes(resource.memory)
        return Moment(
            resource.loaded, resource.header.scan, state, resource.journal, resource.measured, resource.listening.inside
        )

    def restore(self, resource: Resource) -> None:
        """Puts it back."""
        resource.restore(self.loaded, self.state, self.journal, self.inside)
        resource.measured = self.measured

    def ending(self) -> Ending:
        """The seam before its scan."""
        state = self.state if self.inside is None else self.inside.begin
        size = self.loaded.program.layout.state_size
        return Ending(self.scan, front(self.journal, self.scan), self.loaded.version, bytes(state[:size]))


def seam(journal: Journal, scan: int, inside: bool) -> int:
    """How many entries lead to the seam before a scan; `inside`: to where the scan began that ran there last."""
    end = bisect_right(journal, scan, key=attrgetter("scan"))
    if inside:
        start = end
        while start and journal[start - 1].scan == scan:
            start -= 1
            if journal[start].plan.starts_fresh:
                break
            if isinstance(journal[start].command, Trapped):
                end = start
                break
    return front(journal, scan, end)
