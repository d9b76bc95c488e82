"""What happened at one PLC: lines of its log, marks of its timeline, and what its run-time diagnostics found."""

from collections.abc import Callable, Sequence

from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Entry
from scanbench.session.errors import LIVING
from scanbench.session.marks import Marks
from scanbench.session.tool_writes import ToolWrites
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
        self._marks, self._tool_writes = Marks(), ToolWrites()
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
        """One more line, of now; of the scan that is shown unless one is given."""
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
        for entry, text in self._tool_writes.due():
            self._add(_line_of(entry, text))
        if state.state != before and "silent" in (state.state, before):
            text = state.message if state.state == "silent" else "the PLC's process answers again"
            if state.state in ("silent", *LIVING):
                self.add("server", text, "system", state.scan)
        if state.state != before and state.state in ("restarting", "failed"):
            self.add("server", state.message, "system", state.scan)

    def on_entries(self, entries: Sequence[Entry]) -> None:
        """What was entered: all of it is kept; of a program that raises errors all the time most is summed up, not shown."""
        self._publish(self._marks.add(entries))
        lines = [line for line in map(self._line, entries) if line is not None]
        for line in lines[:LISTED]:
            self._add(line)
        if len(lines) > LISTED:
            for line in lines[LISTED:]:
                self._keep(line)
            last, more = lines[-1], len(lines) - LISTED
            self._show(LogEntry(last.at, last.scan, last.author, f"... and {more} more entries", "system"))

    def _line(self, entry: Entry) -> LogEntry | None:
        text = self._tool_writes.text(entry)
        return None if text is None else _line_of(entry, text)

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
