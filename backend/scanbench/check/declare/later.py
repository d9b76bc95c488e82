"""Constants that are asked for before their declaration is reached: the order of declarations and files means nothing.

The variables of an owner are declared in their order, which gives them their places; a constant that a bound or start value needs
goes before the variable that needs it.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TypeAlias

from scanbench.check.context import Rejected, Report
from scanbench.check.declare.names import Names, Space
from scanbench.problems import Span
from scanbench.program.types import Record

ToDeclare: TypeAlias = "tuple[str, bool, Callable[[], None], Space | None]"
"""The name of a variable, whether it is a constant, what declares it, and from where that looks up names (None: from here)."""

MAX_CONSTANTS = 100
"""Constants that need each other, each declared below the one that needs it."""


@dataclass(slots=True, eq=False)
class Coming:
    """A variable whose declaration may not be reached yet."""

    name: str
    """As its owner keeps it."""
    constant: bool
    declare: Callable[[], None]
    space: Space
    """From where its declaration looks up names."""
    owners: tuple[Record, ...] = ()
    """The records that are under declaration around it."""
    begun: bool = False

    @property
    def shown(self) -> str:
        around = self.space.globals_of
        return f"{around}.{self.name}" if around and "." not in self.name else self.name


@dataclass(slots=True)
class Later:
    """What is still to be declared of the records under declaration."""

    report: Report
    names: Names
    owners: list[Record]
    """As in `Declarations`."""
    _known: dict[tuple[int, str], Coming] = field(default_factory=dict)
    """By the identity of the owner and the name in upper case."""
    _open: list[Coming] = field(default_factory=list)
    _parts: list[Report] = field(default_factory=list)
    """What was met in declarations that were asked for: whoever asks may only try, and forget what was reported meanwhile."""

    def declare(self, owner: Record, variables: Iterable[ToDeclare]) -> None:
        """Declares each in their order, but for constants that another one needs before."""
        around = tuple(self.owners)
        all_of_them = [
            Coming(name, fixed, do, space or self.names.space, around) for name, fixed, do, space in variables
        ]
        keys = {(id(owner), each.name.upper()): each for each in reversed(all_of_them)}  # of two, the first is meant
        self._known |= keys
        try:
            for each in all_of_them:
                if not each.begun:
                    self._begin(each)
                if not self._open:
                    self.tell()
        finally:
            for key in keys:
                del self._known[key]

    def ask(self, owner: Record, key: str) -> None:
        """Declares the constant of this name, if there is one that is still to come."""
        each = self._known.get((id(owner), key))
        if each is not None and each.constant and not each.begun and len(self._open) < MAX_CONSTANTS:
            with self.report.apart() as part:
                self._parts.append(part)
                self._begin(each)

    def tell(self) -> None:
        """Reports what was met in declarations that were asked for."""
        for part in self._parts:
            self.report.add(part)
        self._parts.clear()

    def why(self, owners: Iterable[Record], keys: Iterable[str], name: str, span: Span) -> Rejected | None:
        """Reports why what is declared has no value yet; None of what is not declared."""
        known = [*keys]
        found = (self._known.get((id(owner), key)) for owner in owners for key in known)
        each = next((each for each in found if each is not None), None)
        if each is None:
            return None
        if not each.constant:
            message = f"A constant is needed here; `{name}` is a variable, and no CONSTANT."
            return self.report.reject("D004", message, span)
        if not each.begun:  # too many are open
            message = (
                f"`{name}` is nested more than {MAX_CONSTANTS} constants deep, each declared below the one that needs it; "
                "declare them the other way round."
            )
            return self.report.reject("S003", message, span)
        if each not in self._open:  # what is wrong with it was told
            return Rejected()
        path = " -> ".join(each.shown for each in [*self._open[self._open.index(each) :], each])
        message = f"The value of `{name}` needs itself: {path}. Give one of them a value that needs none of the others."
        return self.report.reject("D004", message, span)

    def _begin(self, each: Coming) -> None:
        each.begun = True
        self._open.append(each)
        try:
            with self.under(each.owners), self.names.within(each.space):
                each.declare()
        finally:
            self._open.pop()

    @contextmanager
    def under(self, owners: Iterable[Record]) -> Iterator[None]:
        """Declares within these records meanwhile, whatever is under declaration where it is asked for."""
        before, self.owners[:] = self.owners[:], owners
        try:
            yield
        finally:
            self.owners[:] = before
