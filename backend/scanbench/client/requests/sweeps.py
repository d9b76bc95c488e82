"""Sweeps: each error raised alone, from states of the program."""

from collections.abc import Sequence

from scanbench.client.asking import Steps, asked
from scanbench.client.requests.base import Asks, waited
from scanbench.client.shapes import sweeps as shapes


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

    def _sweep(self, number: int) -> Steps[shapes.Sweep]:
        return self._get(shapes.Sweep, f"/api/sweeps/{number}")
