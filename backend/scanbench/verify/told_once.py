"""What the steps of a scan have told is no difference a second time, when the scan is compared as a whole after them."""

from dataclasses import replace

from scanbench.verify.contract import Mismatch, Row


class ToldOnce:
    """Of one verification, in the order in which its rows are made."""

    def __init__(self) -> None:
        self._scan = -1
        self._told: list[Mismatch] = []
        """By the steps of that scan, also what follows from a difference."""

    def stepped(self, row: Row) -> None:
        """A step was told."""
        if row.scan != self._scan:
            self._scan, self._told = row.scan, []
        self._told += [*row.differences, *row.consequences]

    def rest(self, row: Row) -> Row:
        """The row of a whole scan: what its steps have told becomes a consequence; what they did not see stays a difference."""
        if row.scan != self._scan:
            return row
        new = tuple(each for each in row.differences if not self._known(each))
        if len(new) == len(row.differences):
            return row
        known = tuple(each for each in row.differences if each not in new)
        return replace(row, differences=new, consequences=(*row.consequences, *known))

    def _known(self, found: Mismatch) -> bool:
        """Both name the same variable, or the same run-time error, or the two sides part at the same statement."""
        return found.cause != "recorded" and any(_same(found, each) for each in self._told)


def _same(one: Mismatch, other: Mismatch) -> bool:
    if "trap" in (one.cause, other.cause) or (one.cause == other.cause == "order"):
        return one.cause == other.cause
    return _ends(one.name, other.name) or _ends(other.name, one.name)


def _ends(path: str, name: str) -> bool:
    """Rows of a range name a variable as its POU does: `total` is `Main.total`."""
    return path == name or path.endswith(f".{name}")
