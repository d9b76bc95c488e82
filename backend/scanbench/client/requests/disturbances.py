"""Disturbances, and campaigns of many of them."""

from collections.abc import Sequence
from typing import Generic, Literal, TypeVar

from scanbench.client.asking import Steps, asked, asked_value
from scanbench.client.requests.base import Asks, waited
from scanbench.client.shapes import disturbances as shapes
from scanbench.client.shapes.running import Instance

PlcT = TypeVar("PlcT")
Kind = Literal["flip", "late", "stuck", "result"]


class Disturbances(Asks, Generic[PlcT]):
    """What disturbs the PLC, and who notices it."""

    def _other(self, id: int) -> PlcT:
        """Another PLC of the same server."""
        raise NotImplementedError

    @asked
    def disturb(
        self, kind: Kind, path: str = "", *, bit: int | None = None, site: str = "", scan: int | None = None,
        probability: float = 0, seed: int = 0, scans: int = 1, times: int = 0,
    ) -> Steps[str]:  # fmt: skip
        """Disturbs the PLC in a scan, or in the next one, or with a probability in each scan from then on (`times`: at most so often,
        0 for ever). `flip`: one bit of memory (`bit`: which; else any, by the `seed`). `late`: an input refresh comes so many `scans`
        late. `stuck`: an input stays as it is for so many `scans`. `result`: what the statement at `site` (`Main.st:34`) writes."""
        body: dict[str, object] = {
            "kind": kind, "path": path, "bit": bit, "site": site, "scan": scan, "probability": probability, "seed": seed,
            "scans": scans, "times": times,
        }  # fmt: skip
        return self._command("disturbances", body)

    @asked_value
    def disturbances(self) -> Steps[list[shapes.DisturbanceInfo]]:
        """Those that are not over, and those that never took effect (`state` is `missed`, `why` says why): `id`, `text`, `fired`, ..."""
        return self._get(list[shapes.DisturbanceInfo], "disturbances")

    @asked
    def calm(self, *ids: int) -> Steps[str]:
        """Takes these disturbances back, or all."""
        return self._command("commands", {"type": "calm", "ids": list(ids) or None})

    @asked_value
    def campaigns(self) -> Steps[list[shapes.CampaignState]]:
        """The campaigns of this PLC, the newest first."""
        return self._get(list[shapes.CampaignState], "campaigns")

    @asked
    def begin_campaign(
        self, count: int = 100, *, seed: int = 1, first: int | None = None, last: int | None = None, window: int = 100,
        kinds: Sequence[Kind] = ("flip", "result", "stuck", "late"), alarms: Sequence[str] = (),
    ) -> Steps[int]:  # fmt: skip
        """Begins to try so many random disturbances on the recorded run, each alone, in scans `first` to `last` (else in its last 500);
        the campaign's number. Each has `window` scans to be noticed; `alarms`: conditions that say that the program has."""
        body = {
            "count": count, "seed": seed, "first": first, "last": last, "window": window, "kinds": list(kinds),
            "alarms": list(alarms),
        }  # fmt: skip
        return (yield from self._send(shapes.CampaignState, "POST", "campaigns", body))["id"]

    @asked
    def campaign(self, number: int) -> Steps[shapes.WholeCampaign]:
        """A campaign as it is now: its `state` (`done`, `of`, `over`, `outcomes`, `silent`, `message`), and the `trials` so far."""
        return self._campaign(number)

    @asked
    def wait_for_campaign(self, number: int, timeout_s: float = 600.0) -> Steps[shapes.WholeCampaign]:
        """The campaign when it is over; its state's `message` says why it did not come to its end, if it did not. `TimeoutError` when it
        is not over by then, and goes on."""
        return waited(
            lambda: self._campaign(number), lambda now: not now["state"]["over"], timeout_s,
            lambda now: f"campaign {number} still runs: {now['state']['done']} of {now['state']['of']}",
        )  # fmt: skip

    @asked
    def export_campaign(
        self, number: int, format: Literal["json", "junit"] = "json", require: Literal["any", "program"] = "any"
    ) -> Steps[bytes]:
        """The campaign as `scanbench campaign` writes it: as JSON, or as JUnit, in which a disturbance fails that did harm and nobody, or
        (`require="program"`) not the program, noticed."""
        return self._fetch(f"/api/campaigns/{number}/export", format=format, require=require)

    @asked
    def open_trial(self, number: int, trial: int) -> Steps[PlcT]:
        """A new paused PLC that goes on with the run as this disturbance of the campaign made it."""
        made = yield from self._send(Instance, "POST", f"/api/campaigns/{number}/trials/{trial}/open")
        return self._other(made["id"])

    @asked
    def delete_campaign(self, number: int) -> Steps[None]:
        """Cancels a campaign, or deletes its result."""
        return self._send(type(None), "DELETE", f"/api/campaigns/{number}")

    def _campaign(self, number: int) -> Steps[shapes.WholeCampaign]:
        return self._get(shapes.WholeCampaign, f"/api/campaigns/{number}")
