"""The debug side of a PLC that runs: who listens to the debug flavour, who is told what code notes, where a scan is halted."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from scanbench.engines.debug import NOTHING, Listen
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.observe import Observed, Observer, Seen
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.header import Header
from scanbench.runtime.inside import Inside, Insider, Onlooker, Passage
from scanbench.runtime.programs import Loaded


@dataclass(frozen=True, slots=True)
class _Observing:
    """Observed code of the program that runs."""

    loaded: Loaded
    engine: Engine
    observer: Observer


@dataclass(frozen=True, slots=True)
class Within:
    """What is entered inside of the scan that runs."""

    waiting: Sequence[Entry]
    """Entries that the journal has already."""
    again: Callable[[Entry], object]
    """Enters one of them."""
    insider: Insider | None
    enter: Callable[[Command, int], None]
    """Enters what the insider wants before the statement of this count."""


class Listening:
    """Which flavour of a program's code runs in place of the ordinary one, and who is called from it."""

    def __init__(self, loaded: Loaded) -> None:
        self._loaded = loaded
        self._hook: Onlooker | None = None
        self._listen = NOTHING
        self._passage: Passage | None = None
        self._observing: _Observing | None = None
        self._probed: Engine | None = None
        self._reached: set[int] = set()
        self._on_seen: Callable[[Seen], None] | None = None
        self._on_trap: Callable[[], bool] | None = None
        self._on_probe: Callable[[], None] | None = None
        self.inside: Inside | None = None
        """The position at which the next scan is halted, to which the image belongs; None if it is not halted."""

    # ---- who listens ----------------------------------------------------------------------------------------------

    @property
    def hook(self) -> Onlooker | None:
        """Who listens to the debug flavour: while somebody does, it runs."""
        return self._hook

    def attach(self, hook: Onlooker | None, listen: Listen | None = None) -> None:
        """`hook` listens from the next run on, for `listen`, or for what was listened for before; None: nobody does."""
        self._hook = hook
        if listen is not None:
            self.listen(listen)

    @contextmanager
    def instead(self, hook: Onlooker | None, listen: Listen | None = None) -> Iterator[None]:
        """`attach` for a while: then the one before listens again, for what it listened for."""
        before = self._hook, self._listen
        self.attach(hook, listen)
        try:
            yield
        finally:
            self._hook, self._listen = before

    def listen(self, listen: Listen) -> None:
        """What the hook is called for, from now on: also from the hook."""
        self._listen = listen
        if self._passage is not None:
            self._passage.listen(listen)

    def call(self, on_trap: Callable[[], bool], on_probe: Callable[[], None]) -> None:
        """Whom to call. `on_trap` is asked before a trap stops the program: true says that the scan was gone back to and is
        halted now. `on_probe` is called when a probe was reached, and goes back to where the scan began."""
        self._on_trap, self._on_probe = on_trap, on_probe

    # ---- what code notes ------------------------------------------------------------------------------------------

    @property
    def observing(self) -> bool:
        """Whether observed code runs, as statements are waited for."""
        return self._observing is not None

    def observe(self, make: Callable[[Loaded], Observed] | None) -> None:
        """Observed code runs from now on, which `make` makes of the program, or no longer. The debug flavour notes the same."""
        if make is None or self._hook is not None:
            self._observing = None
        elif self._observing is None or self._observing.loaded is not self._loaded:
            self._observing = _Observing(self._loaded, *make(self._loaded))

    def tell_seen(self, on_seen: Callable[[Seen], None] | None) -> None:
        """Who is told what observed code or the debug flavour notes."""
        self._on_seen = on_seen

    def look(self) -> None:
        """Takes what was noted, and tells who wants to know."""
        observer = self._observer()
        if observer is not None:
            seen = observer.take()
            self._reached |= seen.reached
            if self._on_seen is not None:
                self._on_seen(seen)

    def reached(self, sites: frozenset[int]) -> frozenset[int]:
        """Which of these statements were reached since this was asked last; empty `sites` need no look."""
        if sites:
            self.look()
        found, self._reached = sites & self._reached, set()
        return found

    def _observer(self) -> Observer | None:
        if self._hook is not None:
            return self._loaded.debugged().observer
        return None if self._observing is None else self._observing.observer

    # ---- probes ---------------------------------------------------------------------------------------------------

    @property
    def probed(self) -> Engine | None:
        """Code with probes (`engines.probe`), which runs the program instead of the ordinary one while nobody listens."""
        return self._probed

    def probe(self, engine: Engine | None) -> None:
        """This code with probes runs from now on, or none."""
        self._probed = engine

    def probe_reached(self) -> bool:
        """Whether a scan that halted did so for a probe, and was gone back to."""
        if self.inside is not None or self._on_probe is None:
            return False
        self._on_probe()
        return True

    def takes_over(self) -> bool:
        """Whether a scan that is to run in the debug flavour would miss its probes: whoever wants them listens from now on."""
        if self._probed is None or self._hook is not None or self._on_probe is None:
            return False
        self._on_probe()
        return True

    def trap_taken_back(self) -> bool:
        """Whether somebody wants to halt before the trap, and the scan is halted there now."""
        return self._on_trap is not None and self._on_trap()

    # ---- running --------------------------------------------------------------------------------------------------

    def engine(self, probing: bool) -> Engine:
        """What runs the program; code with probes only if `probing`."""
        if self._hook is not None:
            return self._loaded.debugged()
        if self._observing is not None:
            return self._observing.engine
        return self._probed if probing and self._probed is not None else self._loaded.engine

    def run(self, scans: int, pace: Pace | None, within: Within, halts: bool, lenient: bool) -> Stop:
        """Runs the debug flavour. `halts`: the hook may halt it. `lenient`: what is to be entered inside of the scan, and
        cannot be as that does not get so far, is entered after it."""
        passage, header = self._passing(), Header(self._loaded.memory)
        scan = header.scan
        passage.begin(self._hook, halts, self._listen, within.waiting, within.again, within.insider, within.enter)
        trapped = whole = False
        try:
            stop = passage.engine.run(scans, pace)
            trapped, whole = stop.reason is Reason.TRAP, header.scan > scan
        finally:
            passage.end(trapped or whole, whole, lenient)
        if within.insider is not None and self._hook is None:
            self._reached |= passage.engine.observer.take().reached
        if stop.reason is Reason.HALTED:
            engine = passage.engine
            self.inside = Inside(engine.begin, engine.count, engine.frames())
        return stop

    def _passing(self) -> Passage:
        engine = self._loaded.debugged()
        if self._passage is None or self._passage.engine is not engine:
            self._passage = Passage(engine)
        return self._passage

    def go_to_begin(self) -> None:
        """To where a scan began that is halted: it is run from there."""
        if self.inside is not None:
            self._loaded.memory[:] = self.inside.begin
            self.inside = None

    def load(self, loaded: Loaded) -> None:
        """Takes over a new program."""
        self._loaded, self.inside, self._probed, self._passage = loaded, None, None, None
