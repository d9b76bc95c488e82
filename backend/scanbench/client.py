"""A PLC of a running server, for scripts and tests in Python.

    from scanbench.client import connect

    plc = connect("http://127.0.0.1:8700/?token=...").plc("line-1")
    plc.write("Main.buffer.level", 3)     # an in-out goes to what it is bound to; the answer says where
    assert plc.read("bufferLevel") == "3"
    with plc.forced("D100", 5):
        plc.run(scans=10)

Everything goes through the server's REST API, and so through the one door: the journal names you. Values come and go as
they are typed in the watch table: `TRUE`, `42`, `T#5s`, `'text'`.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from threading import Event
from urllib.error import HTTPError
from urllib.parse import parse_qs, quote, urlencode, urlsplit
from urllib.request import Request, urlopen

from scanbench.runtime.clock import monotonic_ns

Json = None | bool | int | float | str | list["Json"] | dict[str, "Json"]
Value = str | int | float | bool

_TIMEOUT_S = 60
_LOOK_S = 0.02
_GOES_ON = ("starting", "restarting", "silent", "running", "no_space")


class Refused(Exception):
    """The server refused; the message says what to do, `near` names what was perhaps meant."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.near = near


class Server:
    """A running server."""

    def __init__(self, address: str, token: str, user: str) -> None:
        """See `connect`."""
        self._address, self._token, self._user = address.rstrip("/"), token, user

    def plcs(self) -> Mapping[str, int]:
        """Instances by name, with their numbers."""
        answer = self.ask("GET", "/api")
        assert isinstance(answer, dict)
        found = answer["instances"]
        assert isinstance(found, list)
        return {str(each["name"]): int(str(each["id"])) for each in found if isinstance(each, dict)}

    def plc(self, name: str | int) -> "Plc":
        """The instance of this name or number."""
        if isinstance(name, int):
            return Plc(self, name)
        known = self.plcs()
        if name not in known:
            raise Refused(f"there is no instance `{name}`", tuple(known))
        return Plc(self, known[name])

    def take_run(self, run: bytes, name: str) -> "Plc":
        """A new PLC, of this name or the next one that is free, which goes on with the run of an exported file."""
        taken = self.plcs()
        free = next(each for each in (name, *(f"{name} {n}" for n in range(2, len(taken) + 3))) if each not in taken)
        made = self.ask("POST", f"/api/instances/import?{urlencode({'name': free[:100]})}", run)
        assert isinstance(made, dict)
        return Plc(self, int(str(made["id"])))

    def link(self, path: str) -> str:
        """The address of a page of this server, for a browser that was not there before."""
        return f"{self._address}{path}?{urlencode({'token': self._token})}"

    def ask(self, method: str, path: str, body: Json | bytes = None) -> Json:
        """One request; bytes go as they are. `Refused` when the server says no, `OSError` when there is none."""
        request = Request(self._address + path, method=method)
        request.add_header("Authorization", f"Bearer {self._token}")
        request.add_header("Cookie", f"scanbench_user={quote(self._user)}")
        if isinstance(body, bytes):
            request.data = body
        elif body is not None:
            request.add_header("Content-Type", "application/json")
            request.data = json.dumps(body).encode()
        try:
            with urlopen(request, timeout=_TIMEOUT_S) as answer:
                return _json(answer.read())
        except HTTPError as error:
            told = _json(error.read())
            if not isinstance(told, dict) or "message" not in told:
                raise
            near = told.get("near")
            raise Refused(str(told["message"]), tuple(map(str, near)) if isinstance(near, list) else ()) from None


