"""One PLC as one DAP client sees it: what the request handlers work on."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

from scanbench.debug.breakpoint import Breakpoint
from scanbench.session.session import Session
from scanbench.web.dap.handles import Handles
from scanbench.web.dap.paths import Paths
from scanbench.web.dap.shapes import Body, Initialize
from scanbench.web.dap.threads import Threads
from scanbench.wire.debugging import DebugRequest
from scanbench.wire.host import Ack
from scanbench.wire.refused import Refused

A = TypeVar("A")


@dataclass(slots=True)
class Debuggee:
    """A PLC, who debugs it, and how that client counts and names things."""

    session: Session
    author: str
    group: str
    """Of its breakpoints; empty is the list that all browsers share."""
    paths: Paths
    breaks: bool = True
    """False: it was launched without debugging."""
    client: Initialize = field(default_factory=Initialize)
    handles: Handles = field(default_factory=Handles)
    threads: Threads = field(default_factory=Threads)
    known: dict[int, Body] = field(default_factory=dict)
    """Breakpoints that the client was told of, as it was told."""
    functions: dict[str, list[Breakpoint]] = field(default_factory=dict)
    """File -> breakpoints that were set by the name of a POU: to the PLC they are lines."""
    leaving: list[Breakpoint] = field(default_factory=list)
    """Those of them that are being taken away: the PLC may halt there still."""

    async def ask(self, kind: type[A], make: Callable[[int], DebugRequest]) -> A:
        """The PLC's answer of this kind; `Refused` says why there is none."""
        answer = await self.session.debug(make, kind)
        if isinstance(answer, Ack):
            self.done(answer)
        return answer

    @staticmethod
    def done(ack: Ack) -> Ack:
        """The acknowledgement; `Refused` when it is none."""
        if not ack.ok:
            raise Refused(ack.message, ack.near)
        return ack

    # ---- how the client counts ------------------------------------------------------------------------------------

    def line_in(self, line: int) -> int:
        """A line of the client's -> from 1."""
        return line if self.client.lines_start_at1 else line + 1

    def column_in(self, column: int | None) -> int:
        """A column of the client's -> from 1, 0 where it gave none."""
        return 0 if column is None else column if self.client.columns_start_at1 else column + 1

    def span(self, line: int, column: int, end_line: int = 0, end_column: int = 0) -> Body:
        """A range of a file as the client counts; without an end the place alone."""
        less_line, less_column = not self.client.lines_start_at1, not self.client.columns_start_at1
        body: Body = {"line": line - less_line, "column": max(column, 1) - less_column}
        if end_line:
            body |= {"endLine": end_line - less_line, "endColumn": max(end_column, 1) - less_column}
        return body
