"""What happened at one PLC: lines of its log, marks of its timeline, and what its run-time diagnostics found."""

from collections.abc import Callable, Sequence

from scanbench.host.marks import mark_of
from scanbench.host.repeats import Repeats
from scanbench.runtime.clock import monotonic_ns, wall_time
from scanbench.runtime.command import Entry
from scanbench.session.errors import LIVING
from scanbench.session.marks import Marks
from scanbench.symbols.violations import Violations
from scanbench.wire import events
from scanbench.wire.events import Event, LogEntry
from scanbench.wire.host import Diagnosed, MarkKind, PlcState, RunMarks

LOG_LINES = 500
LISTED = 100
"""Entries of one moment that get a line each in the browsers."""


class Log:
    """Keeps the last lines; `keep` keeps them all."""

    def __init__(
        self, lines: Sequence[LogEntry], publish: Callable[[Event], None], keep: Callable[[LogEntry], None],
        state: Callable[[], PlcState],
    ) -> None:  # fmt: skip
        self._lines = list(lines)[-LOG_LINES:]
        self._publish, self._keep, self._state = publish, keep, state
        self._marks, self._repeats = Marks(), Repeats()
        self._violations = Violations()
        self._halted = 0
        """The number of the halt that was told last."""

    @property
    def lines(self) -> list[LogEntry]:
        """The last lines."""
        return list(self._lines)

    @property
    def timeline(self) -> events.TimelineChanged:
        """The run file and all marks."""
        return self._marks.all

    @property
    def violations(self) -> Violations:
        """The runtime diagnostics."""
        return self._violations

    def add(self, author: str, text: str, category: MarkKind = "run", scan: int | None = None) -> None:
        """One more line, of now; of the scan that is shown unless one is given. What happened before it is told before it."""
        self._tell(self._repeats.held(monotonic_ns()))
        self._add(LogEntry(wall_time(), self._state().scan if scan is None else scan, author, text, category))

    def _add(self, line: LogEntry) -> None:
        self._keep(line)
        self._show(line)

    def _show(self, line: LogEntry) -> None:
        self._lines.append(line)
        del self._lines[:-LOG_LINES]
        self._publish(events.Logged((line,)))

    # ---- from the host --------------------------------------------------------------------------------------------

    def on_halt(self, state: PlcState) -> None:
        """A halt that nobody stepped to gets a line of the log, and a mark."""
        halt = state.halt
        if halt is None or halt.number == self._halted:
            return
        self._halted = halt.number
        if halt.reason not in ("step", "goto", "entry") and not halt.past:
            self.add(halt.by or "PLC", f"halted: {halt.text}", "halt", halt.scan)
            self._publish(self._marks.halted(halt))

    def on_state(self, before: str, state: PlcState) -> None:
        """The PLC's state changed."""
        self._tell(self._repeats.due(monotonic_ns()))
        if state.state != before and "silent" in (state.state, before):
            text = state.message if state.state == "silent" else "the PLC's process answers again"
            if state.state in ("silent", *LIVING):
                self.add("server", text, "system", state.scan)
        if state.state != before and state.state in ("restarting", "failed"):
            self.add("server", state.message, "system", state.scan)

    def on_entries(self, entries: Sequence[Entry]) -> None:
        """What was entered: of what repeats itself a line now and then; all of it is in the run."""
        found: list[tuple[Entry, str]] = []
        now = monotonic_ns()
        for entry in entries:
            text = self._repeats.text(entry, now)
            if text is not None:
                found += [*self._repeats.held(now), (entry, text)]
        self._tell(found)

    def _tell(self, found: Sequence[tuple[Entry, str]]) -> None:
        """Lines and marks of entries: all are kept; of many at once most are summed up, not shown."""
        if not found:
            return
        self._publish(self._marks.add([mark_of(entry, text) for entry, text in found]))
        lines = [_line_of(entry, text) for entry, text in found]
        for line in lines[:LISTED]:
            self._add(line)
        if len(lines) > LISTED:
            for line in lines[LISTED:]:
                self._keep(line)
            last, more = lines[-1], len(lines) - LISTED
            self._show(LogEntry(last.at, last.scan, last.author, f"... and {more} more entries", "system"))

    def on_message(self, message: object) -> bool:
        """What the host says; whether it was for the log."""
        match message:
            case RunMarks():
                self._publish(self._marks.take(message))
            case Diagnosed():
                self._on_diagnosed(message.violations)
            case _:
                return False
        return True

    def _on_diagnosed(self, violations: Violations) -> None:
        """Everybody gets the list; a place that is new in it also gets a line of the log."""
        before = {(each.site, each.instance) for each in self._violations.entries}
        self._violations = violations
        self._publish(events.DiagnosticsChanged(violations))
        for each in violations.entries:
            if (each.site, each.instance) not in before:
                text = f"{each}, {each.span.file}:{each.span.line}"
                self.add("PLC", text, "system", each.first_scan)


def _line_of(entry: Entry, text: str) -> LogEntry:
    return LogEntry(entry.at, entry.scan, entry.command.author, text, entry.command.category)
