"""How far long work is: one line on a terminal, which goes when the work is done; nothing anywhere else."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_A_SECOND = 5
"""Times the line is drawn. rich leaves out colours where NO_COLOR is set."""
_WIDTH = 30


@contextmanager
def progress(total: int, done: Callable[[], int], told: Callable[[], str]) -> Iterator[None]:
    """A bar up to `total` and a text, on standard error; a second thread calls `done` and `told` while the block runs."""
    if not sys.stderr.isatty():
        yield
        return
    from rich.console import Console
    from rich.live import Live
    from rich.progress_bar import ProgressBar
    from rich.table import Table

    def line() -> Table:
        table = Table.grid(padding=(0, 1))
        table.add_row(ProgressBar(total=max(total, 1), completed=done(), width=_WIDTH), told())
        return table

    console = Console(stderr=True, highlight=False, markup=False)
    with Live(
        get_renderable=line, console=console, refresh_per_second=_A_SECOND, transient=True, redirect_stdout=False,
        redirect_stderr=False,
    ):  # fmt: skip
        yield
