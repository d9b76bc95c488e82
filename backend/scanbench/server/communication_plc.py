"""A PLC for a server that shows its program: the session of it."""

from collections.abc import Callable

from scanbench.comm.door import Away
from scanbench.faults.history import ErrorRow
from scanbench.plcmodel.model import Model
from scanbench.session.errors import LIVING
from scanbench.session.session import Session
from scanbench.wire.events import ErrorsChanged, Event, StateChanged
from scanbench.wire.host import Sources
from scanbench.wire.opcua import RaisedError
from scanbench.wire.refused import Refused, Unavailable
from scanbench.wire.variables import DescribeVariables, ReadVariables, VariablesAre, VariablesDescribed


class SessionPlc:
    """`comm.door.Plc`."""

    def __init__(self, session: Session) -> None:
        self._session = session

    @property
    def name(self) -> str:
        """See `Plc`."""
        return self._session.name

    @property
    def model(self) -> Model:
        """See `Plc`."""
        return self._session.model

    @property
    def sources(self) -> Sources:
        """See `Plc`."""
        return self._session.instance.sources

    @property
    def errors(self) -> tuple[RaisedError, ...] | None:
        """See `Plc`."""
        if self._session.state.state not in LIVING:
            return None
        return tuple(_raised(row) for row in self._session.errors.live if row.status != "never")

    def listen(self, changed: Callable[[], None]) -> Callable[[], None]:
        """See `Plc`."""
        known: tuple[str, Sources] | None = None

        def hear(event: Event) -> None:
            nonlocal known
            now = (self._session.state.state, self.sources)
            if isinstance(event, ErrorsChanged) or (isinstance(event, StateChanged) and now != known):
                known = now
                changed()

        self._session.listen(hear)
        return lambda: self._session.ignore(hear)

    async def describe(self, paths: tuple[str, ...]) -> VariablesDescribed:
        """See `Plc`."""
        try:
            return await self._session.instance.ask(lambda ref: DescribeVariables(ref, paths), VariablesDescribed)
        except (Unavailable, Refused) as error:
            raise Away(str(error)) from error

    async def variables(self, paths: tuple[str, ...]) -> VariablesAre:
        """See `Plc`."""
        try:
            found = await self._session.instance.ask(lambda ref: ReadVariables(ref, paths), VariablesAre)
        except (Unavailable, Refused) as error:
            raise Away(str(error)) from error
        if found.message:
            raise Away(found.message)
        return found


def _raised(row: ErrorRow) -> RaisedError:
    seen = row.acknowledged
    return RaisedError(
        row.key, row.name, row.severity == "fatal", row.code, row.details, row.generated_at, row.generated_scan, row.by or "",
        row.status == "generated", row.recovered_at, "" if seen is None else seen.by, "" if seen is None else seen.remark,
    )  # fmt: skip
