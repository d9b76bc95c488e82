"""A trace file as a table of texts: what every format comes to, before anybody says what its columns mean."""

from collections.abc import Sequence
from dataclasses import dataclass

from scanbench.public import Public

MAX_BYTES = 32 << 20
MAX_ROWS = 500_000
MAX_COLUMNS = 1000
MAX_CELLS = 5_000_000
MAX_PROBLEMS = 200
"""How many are told: the others go away with them."""


@dataclass(frozen=True, slots=True)
class TraceProblem(Public):
    """What is wrong with a file or with its mapping, and where."""

    row: int | None
    """Line of a CSV file, counted from 1; index in a JSON file, counted from 0; None: the file as a whole."""
    column: str
    message: str
    warning: bool = False
    """It is worth a look, but refuses nothing."""

    def __str__(self) -> str:
        where = [] if self.row is None else [f"row {self.row}"]
        where += [f"column `{self.column}`"] if self.column else []
        return f"{', '.join(where)}: {self.message}" if where else self.message


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


class Problems:
    """Collects them, and says when there are enough."""

    def __init__(self) -> None:
        self.found: list[TraceProblem] = []

    @property
    def full(self) -> bool:
        """Whether any more would not be told."""
        return len(self.found) >= MAX_PROBLEMS

    def add(self, row: int | None, column: str, message: str, warning: bool = False) -> None:
        """One more, while there is room."""
        if not self.full:
            self.found.append(TraceProblem(row, column, message, warning))

    def refuse(self) -> None:
        """Raises `BadTraceFile` where there are any."""
        if self.found:
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
