"""Checks of a project that changes a little from one to the next."""

from collections.abc import Mapping

from scanbench.check.build import Checked, check_sources
from scanbench.plcmodel.model import Model


class Checks:
    """Checks projects one after the other, and remembers the last."""

    def __init__(self) -> None:
        self._last: tuple[dict[str, str], Model, int, Checked] | None = None

    def check(self, sources: Mapping[str, str], model: Model, interval_ns: int) -> Checked:
        """What `check_sources` finds."""
        if self._last is not None:
            files, before, interval, checked = self._last
            if files == sources and before == model and interval == interval_ns:
                return checked
        checked = check_sources(sources, model, interval_ns)
        self._last = (dict(sources), model, interval_ns, checked)
        return checked
