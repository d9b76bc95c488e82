"""Answers to what was asked of a PLC's process, each with the scan of which it speaks."""

from collections.abc import Callable

from scanbench.host.link import Link
from scanbench.host.services import Services
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry, Refusal
from scanbench.wire.host import Ack


class Answers:
    """What was entered and how the PLC is now is told before the answer, values after it."""

    def __init__(self, timeline: Timeline, services: Services, link: Link, on_answer: Callable[[], None]) -> None:
        self._timeline, self._services, self._link, self._on_answer = timeline, services, link, on_answer

    def ack(self, ref: int, ok: bool, message: str, near: tuple[str, ...] = ()) -> None:
        """Done, or not, and why."""
        self._services.before_answer()
        self._link.post(Ack(ref, ok, message, self._timeline.resource.header.scan, near))
        self._on_answer()

    def answer(self, ref: int, refusal: Refusal | None, message: str) -> None:
        """A refusal, or done."""
        if refusal is None:
            self.ack(ref, True, message)
        else:
            self.ack(ref, False, refusal.message, refusal.near)

    def entered(self, ref: int, outcome: Entry | Refusal) -> None:
        """What became of a command."""
        if isinstance(outcome, Refusal):
            self.answer(ref, outcome, "")
        else:
            self.ack(ref, True, outcome.plan.message)
