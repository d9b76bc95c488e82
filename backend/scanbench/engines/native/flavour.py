"""The flavours of a program's code: what it does besides running the program. Code that only runs does nothing of it."""

from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING

from scanbench.program.program import Expr, If, Place, Pou, Stmt
from scanbench.program.tasks import ProgramInstance

if TYPE_CHECKING:
    from scanbench.engines.native.emit_body import Body, Unit
    from scanbench.engines.native.emit_memory import Address

_NOTHING = nullcontext()


class Flavour:
    """The run flavour. The emitters tell a flavour where they are; others emit something there."""

    exact = False
    """Whether it matters which statements and reads are run: so none is that the program does not ask for."""
    whole_image = False
    """Whether all variables are in the image at all times, and none in a register."""

    def declare(self, unit: "Unit") -> None:
        """The memory that the code and the engine share, in a module of its own or that of the whole."""

    def may_select(self, body: "Body", statement: If) -> bool:
        """Whether all branches of the IF may be run, to choose among the results."""
        return not self.exact

    # ---- what a POU's code depends on -------------------------------------------------------------------------

    def key(self, pou: Pou) -> object:
        """A value that differs if the flavour would emit this POU differently than it did for an earlier program."""
        return None

    def looks(self, pou: Pou) -> tuple[Expr, ...]:
        """What is evaluated in the POU's body besides."""
        return ()

    # ---- the scan ---------------------------------------------------------------------------------------------

    def begin(self, body: "Body") -> None:
        """A scan begins."""

    def silence(self, body: "Body", silent: bool) -> None:
        """From here on what runs is not the user's program, or is again."""

    def done(self, body: "Body") -> None:
        """All of a scan has run; it does not count yet."""

    def joined(self, body: "Body", instance: ProgramInstance) -> AbstractContextManager[None]:
        """Around what a CONFIGURATION connects to the program."""
        return _NOTHING

    # ---- statements -------------------------------------------------------------------------------------------

    def enter(self, body: "Body") -> None:
        """The POU's body begins."""

    def leave(self, body: "Body") -> None:
        """The POU's body ends."""

    def statement(self, body: "Body", statement: Stmt) -> AbstractContextManager[None]:
        """Around a statement; what is emitted meanwhile belongs to it."""
        return _NOTHING

    def selected(self, body: "Body", statement: Stmt, guard: str) -> None:
        """The statement begins where the guard, an i1, is true: instead of `statement`, where `may_select`."""

    def calls(self, body: "Body", callee: Pou) -> None:
        """The statement is about to call."""

    def tries(self, body: "Body") -> str:
        """A __TRY begins; gives what `caught` needs to know."""
        return ""

    def caught(self, body: "Body", known: str) -> None:
        """A trap in a __TRY of this body, or in what it called, is caught."""

    def loop(self, body: "Body", statement: Stmt) -> AbstractContextManager[None]:
        """Around a FOR or WHILE."""
        return _NOTHING

    def goes(self, body: "Body", statement: Stmt, way: int) -> None:
        """The statement goes this way, see `Sites.outcome`."""

    def ends(self, body: "Body", statement: Stmt) -> None:
        """A FOR or WHILE ends, but not by EXIT."""

    # ---- accesses ---------------------------------------------------------------------------------------------

    def read(self, body: "Body", place: Place, where: "Address") -> None:
        """The value of the place is read."""

    def written(self, body: "Body", place: Place, where: "Address") -> None:
        """The place is written."""


RUN = Flavour()
