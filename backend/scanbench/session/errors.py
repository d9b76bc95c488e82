"""The errors of one PLC: their history by version of the program, how the program reacted, what is armed and what disturbs."""

from collections.abc import Callable, Mapping, Sequence

from scanbench.faults.arm import ArmedInfo
from scanbench.faults.disturb.disturb import DisturbanceInfo
from scanbench.faults.history import ErrorRow, History, Swept
from scanbench.faults.line_faults import BrokenLine
from scanbench.faults.present import Active
from scanbench.faults.reaction.reaction import Reaction
from scanbench.plcmodel.model import Model
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Entry
from scanbench.session.reacting import Raised, Reacting
from scanbench.wire import events
from scanbench.wire.events import Event
from scanbench.wire.host import InEffect, PlcState

LIVING = ("running", "paused", "halted", "stopped", "trapped", "fatal", "no_space")
"""States that a host tells of itself, with the version that runs."""


class Errors:
    """Keeps the rows as the PLC's journal and a sweep make them, and tells what changed."""

    def __init__(
        self, history: History, reacting: Callable[[Callable[[Raised, Reaction | str], None]], Reacting],
        publish: Callable[[Event], None], keep: Callable[[Sequence[ErrorRow]], None], state: Callable[[], PlcState],
    ) -> None:  # fmt: skip
        """`reacting` makes what finds reactions out, given whom to tell; `keep` keeps rows; `state` is the PLC's."""
        self._history = history
        self._reacting = reacting(self._on_reaction)
        self._publish, self._keep, self._state = publish, keep, state
        self._present: Mapping[str, Active] = {}
        """Errors that are present in what is shown, live or past."""
        self._past_rows: list[ErrorRow] = []
        self._past_shown: tuple[int, int] | None = None
        """The version and the scan of the past whose rows these are."""
        self._armed: tuple[ArmedInfo, ...] = ()
        self._disturbances: tuple[DisturbanceInfo, ...] = ()
        self._lines: tuple[BrokenLine, ...] = ()

    @property
    def rows(self) -> list[ErrorRow]:
        """The error history, in the order of the catalogue; while the past is shown, as it was then, when no sweep of today was done."""
        return self._past_rows or [self._history.with_sweep(row) for row in self._history.rows]

    @property
    def live(self) -> list[ErrorRow]:
        """The same of the PLC that runs, or waits while the past is shown."""
        return self._history.rows

    @property
    def version(self) -> int:
        """The version whose rows are written now."""
        return self._history.version

    @property
    def versions(self) -> list[int]:
        """Versions of the program that have an error history, that of the one that runs included."""
        return self._history.versions

    @property
    def armed(self) -> tuple[ArmedInfo, ...]:
        """The faults that are armed."""
        return self._armed

    @property
    def lines(self) -> tuple[BrokenLine, ...]:
        """The lines to clients that something is wrong with."""
        return self._lines

    @property
    def disturbances(self) -> tuple[DisturbanceInfo, ...]:
        """What is to disturb the PLC, or does."""
        return self._disturbances

    def rows_of(self, version: int, model: Model) -> list[ErrorRow]:
        """The error history of a version of the program, which ran on this model."""
        return [self._history.with_sweep(row) for row in self._history.rows_of(version, model)]

    def reaction(self, error: str) -> Reaction | None:
        """How the program reacted to an error the last time it was raised, which may name an instance; None where nobody
        compared."""
        rows = [row for row in self._history.rows if error in (row.key, row.id) and row.generated_at is not None]
        row = max(rows, key=lambda row: str(row.generated_at), default=None)
        return None if row is None or row.reaction is None else row.reaction.found

    def take_sweeps(self, swept: Mapping[int, Mapping[str, Swept]]) -> None:
        """What sweeps of the project found out, by version and error."""
        self._history.take_sweeps(swept)
        self._tell(self.rows, whole=True)

    def compare(self, rows: Sequence[ErrorRow], scan: int | None = None) -> None:
        """Has the reactions found out that are being recorded; of those that began before `scan`, if it is given."""
        for row in rows:
            reaction = row.reaction
            if reaction is not None and reaction.state == "recording" and scan in (None, reaction.scan):
                self._reacting.raised(Raised(row.key, reaction.scan, row.program_version))

    async def close(self) -> None:
        """Nobody waits for reactions any more."""
        await self._reacting.close()

    # ---- from the host --------------------------------------------------------------------------------------------

    def on_state(self, state: PlcState) -> None:
        """The state of the PLC changed."""
        if state.pid is not None and not state.past_by and state.state in LIVING:
            self._see_version(state.version, state.scan)
        if not state.past_by:
            self._reacting.reached(state.scan, state.state)
        if state.past_by:
            if (state.version, state.scan) != self._past_shown:
                self._show_past(state)  # what is present may be the same then, and is not told again
        elif self._past_rows:
            self._past_rows, self._past_shown = [], None
            self._tell(self._history.rows, whole=True)

    def on_message(self, message: object) -> bool:
        """What the host says; whether it was for the errors."""
        match message:
            case InEffect():
                self._on_in_effect(message)
            case _:
                return False
        return True

    def on_entries(self, entries: Sequence[Entry]) -> None:
        """What was entered makes rows."""
        rows: dict[tuple[int, str], ErrorRow] = {}
        version = self._history.version
        for entry in entries:
            changed = self._history.fold(entry)
            rows.update(((row.program_version, row.key), row) for row in changed)
            if entry.plan.cuts:
                self._reacting.ended(entry.scan)
            self.compare(changed, entry.scan)
        self._publish_rows(list(rows.values()), fresh=self._history.version != version)

    def on_new_run(self) -> None:
        """What was raised before is not in the run file."""
        self._reacting.forget()

    def on_program(self, model: Model, version: int) -> None:
        """Takes over a program with the errors that its model knows; each version has rows of its own."""
        self._history.take_model(model)
        if version != self._history.version:
            self._history.begin(version)
            self._publish_rows((), fresh=True)

    def on_model(self, model: Model) -> None:
        """The program that runs now may know other errors."""
        self._history.take_model(model)
        self._publish_rows((), fresh=True)

    def _on_in_effect(self, in_effect: InEffect) -> None:
        """What holds now: also after a start, when entries of an earlier life or of a lost one count."""
        if in_effect.armed != self._armed:
            self._armed = in_effect.armed
            self._publish(events.ArmedChanged(self._armed))
        if in_effect.disturbances != self._disturbances:
            self._disturbances = in_effect.disturbances
            self._publish(events.Disturbances(self._disturbances))
        if in_effect.lines != self._lines:
            self._lines = in_effect.lines
            self._publish(events.LinesChanged(self._lines))
        self._present = in_effect.errors
        state = self._state()
        if state.past_by:
            self._show_past(state)
            return
        self._publish_rows(self._history.reconcile(in_effect.errors, wall_time()))

    def _show_past(self, state: PlcState) -> None:
        rows = self._history.as_of(self._present, state.scan, state.version)
        self._past_shown = state.version, state.scan
        if rows != self._past_rows:
            self._past_rows = rows
            self._tell(rows, whole=True)

    def _on_reaction(self, raised: Raised, found: Reaction | str) -> None:
        row = self._history.set_reaction(raised.error, raised.version, raised.scan, found)
        if row is not None:
            self._publish_rows([row])

    def _see_version(self, version: int, scan: int) -> None:
        """A run that goes on from its past may be back at a version that ran before, without an entry that says so."""
        if version != self._history.version:
            self._publish_rows(self._history.turn_to(version, wall_time(), scan), fresh=True)

    def _publish_rows(self, rows: Sequence[ErrorRow], fresh: bool = False) -> None:
        """Keeps and tells what changed; `fresh`: a different version runs, so that all rows change."""
        self._keep(rows)
        now = self._history.rows if fresh else [row for row in rows if row.program_version == self._history.version]
        if now and not self._past_rows:
            self._tell(now, whole=fresh)

    def _tell(self, rows: Sequence[ErrorRow], whole: bool = False) -> None:
        told = rows if self._past_rows else map(self._history.with_sweep, rows)
        self._publish(events.ErrorsChanged(tuple(told), whole))
