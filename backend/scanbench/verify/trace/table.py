"""A trace file as a table of texts: what every format comes to, before anybody says what its columns mean."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from scanbench.public import Public

Unit = Literal["scan", "ns", "us", "ms", "s"]
"""What the numbers of a scan or time column count. Where they are seconds, there may be a date and time of day instead, or a time of day."""

MAX_BYTES = 32 << 20
MAX_ROWS = 500_000
MAX_COLUMNS = 1000
MAX_CELLS = 5_000_000
MAX_PROBLEMS = 200
"""How many causes are told: the others go away with them."""


@dataclass(frozen=True, slots=True)
class TraceProblem(Public):
    """What is wrong with a file or with its mapping, and where."""

    row: int | None
    """Line of a CSV file, counted from 1; index in a JSON file, counted from 0; None: the file as a whole."""
    column: str
    message: str
    warning: bool = False
    """It is worth a look, but refuses nothing."""
    more: int = 0
    """In so many further rows it is the same."""
    last: int | None = None
    """The last one of those."""
    near: tuple[str, ...] = ()
    """Variables that may be meant, where the column has none that fits."""

    def __str__(self) -> str:
        where = [] if self.row is None else [f"row {self.row}"]
        where += [f"column `{self.column}`"] if self.column else []
        told = f"{', '.join(where)}: {self.message}" if where else self.message
        return f"{told} (The same in {self.more:,} more rows, the last one is row {self.last}.)" if self.more else told


class BadTraceFile(ValueError):
    """The file is no trace; nothing of it is kept."""

    def __init__(self, problems: Sequence[TraceProblem]) -> None:
        super().__init__("; ".join(map(str, problems[:3])))
        self.problems = tuple(problems)


@dataclass(frozen=True, slots=True)
class Table:
    """One row for each scan or time. An empty text: there is no value."""

    name: str
    """Of the file."""
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    numbers: Sequence[int]
    """Of the rows, as `TraceProblem.row`."""
    header: int | None = None
    """The row of the columns' names; JSON has none."""
    comma: bool = False
    """Numbers may have a decimal comma."""
    note: str = ""
    """How it was read, where that is not plain: its encoding was guessed."""
    layout: str = ""
    """Whose layout it has; empty: ours (docs/trace-format.md)."""
    axis: str = ""
    """The column that is the scan or time, where the layout tells; empty: that is found by the names."""
    unit: Unit | None = None
    """Of the axis, where the layout tells."""
    from_start: bool = True
    """Scans and times may count from the controller's start; else they count from where the recording began."""
    durations: Unit | None = None
    """What a plain number in a column of a TIME counts, where the layout tells."""
    left_out: tuple[str, ...] = ()
    """What the file has besides, and is no variable: a sentence for each."""


class Problems:
    """Collects them: one for each cause, however many rows have it."""

    def __init__(self) -> None:
        self._found: list[TraceProblem] = []
        self._causes: dict[tuple[str, str], int] = {}
        self._more: dict[int, tuple[int, int | None]] = {}
        """How many more rows a problem has, and the last one of them."""

    @property
    def found(self) -> list[TraceProblem]:
        """All of them, each with the number of rows that have it."""
        more = ((each, *self._more.get(at, (0, None))) for at, each in enumerate(self._found))
        return [replace(each, more=count, last=last) for each, count, last in more]

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return bool(self._found)

    @property
    def count(self) -> int:
        """How many causes there are."""
        return len(self._found)

    @property
    def full(self) -> bool:
        """Whether any more would not be told."""
        return len(self._found) >= MAX_PROBLEMS

    def add(
        self, row: int | None, column: str, message: str, warning: bool = False, cause: str = "",
        near: Sequence[str] = (),
    ) -> None:  # fmt: skip
        """One more, while there is room. A further one of the same column and `cause` is only counted."""
        known = self._causes.get((column, cause)) if cause else None
        if known is not None:
            self._more[known] = (self._more.get(known, (0, None))[0] + 1, row)
        elif not self.full:
            if cause:
                self._causes[column, cause] = len(self._found)
            self._found.append(TraceProblem(row, column, message, warning, near=tuple(near)))

    def refuse(self) -> None:
        """Raises `BadTraceFile` where there are any."""
        if self._found:
            raise BadTraceFile(self.found)


def bad(message: str, row: int | None = None, column: str = "") -> BadTraceFile:
    """The only thing that is wrong."""
    return BadTraceFile([TraceProblem(row, column, message)])


def check_size(columns: int, rows: int) -> None:
    """Raises `BadTraceFile` where a table is too large."""
    if columns > MAX_COLUMNS:
        raise bad(f"The trace has {columns:,} columns; at most {MAX_COLUMNS:,} are read.")
    if rows > MAX_ROWS:
        raise bad(f"The trace has more than {MAX_ROWS:,} rows. Cut it into several files.")
    if rows * columns > MAX_CELLS:
        raise bad(f"The trace has more than {MAX_CELLS:,} cells. Cut it into several files, or leave columns out.")
