"""Values: read, write, force."""

from scanbench.client.asking import Steps, asked, asked_value
from scanbench.client.requests.base import Asks, Value, typed
from scanbench.client.shapes import running as shapes


class Values(Asks):
    """Values come and go as they are typed in the watch table: `TRUE`, `42`, `T#5s`, `'text'`."""

    @asked
    def read(self, path: str) -> Steps[str]:
        """The value of a variable, an address or an expression of ST, at the scan that is shown."""
        return (yield from self._get(shapes.Value, "value", path=path))["value"]

    @asked
    def write(self, path: str, value: Value, site: str = "") -> Steps[str]:
        """Writes once; the answer says where it went. Of an in-out: to what its block was given last, or, with `site`
        (`Main.st:12`), to what that call passes."""
        return self._command("write", {"path": path, "value": typed(value), "site": site})

    @asked
    def force(self, path: str, value: Value, site: str = "") -> Steps[str]:
        """Holds a variable until it is released; `site` as with `write`."""
        return self._force(path, value, site)

    @asked
    def release(self, path: str | None = None) -> Steps[str]:
        """Ends a force, or all."""
        return self._release(path)

    @asked_value
    def forces(self) -> Steps[list[shapes.ForceInfo]]:
        """The forces that hold: `path`, `value`, `author`, what the program made of it, and more."""
        return self._get(list[shapes.ForceInfo], "forces")

    @asked
    def symbols(self, path: str = "") -> Steps[list[shapes.Symbol]]:
        """The members below a path; programs and globals below ''."""
        return self._get(list[shapes.Symbol], "symbols", path=path)

    @asked
    def binding(self, path: str) -> Steps[shapes.Binding]:
        """What an in-out (`Main.valve.level`) is bound to: what its block was given last, and what each call passes."""
        return self._get(shapes.Binding, "binding", path=path)

    def _force(self, path: str, value: Value, site: str) -> Steps[str]:
        return self._command("force", {"path": path, "value": typed(value), "site": site})

    def _release(self, path: str | None) -> Steps[str]:
        return self._command("release", {"path": path})
