"""A PLC that waits for its verification: after each scan, or before each statement."""

from collections.abc import Callable
from contextlib import suppress

from scanbench.session.session import Session
from scanbench.verify.contract import Range
from scanbench.wire.debugging import Step
from scanbench.wire.host import Ack
from scanbench.wire.refused import Refused
from scanbench.wire.verifying import VerifyPace


class Hold:
    """Of one verification."""

    def __init__(self, session: Session, hand_over: Callable[[], bool]) -> None:
        """`hand_over`: whether a different verification holds the same PLC too, and takes over."""
        self._session, self._hand_over = session, hand_over
        self.held = False
        """Whether the PLC ran when it was made to wait."""
        self._advancing = False
        """Whether it runs to where it waits again."""

    async def hold(self, author: str) -> None:
        """The PLC waits from now on: after its scan, or before its next statement. `Refused`."""
        if self._session.state.state == "running":
            ack = await self._session.drive("pause", None, author)
            if not ack.ok:
                raise Refused(ack.message)
            self.held = True

    async def let_go(self, author: str) -> None:
        """A PLC that waits because of this goes on; where it cannot, it says so itself."""
        session = self._session
        if self.held and not self._hand_over() and session.state.state in ("paused", "halted", "running"):
            if session.state.halt is not None:
                with suppress(Refused):
                    await session.debug(lambda ref: Step(ref, "continue", author), Ack)
            else:  # perhaps on the way to the next statement, where it would wait
                await session.drive("continue", None, author)
        self.held = self._advancing = False

    def seen(self, state: str) -> None:
        """What the PLC does now: one that somebody lets run does not wait because of this any more."""
        if state in ("paused", "halted"):
            self._advancing = False
        elif state == "running" and not self._advancing:
            self.held = False

    async def advance(self, pace: VerifyPace, author: str, range: Range) -> None:
        """One scan further, or to the next statement of the range; `Refused`."""
        self._advancing = True
        if pace == "scan":
            ack = await self._session.drive("scan", None, author)
        else:
            ack = await self._session.debug(lambda ref: Step(ref, "within", author, range=range), Ack)
        if not ack.ok:
            self._advancing = False
            raise Refused(ack.message, ack.near)
