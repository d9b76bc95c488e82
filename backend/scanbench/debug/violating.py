"""Which value left its subrange, and where, when the debugger halts for that."""

from collections.abc import Iterator

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.halt import Found, Left
from scanbench.debug.placed import Placing
from scanbench.engines.debug import Frame
from scanbench.runtime.resource import Resource
from scanbench.symbols.names import names_of
from scanbench.symbols.violations import Violation, read_violations


class Violating:
    """Looks at the list of violations between two statements. Where nobody wants to halt it does nothing."""

    def __init__(self, resource: Resource, placing: Placing) -> None:
        self._resource, self._placing = resource, placing
        self._listens = False
        self._times: dict[int, int] = {}
        """Of each entry how often so far."""
        self._frames: tuple[Frame, ...] = ()
        """The calls that are open in the statement that runs."""

    def begin(self, listens: bool) -> None:
        """Before each run."""
        self._listens, self._frames = listens, ()
        if listens:
            self._times = self._now()

    def statement(self) -> None:
        """Before a statement."""
        if self._listens:
            self._frames = self._resource.loaded.debugged().frames()

    def found(self, breakpoint: Breakpoint) -> Found:
        """The halt after a statement in which something was recorded."""
        new = [each for number, each in enumerate(self._entries()) if each.times != self._times.get(number)]
        self._times = self._now()
        ids = (breakpoint.id,)
        if not new:  # the list is full
            return Found("violation", "a value left its subrange", breakpoint.author, ids)
        one = new[0]
        left = Left(
            one.variable,
            one.value,
            one.low,
            one.high,
            one.instance,
            f"{one.span.file}:{one.span.line}",
            tuple(self._calls()),
            one.target,
        )
        text = "EN_CHECK: ENO was FALSE"
        if one.variable != "EN_CHECK":
            text = f"{one.name} was {one.value}, outside of {one.low}..{one.high}"
        where = one.instance or one.pou
        return Found("violation", f"{text}, at {left.place} in {where}", breakpoint.author, ids, left)

    def _now(self) -> dict[int, int]:
        return {number: each.times for number, each in enumerate(self._entries())}

    def _entries(self) -> tuple[Violation, ...]:
        return read_violations(self._resource.program, self._resource.memory).entries

    def _calls(self) -> Iterator[str]:
        names = names_of(self._resource.program)
        for frame in self._frames:
            instance = names.instance(frame.instance, frame.pou.name) if frame.instance else ""
            span = self._placing.sites.statements[frame.site].span
            yield " ".join(filter(None, (frame.pou.name, instance, f"{span.file}:{span.line}")))
