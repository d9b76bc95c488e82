"""The past of the run, what was reached of the program, and what left its subrange."""

from collections.abc import Mapping, Sequence
from typing import Protocol

from scanbench.client.asking import Json, Steps, asked, asked_value
from scanbench.client.requests.base import Asks, Value, typed, waited
from scanbench.client.shapes import past as shapes
from scanbench.client.shapes.debugging import BreakpointInfo
from scanbench.client.shapes.running import CommandResult


class Numbered(Protocol):
    """A PLC."""

    @property
    def id(self) -> int:
        """Its number on the server."""


class Past(Asks):
    """Questions about the run so far; the PLC goes on meanwhile."""

    @asked
    def last_write(self, path: str, scan: int | None = None) -> Steps[shapes.LastWriter]:
        """Who last wrote a variable before a scan began, or before what is shown now: `by` (`program`, `command`, `plc`, `start`),
        `place` of a statement, `author` of a command, `scan`, `value`, and `text` for people."""
        return self._get(shapes.LastWriter, "last-write", path=path, scan=scan)

    @asked
    def changes(self, first: int, last: int, other: "int | Numbered | None" = None) -> Steps[shapes.RunChanges]:
        """The variables that differ between the beginnings of two scans, and what was entered in between. With `other`: that differ
        between this PLC at `first` and the other one at `last`."""
        second = None if other is None else _number(other)
        return self._get(shapes.RunChanges, "changes", first=first, last=last, other=second)

    @asked
    def compare(self, other: "int | Numbered", timeout_s: float = 600.0) -> Steps[shapes.Comparison]:
        """Compares this run (A) with that of another PLC (B), scan by scan, and waits for it: where they part is in `result`; where there
        is none, `message` says why."""
        begun = yield from self._send(shapes.Comparison, "POST", "comparisons", {"other": _number(other)})
        return (
            yield from waited(
                lambda: self._get(shapes.Comparison, f"/api/comparisons/{begun['id']}"),
                lambda now: now["result"] is None and not now["message"], timeout_s,
                lambda now: f"{now['done']} of {now['of']} scans are compared",
            )
        )  # fmt: skip

    @asked
    def what_if(
        self, scan: int, values: Mapping[str, Value] | None = None, *, vary: str = "", tried: Sequence[Value] = (),
        change: Sequence[str] = (), condition: str = "", window: int = 100, hold: bool = True, watch: Sequence[str] = (),
    ) -> Steps[shapes.WhatIf]:  # fmt: skip
        """Goes on with the recorded run from a scan with other values: `values` in every try, with `vary` each of those that are `tried`, with
        `change` the smallest change of these variables with which `condition` holds (`tries[best]`, if there is one)."""
        given: list[Json] = [{"path": path, "value": typed(value)} for path, value in (values or {}).items()]
        wanted: Json = {
            "scan": scan, "values": given, "vary": vary, "tried": [typed(each) for each in tried], "search": bool(change),
            "candidates": list(change), "condition": condition, "window": window, "hold": hold, "watch": list(watch),
        }  # fmt: skip
        return self._send(shapes.WhatIf, "POST", "what-if", wanted)

    @asked
    def replay_with(
        self, name: str, *, scan: int, error: str, by: int = 0, instead: str = "", leave_out: bool = False,
        scans_after: int = 0, timeout_s: float = 600.0,
    ) -> Steps[shapes.Rerun]:  # fmt: skip
        """Replays the run with one error changed that was raised before `scan`: `by` so many scans later or earlier, another one
        `instead`, or left out; goes on for `scans_after`. A new PLC comes of it, whose number is in `instance`; where there is none,
        `message` says why."""
        body: dict[str, object] = {
            "name": name, "scan": scan, "error": error, "by": by, "instead": instead, "leave_out": leave_out,
            "scans_after": scans_after,
        }  # fmt: skip
        begun = yield from self._send(shapes.Rerun, "POST", "reruns", body)
        return (
            yield from waited(
                lambda: self._get(shapes.Rerun, f"/api/reruns/{begun['id']}"),
                lambda now: now["instance"] is None and not now["message"], timeout_s,
                lambda now: f"{now['done']} of {now['of']} scans are replayed",
            )
        )  # fmt: skip

    @asked
    def scenario(self, scan: int | None = None) -> Steps[str]:
        """A scenario file of what people and protocol clients did before a scan, or so far: a test that expects the outputs to be the same
        again, for `scanbench scenario`."""
        return (yield from self._fetch("scenario", scan=scan)).decode()

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
    def breakpoints(self) -> Steps[list[BreakpointInfo]]:
        """All breakpoints of the PLC, whoever manages them: `kind`, place, `author`, `verified`, how often `reached`."""
        return self._get(list[BreakpointInfo], "breakpoints")

    @asked_value
    def coverage(self) -> Steps[shapes.Coverage]:
        """What was reached since coverage was switched on: `scans` that were noted, and `files` with a `count` for each place."""
        return self._get(shapes.Coverage, "coverage")

    @asked_value
    def coverage_lcov(self) -> Steps[str]:
        """The same as text in the format LCOV, for genhtml and CI."""
        return (yield from self._fetch("coverage.lcov")).decode()


def _number(plc: int | Numbered) -> int:
    return plc if isinstance(plc, int) else plc.id
