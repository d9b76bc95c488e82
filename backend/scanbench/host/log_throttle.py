"""What logpoints say, on its way to people: no more than somebody can read."""

from scanbench.debug.breakpoint import Breakpoint
from scanbench.faults.inject import Generate
from scanbench.host.link import Link
from scanbench.problems import Span
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Entry
from scanbench.wire.debugging import LogpointSaid

_AT_ONCE = 100
"""Messages in each stretch of time; of the others only their number is told."""
_STRETCH_NS = 500_000_000


class LogThrottle:
    """`debug.Told` of a host."""

    def __init__(self, link: Link) -> None:
        self._link = link
        self._since, self._said = 0, 0
        self._left: dict[int, tuple[int, LogpointSaid]] = {}

    def said(self, breakpoint: Breakpoint, text: str, scan: int, span: Span | None) -> None:
        """A logpoint was reached."""
        file, line = (span.file, span.line) if span is not None else ("", 0)
        message = LogpointSaid(breakpoint.id, text, scan, file, line)
        now = monotonic_ns()
        if now - self._since > _STRETCH_NS:
            self.catch_up()
            self._since, self._said = now, 0
        self._said += 1
        if self._said <= _AT_ONCE and not self._link.backlogged:
            self._link.post(message)
        else:
            self._left[breakpoint.id] = (self._left.get(breakpoint.id, (0, message))[0] + 1, message)

    def raised(self, entry: Entry) -> tuple[str, ...]:
        """The errors that an entry raises."""
        command = entry.command
        return tuple(each.id for each in command.errors) if isinstance(command, Generate) else ()

    def catch_up(self) -> None:
        """Tells how many were left out, now and then."""
        if monotonic_ns() - self._since <= _STRETCH_NS or self._link.backlogged:
            return
        left, self._left = self._left, {}
        for count, last in left.values():
            text = last.text if count == 1 else f"{last.text} ({count - 1} more were left out before)"
            self._link.post(LogpointSaid(last.breakpoint, text, last.scan, last.file, last.line))