class Plc:
    """One virtual PLC."""

    def __init__(self, server: Server, id: int) -> None:
        self._server, self._base, self._id = server, f"/api/instances/{id}", id

    def read(self, path: str) -> str:
        """The value of a variable, an address or an expression of ST."""
        answer = self._server.ask("GET", f"{self._base}/value?{urlencode({'path': path})}")
        assert isinstance(answer, dict)
        return str(answer["value"])

    def write(self, path: str, value: Value, site: str = "") -> str:
        """Writes once; the answer says where it went. Of an in-out: to what its block was given last, or, with `site`
        (`Main.st:12`), to what that call passes."""
        return self._command("write", {"path": path, "value": _typed(value), "site": site})

    def force(self, path: str, value: Value, site: str = "") -> str:
        """Holds a variable until it is released; `site` as with `write`."""
        return self._command("force", {"path": path, "value": _typed(value), "site": site})

    def release(self, path: str | None = None) -> str:
        """Ends a force, or all."""
        return self._command("release", {"path": path})

    @contextmanager
    def forced(self, path: str, value: Value, site: str = "") -> Iterator[None]:
        """Forced inside of a `with`."""
        self.force(path, value, site)
        try:
            yield
        finally:
            self.release(path)

    def raise_error(self, error: str, **details: Value) -> str:
        """Raises an error of the model's catalogue."""
        return self._command("errors/generate", {"errors": [_error(error, details)]})

    def recover(self, *errors: str) -> str:
        """Recovers these errors, or all."""
        return self._command("errors/recover", {"ids": list(errors) or None})

    def reaction(self, error: str) -> Mapping[str, Json]:
        """How the program reacted the last time that this error was raised: `verdict`, `required` (each with `text`, `outcome`, `scan`
        and `values`), `restarts` and more. Known when its window is over."""
        answer = self._server.ask("GET", f"{self._base}/errors/{quote(error)}/reaction")
        assert isinstance(answer, dict)
        return answer

    def clear(self, what: str | int = "current") -> str:
        """Clears errors as a tool does it on the device: `current` (the most serious), `all`, or that of a code. What the
        simulator raised and whose cause lasts stays: `recover` it."""
        return self._command("errors/clear", {"what": what})

    @property
    def device(self) -> Mapping[str, Json]:
        """What a tool reads from the PLC's memory at the scan that is shown: `errors` that are present, its own `log`,
        `messages`, the `code` in its code word. Whoever caused it: a program, a protocol client, the simulator."""
        answer = self._server.ask("GET", f"{self._base}/errors/device")
        assert isinstance(answer, dict)
        return answer

    @property
    def present(self) -> Sequence[Mapping[str, Json]]:
        """The errors that the memory shows, the most serious first: `id`, `code`, `severity`, `name`, `text`, `details`."""
        return _objects(self.device["errors"])

    @property
    def error_log(self) -> Sequence[Mapping[str, Json]]:
        """The device's own error log, the newest record first: `time`, `code`, `id`, `name`, `details`, `contents`."""
        return _objects(self.device["log"])

    def clear_log(self) -> str:
        """Empties the device's own error log, as a tool does it on the device."""
        return self._command("errors/log/clear", {})

    def arm(
        self, error: str, *, start: Mapping[str, Json] | None = None, shape: Mapping[str, Json] | None = None,
        **details: Value,
    ) -> str:  # fmt: skip
        """Raises an error later, or again and again: `start={"kind": "scan", "scan": 500}`,
        `shape={"kind": "for", "scans": 5}`. The fields are those of `FaultStart` and `FaultShape` of the REST API."""
        body: dict[str, Json] = {"errors": [_error(error, details)]}
        if start is not None:
            body["start"] = dict(start)
        if shape is not None:
            body["shape"] = dict(shape)
        return self._command("errors/arm", body)

    @property
    def armed(self) -> Sequence[Mapping[str, Json]]:
        """The faults that are armed and not over: `id`, `errors`, `text`, `state`, `next_scan` and more."""
        return _objects(self._server.ask("GET", f"{self._base}/errors/armed"))

    def disarm(self, *ids: int) -> str:
        """Takes these armed faults back, or all; what they raised is recovered."""
        return self._command("errors/disarm", {"ids": list(ids) or None})

    def mode(self, mode: str) -> str:
        """`PROGRAM`, `MONITOR` or `RUN`. A fatal error has to be recovered first."""
        return self._command("mode", {"mode": mode})

    def restart(self, kind: str = "warm") -> str:
        """`cold`, `warm` or `power` (off and on); afterwards the program runs."""
        return self._command("restart", {"kind": kind})

    def run(
        self, scans: int | None = None, until: str | None = None, speed: float | None = None, timeout_s: float = 60.0
    ) -> str:
        """Lets it run: for ever; or for so many scans, or until a condition holds, and then this waits for that.

        `TimeoutError` when it did not come to its end by then; it runs on.
        """
        said = self._command("run", {"action": "continue", "scans": scans, "until": until, "speed": speed})
        if scans is None and until is None:
            return said
        end = monotonic_ns() + int(timeout_s * 1e9)
        while (state := self.state)["state"] in _GOES_ON:
            if monotonic_ns() > end:
                raise TimeoutError(f"{said}: it still runs, at scan {state['scan']}")
            Event().wait(_LOOK_S)
        return str(state["message"])

    def pause(self) -> str:
        """Pauses it after the scan that runs."""
        return self._command("run", {"action": "pause"})

    def scan(self) -> str:
        """Runs one scan."""
        return self._command("run", {"action": "scan"})

    def keep_state(self, name: str, scan: int | None = None) -> int:
        """Keeps the PLC as it is now, or was before a scan, for sweeps; its number."""
        answer = self._server.ask("POST", f"{self._base}/states", {"name": name, "scan": scan})
        assert isinstance(answer, dict)
        return int(str(answer["id"]))

    def begin_sweep(self, errors: Sequence[str] | None = None, states: Sequence[int] = (), window: int = 200) -> int:
        """Begins to raise these errors, or all, each alone, from these states, or from now; the sweep's number."""
        body: dict[str, Json] = {
            "errors": None if errors is None else list(errors), "states": list(states), "window": window,
        }  # fmt: skip
        answer = self._server.ask("POST", f"{self._base}/sweeps", body)
        assert isinstance(answer, dict)
        return int(str(answer["id"]))

    def sweep(self, number: int) -> Mapping[str, Json]:
        """A sweep as it is now: `status` (`running`, `done`, ...) and more, `cells` with a verdict each."""
        answer = self._server.ask("GET", f"/api/sweeps/{number}")
        assert isinstance(answer, dict)
        return answer

    def wait_for_sweep(self, number: int, timeout_s: float = 600.0) -> Mapping[str, Json]:
        """The sweep when it is over; `TimeoutError` when it is not by then, and goes on."""
        end = monotonic_ns() + int(timeout_s * 1e9)
        while (found := self.sweep(number))["status"] == "running":
            if monotonic_ns() > end:
                raise TimeoutError(f"sweep {number} still runs: {found.get('done')} of {found.get('total')}")
            Event().wait(_LOOK_S)
        return found

    def link(self, scan: int | None = None) -> str:
        """The address of this PLC for a browser, as it is now or as it was before a scan."""
        return self._server.link(f"/i/{self._id}" if scan is None else f"/i/{self._id}/scan/{scan}")

    @property
    def state(self) -> Mapping[str, Json]:
        """The state of the PLC: `state`, `mode`, `scan`, `message` and more."""
        answer = self._server.ask("GET", self._base)
        assert isinstance(answer, dict)
        state = answer["state"]
        assert isinstance(state, dict)
        return state

    def _command(self, what: str, body: dict[str, Json]) -> str:
        answer = self._server.ask("POST", f"{self._base}/{what}", body)
        assert isinstance(answer, dict)
        return str(answer["message"])


def connect(address: str, token: str = "", user: str = "script") -> Server:
    """A server by the address that it prints, which has the token in it."""
    parts = urlsplit(address if "//" in address else f"http://{address}")
    given = token or parse_qs(parts.query).get("token", [""])[0]
    return Server(f"{parts.scheme}://{parts.netloc}", given, user)


def _objects(answer: Json) -> list[dict[str, Json]]:
    assert isinstance(answer, list)
    return [each for each in answer if isinstance(each, dict)]


def _error(id: str, details: Mapping[str, Value]) -> Json:
    return {"id": id, "details": {name: str(value) for name, value in details.items()}}


def _typed(value: Value) -> str:
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    return str(value)


def _json(data: bytes) -> Json:
    found: Json = json.loads(data) if data else None
    return found
