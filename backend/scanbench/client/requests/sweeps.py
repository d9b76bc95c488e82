"""Sweeps: each error raised alone, from states of the program."""

from collections.abc import Sequence

from scanbench.client.asking import Steps, asked
from scanbench.client.requests.base import Asks, waited
from scanbench.client.shapes import sweeps as shapes
from scanbench.client.shapes.running import Instance


class Sweeps(Asks):
    """How the program reacts to errors of the model."""

    @asked
    def keep_state(self, name: str, scan: int | None = None) -> Steps[int]:
        """Keeps the PLC as it is now, or was before a scan, for sweeps; its number."""
        return (yield from self._send(shapes.ProgramState, "POST", "states", {"name": name, "scan": scan}))["id"]

    @asked
    def begin_sweep(
        self, errors: Sequence[str] | None = None, states: Sequence[int] = (), window: int = 200
    ) -> Steps[int]:
        """Begins to raise these errors, or all, each alone, from these states, or from now; the sweep's number. `window`: scans."""
        body = {"errors": None if errors is None else list(errors), "states": list(states), "window": window}
        return (yield from self._send(shapes.SweepSummary, "POST", "sweeps", body))["id"]

    @asked
    def sweep(self, number: int) -> Steps[shapes.Sweep]:
        """A sweep as it is now: `status` (`running`, `done`, ...) and more, `cells` with a verdict each."""
        return self._sweep(number)

    @asked
    def wait_for_sweep(self, number: int, timeout_s: float = 600.0) -> Steps[shapes.Sweep]:
        """The sweep when it is over; `TimeoutError` when it is not by then, and goes on."""
        return waited(
            lambda: self._sweep(number), lambda now: now["status"] == "running", timeout_s,
            lambda now: f"sweep {number} still runs: {now['done']} of {now['total']}",
        )  # fmt: skip

    @asked
    def cancel_sweep(self, number: int) -> Steps[shapes.SweepSummary]:
        """Stops a sweep; what it found is kept."""
        return self._send(shapes.SweepSummary, "POST", f"/api/sweeps/{number}/cancel")

    @asked
    def resume_sweep(self, number: int) -> Steps[shapes.SweepSummary]:
        """Goes on with the cells that are missing."""
        return self._send(shapes.SweepSummary, "POST", f"/api/sweeps/{number}/resume")

    @asked
    def delete_sweep(self, number: int) -> Steps[None]:
        """Deletes a sweep; one that is running is cancelled."""
        return self._send(type(None), "DELETE", f"/api/sweeps/{number}")

    @asked
    def sweep_reaction(self, number: int, error: str, state: str) -> Steps[shapes.Reaction]:
        """The whole result of one cell."""
        return self._send(shapes.Reaction, "POST", f"/api/sweeps/{number}/reaction", {"error": error, "state": state})

    @asked
    def open_case(self, number: int, error: str, state: str, name: str) -> Steps[int]:
        """A new PLC in this state with this error raised, paused: to look at what the sweep saw; its number."""
        body = {"error": error, "state": state, "name": name}
        return (yield from self._send(Instance, "POST", f"/api/sweeps/{number}/open", body))["id"]

    @asked
    def delete_state(self, number: int) -> Steps[None]:
        """Deletes a state that was kept."""
        return self._send(type(None), "DELETE", f"/api/states/{number}")

    @asked
    def accept_finding(self, number: int, error: str, state: str, reason: str) -> Steps[shapes.Accepted]:
        """Accepts what a sweep found, for this and later sweeps of the project; the test record lists it with the reason."""
        body = {"error": error, "state": state, "reason": reason}
        return self._send(shapes.Accepted, "POST", f"/api/sweeps/{number}/accept", body)

    @asked
    def withdraw_finding(self, number: int, error: str, state: str) -> Steps[None]:
        """Withdraws that a finding was accepted."""
        return self._send(type(None), "POST", f"/api/sweeps/{number}/withdraw", {"error": error, "state": state})

    @asked
    def compare_sweeps(self, before: int, after: int) -> Steps[shapes.SweepComparison]:
        """What became better or worse from one sweep to the next: of two versions of the program, or of two models."""
        return self._get(shapes.SweepComparison, f"/api/sweeps/{before}/compare/{after}")

    def _sweep(self, number: int) -> Steps[shapes.Sweep]:
        return self._get(shapes.Sweep, f"/api/sweeps/{number}")
