"""Verifications: a second execution of what ran, of the past, or of what a controller recorded."""

from collections.abc import Sequence
from typing import Literal

from scanbench.client.asking import Refused, Steps, asked, asked_value
from scanbench.client.requests.base import Asks, waited
from scanbench.client.shapes import verification as shapes
from scanbench.client.shapes.running import Instance

Pace = Literal["free", "scan", "step"]
Verdict = Literal["differs", "same", "same in what was compared", "nothing compared"]
_OVER = ("stopped", "done", "failed")


def verdict(found: shapes.VerificationInfo) -> Verdict:
    """What a verification says so far. `same` only where every scan that was asked for was compared, of a controller log all that it has; what
    was left out is in `skipped`, `stretches`, `message` and `coverage`."""
    return found["verdict"]


class Verifications(Asks):
    """A verification has a number; everybody at the PLC sees it."""

    @asked_value
    def verifications(self) -> Steps[list[shapes.VerificationInfo]]:
        """The verifications of this PLC, the oldest first."""
        return self._get(list[shapes.VerificationInfo], "verifications")

    @asked
    def begin_verification(
        self, first: int | None = None, last: int | None = None, *, pou: str = "", file: str = "",
        lines: tuple[int, int] = (0, 0), instance: str = "", pace: Pace = "free", limit: int = 4096,
    ) -> Steps[int]:  # fmt: skip
        """Begins to verify scans `first` to `last` of the past (without `last`: to the one that was over last), or, without both, live
        from the next scan on; the verification's number. Of the whole scan, or of a POU, or of `lines` of a file (both included)."""
        body = {
            "range": _range(pou, file, lines, instance), "pace": pace, "first": first, "last": last, "limit": limit,
        }  # fmt: skip
        return (yield from self._send(shapes.VerificationInfo, "POST", "verifications", body))["id"]

    @asked
    def upload_trace(self, data: bytes, name: str) -> Steps[shapes.UploadedTrace]:
        """Gives the server a controller's log (see docs/trace-format.md): its `columns`, a `mapping` that is proposed, `problems`."""
        path = yield from self._of_project("traces")
        return (yield from self._send(shapes.UploadedTrace, "POST", path, data, name=name))

    @asked
    def connect_controller(
        self, address: str, *, interval_ms: int = 100, nodes: Sequence[str] = (), user: str = "", password: str = ""
    ) -> Steps[shapes.UploadedTrace]:  # fmt: skip
        """Asks a controller that runs (opc.tcp://HOST:PORT) what it has to read. Give it to
        `begin_trace_verification`: then it is read every so many ms, and compared while it runs."""
        project = (yield from self._get(Instance, ""))["project"]["id"]
        body = {
            "address": address, "interval_ms": interval_ms, "nodes": list(nodes), "user": user, "password": password,
        }  # fmt: skip
        return (yield from self._send(shapes.UploadedTrace, "POST", f"/api/projects/{project}/controllers", body))

    @asked
    def begin_trace_verification(
        self, trace: shapes.UploadedTrace, mapping: shapes.TraceMapping | None = None, *, pou: str = "", file: str = "",
        lines: tuple[int, int] = (0, 0), instance: str = "", limit: int = 4096,
    ) -> Steps[int]:  # fmt: skip
        """Begins to verify an uploaded log with the program that runs, by this mapping or the one that was proposed; the
        verification's number. `Refused` where the file has problems."""
        if trace["problems"]:
            raise Refused("; ".join(each["message"] for each in trace["problems"]))
        body = {
            "file": trace["file"], "mapping": trace["mapping"] if mapping is None else mapping,
            "range": _range(pou, file, lines, instance), "limit": limit,
        }  # fmt: skip
        return (yield from self._send(shapes.VerificationInfo, "POST", "trace-verifications", body))["id"]

    @asked
    def verification(self, number: int) -> Steps[shapes.VerificationInfo]:
        """How far it is, and what was compared: `state`, scans `compared` and `skipped` (`stretches`: which), rows that are `differing`,
        `first_difference` and its scan, of a trace the `coverage`. `verdict` puts it together."""
        return self._verification(number)

    @asked
    def wait_for_verification(self, number: int, timeout_s: float = 600.0) -> Steps[shapes.VerificationInfo]:
        """A verification of the past or of a trace when it is over. `TimeoutError` when it is not by then, and goes on; so does a live
        one until `stop_verification`."""
        return waited(
            lambda: self._verification(number), lambda now: now["state"] not in _OVER, timeout_s,
            lambda now: f"verification {number} is {now['state']}: {now['compared']} scans compared",
        )  # fmt: skip

    @asked
    def wait_for_scan(self, number: int, scan: int, timeout_s: float = 600.0) -> Steps[shapes.VerificationInfo]:
        """A live verification when it has verified this scan, or is over before. `TimeoutError` when neither comes true by then."""
        return waited(
            lambda: self._verification(number),
            lambda now: now["state"] not in _OVER and (now["scan"] is None or now["scan"] < scan), timeout_s,
            lambda now: f"verification {number} is {now['state']}, at scan {now['scan']}",
        )  # fmt: skip

    @asked
    def stop_verification(self, number: int) -> Steps[shapes.VerificationInfo]:
        """Stops it; what it found is kept."""
        return self._drive_verification(number, {"action": "stop"})

    @asked
    def resume_verification(self, number: int) -> Steps[shapes.VerificationInfo]:
        """Goes on with one that was stopped."""
        return self._drive_verification(number, {"action": "resume"})

    @asked
    def drive_verification(
        self, number: int, *, pace: Pace | None = None, memory: Literal["recorded", "set"] | None = None,
        auto: bool | None = None,
    ) -> Steps[shapes.VerificationInfo]:  # fmt: skip
        """Changes its pace, whether it goes on by itself (`auto`), or the data that the monitor runs on; what is None stays."""
        return self._drive_verification(number, {"pace": pace, "memory": memory, "auto": auto})

    @asked
    def go_on(self, number: int) -> Steps[shapes.VerificationInfo]:
        """Paces `scan` and `step`: verifies one scan or statement more."""
        return self._drive_verification(number, {"action": "go_on"})

    @asked
    def verification_rows(
        self, number: int, first: int = 0, count: int = 200, differing: bool = False
    ) -> Steps[shapes.VerifyRows]:
        """Rows from the index `first` on, at most 500, or of those that differ only: for each scan or pass its inputs, and its outputs A
        (`control`) and A' (`monitor`), as bytes in hex; `columns` have their names and types."""
        path = f"/api/verifications/{number}/rows"
        return self._get(shapes.VerifyRows, path, first=first, count=count, differing=differing)

    @asked
    def verification_uses(self, number: int, scan: int, call: int = 1) -> Steps[list[shapes.VerifyUse]]:
        """The variables that a row used, in the order of use: name, whether it was written, A and A', and where."""
        path = f"/api/verifications/{number}/uses"
        return self._get(list[shapes.VerifyUse], path, scan=scan, call=call)

    @asked
    def set_cells(self, number: int, cells: Sequence[shapes.SetCell]) -> Steps[shapes.VerificationInfo]:
        """Edits inputs of the set data (an empty `value` takes an edit back), on which the monitor runs those passes again."""
        path = f"/api/verifications/{number}/cells"
        return self._send(shapes.VerificationInfo, "POST", path, {"cells": list(cells)})

    @asked
    def export_verification(self, number: int, format: Literal["csv", "json", "html", "junit"] = "csv") -> Steps[bytes]:
        """All rows that are kept, as a file."""
        return self._fetch(f"/api/verifications/{number}/export", format=format)

    @asked
    def keep_verification(self, number: int, name: str) -> Steps[shapes.VerificationRecord]:
        """Keeps it in the project, as it is now."""
        return self._send(shapes.VerificationRecord, "POST", f"/api/verifications/{number}/keep", {"name": name})

    @asked_value
    def kept_verifications(self) -> Steps[list[shapes.VerificationRecord]]:
        """The verifications that are kept in the project of this PLC, the newest first."""
        path = yield from self._of_project("verification-records")
        return (yield from self._get(list[shapes.VerificationRecord], path))

    @asked
    def kept_rows(
        self, record: int, first: int = 0, count: int = 200, differing: bool = False
    ) -> Steps[shapes.VerifyRows]:
        """The rows of a kept verification, as `verification_rows` has them."""
        path = f"/api/verification-records/{record}/rows"
        return self._get(shapes.VerifyRows, path, first=first, count=count, differing=differing)

    @asked
    def export_kept(self, record: int, format: Literal["csv", "json", "html", "junit"] = "csv") -> Steps[bytes]:
        """The rows of a kept verification, as a file."""
        return self._fetch(f"/api/verification-records/{record}/export", format=format)

    @asked
    def delete_kept_verification(self, record: int) -> Steps[None]:
        """Deletes a kept verification."""
        return self._send(type(None), "DELETE", f"/api/verification-records/{record}")

    @asked_value
    def trace_mappings(self) -> Steps[list[shapes.SavedMapping]]:
        """The mappings of controller logs that are saved in the project of this PLC."""
        path = yield from self._of_project("trace-mappings")
        return (yield from self._get(list[shapes.SavedMapping], path))

    @asked
    def save_trace_mapping(self, name: str, mapping: shapes.TraceMapping) -> Steps[shapes.SavedMapping]:
        """Saves a mapping in the project; one of the same name is replaced."""
        path = yield from self._of_project("trace-mappings")
        return (yield from self._send(shapes.SavedMapping, "POST", path, {"name": name, "mapping": mapping}))

    @asked
    def delete_trace_mapping(self, number: int) -> Steps[None]:
        """Deletes a mapping that was saved."""
        return self._send(type(None), "DELETE", f"/api/trace-mappings/{number}")

    @asked
    def delete_verification(self, number: int) -> Steps[None]:
        """Ends it and deletes its rows."""
        return self._send(type(None), "DELETE", f"/api/verifications/{number}")

    def _of_project(self, what: str) -> Steps[str]:
        project = (yield from self._get(Instance, ""))["project"]["id"]
        return f"/api/projects/{project}/{what}"

    def _verification(self, number: int) -> Steps[shapes.VerificationInfo]:
        return self._get(shapes.VerificationInfo, f"/api/verifications/{number}")

    def _drive_verification(self, number: int, drive: object) -> Steps[shapes.VerificationInfo]:
        return self._send(shapes.VerificationInfo, "PATCH", f"/api/verifications/{number}", drive)


def _range(pou: str, file: str, lines: tuple[int, int], instance: str) -> object:
    return {"pou": pou, "file": file, "first": lines[0], "last": lines[1], "instance": instance}
