"""Of one PLC: which reactions are still to be found out, and when their window is over."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from scanbench.faults.reaction.reaction import WINDOW, Reaction
from scanbench.jobs.client import SharedJob
from scanbench.wire.jobs import FindReaction, Reacted
from scanbench.wire.refused import Refused

_NOT_RUNNING = ("fatal", "trapped", "stopped", "off", "failed")
"""States in which no scan comes until somebody does something: what a program did until now is all it will do."""


@dataclass(frozen=True, slots=True)
class Raised:
    """An error that somebody raised, before a scan, while a version of the program ran."""

    error: str
    scan: int
    version: int


class Reacting:
    """Asks for each error raised when its window is over. `on_found` gets the reaction, or why there is none."""

    def __init__(
        self, reactions: SharedJob, run: Callable[[], Path], on_found: Callable[[Raised, Reaction | str], None]
    ) -> None:
        self._reactions, self._run, self._on_found = reactions, run, on_found
        self._waiting: dict[str, Raised] = {}
        self._asking: set[asyncio.Task[None]] = set()

    def raised(self, raised: Raised) -> None:
        """From now on its window runs; that of the last time is given up."""
        self._waiting[raised.error] = raised

    def ended(self, scan: int) -> None:
        """Ends all windows, as the program was restarted or changed before this scan."""
        waiting, self._waiting = self._waiting, {}
        for raised in waiting.values():
            self._ask(raised, scan)

    def forget(self) -> None:
        """A new run: what was raised before is not in its file."""
        waiting, self._waiting = self._waiting, {}
        for raised in waiting.values():
            self._on_found(raised, "a new run began before its window was over")

    def reached(self, scan: int, state: str) -> None:
        """The PLC is in this state, and runs this scan next."""
        for raised in list(self._waiting.values()):
            if scan >= raised.scan + WINDOW or (state in _NOT_RUNNING and scan >= raised.scan):
                del self._waiting[raised.error]
                self._ask(raised, scan)

    async def close(self) -> None:
        """Nobody waits for answers any more."""
        for task in self._asking:
            task.cancel()
        await asyncio.gather(*self._asking, return_exceptions=True)

    def _ask(self, raised: Raised, end: int) -> None:
        task = asyncio.get_running_loop().create_task(self._find(raised, min(end, raised.scan + WINDOW)))
        self._asking.add(task)
        task.add_done_callback(self._asking.discard)

    async def _find(self, raised: Raised, end: int) -> None:
        run = str(self._run())
        try:
            answer = await self._reactions.ask(
                lambda ref: FindReaction(ref, run, raised.error, raised.scan, end, WINDOW), Reacted
            )
            self._on_found(raised, answer.reaction)
        except Refused as why:
            self._on_found(raised, why.message)
