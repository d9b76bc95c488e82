"""The past of the run, what was reached of the program, and what left its subrange."""

from scanbench.client.asking import Steps, asked, asked_value
from scanbench.client.requests.base import Asks
from scanbench.client.shapes import past as shapes
from scanbench.client.shapes.running import CommandResult


class Past(Asks):
    """Questions about the run so far; the PLC goes on meanwhile."""

    @asked
    def last_write(self, path: str, scan: int | None = None) -> Steps[shapes.LastWriter]:
        """Who last wrote a variable before a scan began, or before what is shown now: `by` (`program`, `command`, `plc`, `start`),
        `place` of a statement, `author` of a command, `scan`, `value`, and `text` for people."""
        return self._get(shapes.LastWriter, "last-write", path=path, scan=scan)

    @asked
    def changes(self, first: int, last: int) -> Steps[shapes.RunChanges]:
        """The variables that differ between the beginnings of two scans, and what was entered in between."""
        return self._get(shapes.RunChanges, "changes", first=first, last=last)

    @asked_value
    def diagnostics(self) -> Steps[shapes.Diagnostics]:
        """The values that left their subrange: `violations` (place, instance, `variable`, `value`, bounds, `times`, first and last
        scan), `count` of them, and how many found no room in the list (`dropped`)."""
        return self._get(shapes.Diagnostics, "diagnostics")

    @asked
    def clear_diagnostics(self) -> Steps[str]:
        """Forgets the violations that were counted."""
        return self._command("commands", {"type": "clear_diagnostics"})

    @asked
    def cover(self, on: bool = True, reset: bool = False) -> Steps[str]:
        """Notes from now on which statements and branches are reached, or no longer; `reset` forgets what was reached."""
        return (yield from self._send(CommandResult, "PATCH", "coverage", {"on": on, "reset": reset}))["message"]

    @asked_value
    def coverage(self) -> Steps[shapes.Coverage]:
        """What was reached since coverage was switched on: `scans` that were noted, and `files` with a `count` for each place."""
        return self._get(shapes.Coverage, "coverage")

    @asked_value
    def coverage_lcov(self) -> Steps[str]:
        """The same as text in the format LCOV, for genhtml and CI."""
        return (yield from self._fetch("coverage.lcov")).decode()
