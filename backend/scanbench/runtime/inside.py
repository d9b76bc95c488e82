"""Inside of a scan: where a debugger halts it, and where what was entered there is entered again.

In the journal, entries inside of a scan follow all entries before it. So the entries with a `step` at the end of a journal
that belong to the next scan are those that have to be entered when it runs (again): apart from these, a halted scan needs
only the image with which it began.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from scanbench.engines.debug import NOTHING, READ, WRITE, DebugEngine, Frame, Hook, Listen
from scanbench.program.layout import Layout
from scanbench.runtime.command import Command, Entry, Patch, Plan, Restarted, Swapped
from scanbench.runtime.journal import Journal


class Diverged(Exception):
    """The run did not go as the journal says: the program or the engine is not the one that was recorded."""


@dataclass(frozen=True, slots=True)
class Inside:
    """Where a scan is halted; see `engines.debug`."""

    begin: bytes
    """The whole image with which the scan began."""
    count: int
    frames: tuple[Frame, ...]


def front(journal: Sequence[Entry], scan: int, end: int | None = None) -> int:
    """How many of the first `end` entries were made before the scan, or before: not those inside of it."""
    count = len(journal) if end is None else end
    while count and journal[count - 1].step and journal[count - 1].scan == scan:
        count -= 1
    return count


def entered_inside(journal: Journal, scan: int) -> list[Entry]:
    """What was entered inside of the scan that is next, which is at the end of the journal."""
    return journal[front(journal, scan) :]


def needs_seam(plan: Plan) -> bool:
    """Whether a plan cannot be applied inside of a scan: it does more than patches, or stops or starts the program."""
    return isinstance(plan.effect, Restarted | Swapped) or any(map(_in_header, plan.patches))


def _in_header(patch: Patch) -> bool:
    end = patch.offset + len(patch.data)
    if patch.offset >= Layout.FORCE_COUNT and end <= Layout.FORCE_COUNT + 4:
        return False
    return patch.offset < Layout.HEADER_SIZE and not (patch.offset >= Layout.FORCES and end <= Layout.FORCES_END)


class Onlooker(Hook, Protocol):
    """Who listens to the debug flavour, and is told when something enters in between."""

    def entered(self) -> None:
        """Something was entered before the statement that is to begin."""


class OfScan(Onlooker, Protocol):
    """Listens to one scan that is run again."""

    @property
    def listen(self) -> Listen:
        """What it is called for as the scan begins."""

    def over(self) -> None:
        """The scan has run, or is halted; the image is still that of then."""


class Insider(Protocol):
    """Enters something by itself after a statement of one scan, having seen what that wrote."""

    def wrote(self, site: int, offset: int, size: int, bits: int) -> bool:
        """The statement has written these bytes, or these bits of one; whether something is to be entered after it."""

    def due(self) -> tuple[Command, ...]:
        """What is to be entered, now that the next statement is to begin, or the scan is over."""

    @property
    def over(self) -> bool:
        """Whether it wants nothing more in this scan."""


class Passage:
    """Runs scans on a debug engine: enters what is to be entered inside of them, and lets a hook listen in between."""

    def __init__(self, engine: DebugEngine) -> None:
        self.engine = engine
        self._inner: Onlooker | None = None
        self._halts = True
        self._listen = NOTHING
        self._waiting: list[Entry] = []
        self._apply: Callable[[Entry], object] = lambda entry: None
        self._insider: Insider | None = None
        self._enter: Callable[[Command, int], None] = lambda command, count: None
        self._wrote = False
        """The insider has something to enter."""
        self._sent: Listen | None = None
        self._count = 0

    def begin(
        self, hook: Onlooker | None, halts: bool, listen: Listen, waiting: Sequence[Entry],
        apply: Callable[[Entry], object], insider: Insider | None = None,
        enter: Callable[[Command, int], None] = lambda command, count: None,
    ) -> None:  # fmt: skip
        """Before `engine.run`: who listens and whether that may halt, what is entered in the one scan that is run then, and
        who enters more."""
        self._insider, self._enter, self._wrote = insider, enter, False
        self._halts = halts
        self._inner, self._listen, self._waiting, self._apply = hook, listen, list(waiting), apply
        self._count = 0
        self.engine.hook(self)
        self._tell(0)

    def end(self, ended: bool, whole: bool, lenient: bool) -> None:
        """After `engine.run`; `ended`: the scan went to its end, `whole`: not by a trap. What was entered after its last
        statement is entered now; what could not be entered is an error then, or is entered now, too."""
        self.engine.hook(None)
        self._inner = None
        waiting, self._waiting = self._waiting, []
        last = self.engine.count + 1
        while whole and waiting and waiting[0].step == last:
            self._apply(waiting.pop(0))
        insider, self._insider = self._insider, None
        if whole and insider is not None and self._wrote and not waiting:
            for command in insider.due():
                self._enter(command, last)
        if ended and lenient:
            for entry in waiting:
                self._apply(entry)
        elif ended and waiting:
            raise Diverged(
                f"scan {waiting[0].scan} has {self.engine.count} statements, and something was entered before "
                f"statement {waiting[0].step} when it was recorded"
            )

    def listen(self, listen: Listen) -> None:
        """What the hook is called for, from now on."""
        self._listen = listen
        self._tell(self._count)

    def _tell(self, passed: int) -> None:
        """`passed`: statements that have begun in the scan."""
        listen = self._listen
        if self._waiting:
            counts = [each for each in (listen.count, self._waiting[0].step) if each > passed]
            listen = replace(listen, count=min(counts, default=listen.count))
        if self._insider is not None:
            listen = replace(listen, every=listen.every or self._wrote, accesses=listen.accesses | WRITE)
        if listen is not self._sent:
            self._sent = listen
            self.engine.listen(listen)

    def _step_inside(self, count: int) -> None:
        """The insider's turn, unless something is to be entered later in this scan: entries are in order."""
        insider, self._wrote = self._insider, False
        if insider is None or self._waiting:
            self._insider = None
        else:
            for command in insider.due():
                self._enter(command, count)
                if self._inner is not None:
                    self._inner.entered()
            if insider.over:
                self._insider = None
        self._tell(count)

    # ---- as the engine's hook ---------------------------------------------------------------------------------------

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        self._count = count
        if self._waiting:
            while self._waiting and count >= self._waiting[0].step:
                self._apply(self._waiting.pop(0))
                if self._inner is not None:
                    self._inner.entered()
            self._tell(count)
        if self._wrote:
            self._step_inside(count)
        listen, hook = self._listen, self._inner
        if hook is None or not (listen.every or site in listen.sites or count == listen.count):
            return False
        return hook.statement(site, count, depth) and self._halts

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""
        insider, wanted = self._insider, True
        if insider is not None:
            wanted = _listens(self._listen, offset, size, WRITE if written else READ)
            if written and insider.wrote(site, offset, size, self.engine.bits) and not self._wrote:
                self._wrote = True
                self._tell(count)
        if wanted and self._inner is not None:
            self._inner.access(site, count, offset, size, written)


def _listens(listen: Listen, offset: int, size: int, kind: int) -> bool:
    """Whether an access is one that is listened for."""
    if listen.accesses & kind:
        return True
    return bool(listen.bytes) and any(listen.bytes.get(at, 0) & kind for at in range(offset, offset + size))


class HaltAt:
    """A hook that halts before the statement of one count."""

    def __init__(self, count: int) -> None:
        self._count = count

    def statement(self, site: int, count: int, depth: int) -> bool:
        """See `Hook`."""
        return count == self._count

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        """See `Hook`."""

    def entered(self) -> None:
        """See `Onlooker`."""
