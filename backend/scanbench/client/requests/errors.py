"""Errors: raise and recover them, arm them, read what the device says, clear it as a tool does."""

from collections.abc import Mapping
from typing import Literal
from urllib.parse import quote

from scanbench.client.asking import Steps, asked, asked_value
from scanbench.client.requests.base import Asks, Value
from scanbench.client.shapes import errors as shapes
from scanbench.client.shapes.sweeps import Reaction


class Errors(Asks):
    """The simulator's errors, and the memory of the device."""

    @asked
    def raise_error(self, /, error: str, **details: Value) -> Steps[str]:
        """Raises an error of the model's catalogue."""
        return self._command("errors/generate", {"errors": [_error(error, details)]})

    @asked
    def preview(self, /, error: str, **details: Value) -> Steps[shapes.PreviewedErrors]:
        """What raising it would write now; nothing is changed."""
        return self._send(shapes.PreviewedErrors, "POST", "errors/preview", {"errors": [_error(error, details)]})

    @asked
    def recover(self, *errors: str) -> Steps[str]:
        """Recovers these errors, or all."""
        return self._command("errors/recover", {"ids": list(errors) or None})

    @asked
    def reaction(self, error: str) -> Steps[Reaction]:
        """How the program reacted the last time that this error was raised: `verdict`, `required` (each with `text`, `outcome`, `scan`
        and `values`), `restarts` and more. Known when its window is over."""
        return self._get(Reaction, f"errors/{quote(error)}/reaction")

    @asked_value
    def errors(self) -> Steps[list[shapes.ErrorHistoryRow]]:
        """The error history, in the order of the catalogue: which errors were raised in this version, and with what verdict."""
        return self._get(list[shapes.ErrorHistoryRow], "errors")

    @asked_value
    def history_versions(self) -> Steps[list[shapes.HistoryVersion]]:
        """The versions of the program that have an error history here, the newest first."""
        return self._get(list[shapes.HistoryVersion], "history/versions")

    @asked
    def history(self, version: int | None = None) -> Steps[shapes.HistoryOfVersion]:
        """The error history of a version of the program, or of the one that runs."""
        return self._get(shapes.HistoryOfVersion, "history", version=version)

    @asked
    def test_record(
        self, format: Literal["csv", "html", "xml", "json"] = "html", version: int | None = None
    ) -> Steps[bytes]:
        """The test record of a version of the program, or of the one that runs, as a file."""
        return self._fetch("record", format=format, version=version)

    @asked
    def clear(self, what: str | int = "current") -> Steps[str]:
        """Clears errors as a tool does it on the device: `current` (the most serious), `all`, or that of a code. What the
        simulator raised and whose cause lasts stays: `recover` it."""
        return self._command("errors/clear", {"what": what})

    @asked_value
    def device(self) -> Steps[shapes.DeviceErrors]:
        """What a tool reads from the PLC's memory at the scan that is shown: `errors` that are present, its own `log`,
        `messages`, the `code` in its code word. Whoever caused it: a program, a protocol client, the simulator."""
        return self._device()

    @asked_value
    def present(self) -> Steps[list[shapes.DeviceError]]:
        """The errors that the memory shows, the most serious first: `id`, `code`, `severity`, `name`, `text`, `details`."""
        return (yield from self._device())["errors"]

    @asked_value
    def error_log(self) -> Steps[list[shapes.DeviceRecord]]:
        """The device's own error log, the newest record first: `time`, `code`, `id`, `name`, `details`, `contents`."""
        return (yield from self._device())["log"]

    @asked
    def clear_log(self) -> Steps[str]:
        """Empties the device's own error log, as a tool does it on the device."""
        return self._command("errors/log/clear", {})

    @asked
    def arm(
        self, /, error: str, *, start: Mapping[str, object] | shapes.FaultStart | None = None,
        shape: Mapping[str, object] | shapes.FaultShape | None = None, **details: Value,
    ) -> Steps[str]:  # fmt: skip
        """Raises an error later, or again and again: `start={"kind": "scan", "scan": 500}`,
        `shape={"kind": "for", "scans": 5}`."""
        body: dict[str, object] = {"errors": [_error(error, details)]}
        if start is not None:
            body["start"] = start
        if shape is not None:
            body["shape"] = shape
        return self._command("errors/arm", body)

    @asked_value
    def armed(self) -> Steps[list[shapes.ArmedFault]]:
        """The faults that are armed and not over: `id`, `errors`, `text`, `state`, `next_scan` and more."""
        return self._get(list[shapes.ArmedFault], "errors/armed")

    @asked
    def disarm(self, *ids: int) -> Steps[str]:
        """Takes these armed faults back, or all; what they raised is recovered."""
        return self._command("errors/disarm", {"ids": list(ids) or None})

    def _device(self) -> Steps[shapes.DeviceErrors]:
        return self._get(shapes.DeviceErrors, "errors/device")


def _error(id: str, details: Mapping[str, Value]) -> object:
    return {"id": id, "details": {name: str(value) for name, value in details.items()}}
