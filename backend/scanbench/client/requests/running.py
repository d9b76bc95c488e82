"""How the PLC runs: mode, restart, run, speed, where it is shown; branches and run files."""

from typing import Generic, TypeVar

from scanbench.client.asking import Steps, asked, asked_value
from scanbench.client.requests.base import Asks, waited
from scanbench.client.shapes import running as shapes

PlcT = TypeVar("PlcT")
_GOES_ON = ("starting", "restarting", "silent", "running", "no_space")


class Running(Asks, Generic[PlcT]):
    """Scans, their pace, and what of the run is shown."""

    def _other(self, id: int) -> PlcT:
        """Another PLC of the same server."""
        raise NotImplementedError

    @asked_value
    def state(self) -> Steps[shapes.InstanceState]:
        """The state of the PLC: `state`, `mode`, `scan`, `message`, `speed` (1 is real time, 0 as fast as possible), `past` and more."""
        return self._state()

    @asked
    def mode(self, mode: str) -> Steps[str]:
        """`PROGRAM`, `MONITOR` or `RUN`. A fatal error has to be recovered first."""
        return self._command("mode", {"mode": mode})

    @asked
    def restart(self, kind: str = "warm") -> Steps[str]:
        """`cold`, `warm` or `power` (off and on); afterwards the program runs."""
        return self._command("restart", {"kind": kind})

    @asked
    def run(
        self, scans: int | None = None, until: str | None = None, speed: float | None = None, timeout_s: float = 60.0
    ) -> Steps[str]:
        """Lets it run: for ever; or for so many scans, or until a condition holds, and then this waits for that.

        `TimeoutError` when it did not come to its end by then; it runs on.
        """
        said = yield from self._drive("continue", scans=scans, until=until, speed=speed)
        if scans is None and until is None:
            return said
        state = yield from waited(
            self._state, lambda now: now["state"] in _GOES_ON, timeout_s,
            lambda now: f"{said}: it still runs, at scan {now['scan']}",
        )  # fmt: skip
        return state["message"]

    @asked
    def pause(self) -> Steps[str]:
        """Pauses it after the scan that runs."""
        return self._drive("pause")

    @asked
    def scan(self) -> Steps[str]:
        """Runs one scan."""
        return self._drive("scan")

    @asked
    def speed(self, speed: float) -> Steps[str]:
        """How fast it runs: 1 is real time, 0.01 to 1000 slower or faster, 0 as fast as possible. Whether it runs stays as it is."""
        return self._drive("speed", speed=speed)

    @asked
    def travel(self, scan: int, count: int = 0) -> Steps[str]:
        """Shows everybody the PLC as it was before a scan, or before its statement of this `count`; it waits meanwhile. `read`, `device`
        and `forces` then tell what was. `live` returns."""
        return self._command("travel", {"scan": scan, "count": count})

    @asked
    def live(self) -> Steps[str]:
        """Returns from the past to the scan at which the PLC waits."""
        return self._command("travel", {"scan": None})

    @asked
    def new_run(self) -> Steps[str]:
        """Begins again at scan 0 with an empty past; the run file so far is kept aside on the server."""
        return self._command("new-run", {})

    @asked
    def roll_back(self) -> Steps[str]:
        """Swaps back in the program that ran before the last change."""
        return self._command("roll-back", {})

    @asked
    def log(self, count: int = 1000, first: int | None = None) -> Steps[shapes.LogPage]:
        """Lines of the event log, oldest first: `count` of them (at most 1,000) from the number `first` on, or the last ones."""
        return self._get(shapes.LogPage, "log", count=count, first=first)

    @asked
    def power(self, on: bool) -> Steps[shapes.InstanceState]:
        """Ends the PLC's process, or starts it where it was."""
        return (yield from self._send(shapes.Instance, "PATCH", "", {"power": on}))["state"]

    @asked
    def delete(self) -> Steps[None]:
        """Ends the PLC and deletes it with its run."""
        return self._send(type(None), "DELETE", "")

    @asked
    def branch(self, name: str, scan: int | None = None) -> Steps[PlcT]:
        """A new PLC that begins as this one was before a scan, or is now."""
        made = yield from self._send(shapes.Instance, "POST", "branch", {"name": name, "scan": scan})
        return self._other(made["id"])

    @asked
    def export_run(self, scan: int | None = None) -> Steps[bytes]:
        """The run as a run file, which replays byte for byte elsewhere: up to before a scan, or until now. `Server.take_run` takes it."""
        return self._fetch("export", scan=scan)

    def _state(self) -> Steps[shapes.InstanceState]:
        return (yield from self._get(shapes.Instance, ""))["state"]

    def _drive(
        self, action: str, scans: int | None = None, until: str | None = None, speed: float | None = None
    ) -> Steps[str]:
        return self._command("run", {"action": action, "scans": scans, "until": until, "speed": speed})
