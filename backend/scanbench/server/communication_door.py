"""The door of a protocol client: the session of a PLC, and which of its error words the client reads."""

from bisect import bisect_left
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

from scanbench.comm.door import Away, Done, Read
from scanbench.faults.device_shapes import DeviceErrors
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.overlaps import stretch, stretches
from scanbench.runtime.command import Command
from scanbench.server.communication_shapes import ErrorReader
from scanbench.session.session import Session
from scanbench.wire import host as protocol
from scanbench.wire.memory import AreasAre, AreaSpan, ReadAreas
from scanbench.wire.refused import Refused, Unavailable

_1970 = datetime(1970, 1, 1, tzinfo=UTC)
_SPANS_KEPT = 4096


class ErrorReaders:
    """Who reads which word of error memory."""

    def __init__(self, model: Model) -> None:
        words = set(_error_words(model))
        self._words = sorted(words)
        self._model = model
        self._seen: set[tuple[str, AreaSpan]] = set()
        self._clients: dict[tuple[str, int], dict[str, None]] = {}

    def note(self, client: str, spans: Sequence[AreaSpan]) -> None:
        """A client reads these bytes."""
        for span in spans:
            if (client, span) in self._seen:
                continue
            if len(self._seen) >= _SPANS_KEPT:
                self._seen.clear()
            self._seen.add((client, span))
            begin = bisect_left(self._words, (span.area, span.byte // 2))
            end = bisect_left(self._words, (span.area, (span.byte + span.size + 1) // 2))
            for word in self._words[begin:end]:
                self._clients.setdefault(word, {})[client] = None

    @property
    def all(self) -> tuple[ErrorReader, ...]:
        """In the order of the memory."""
        return tuple(ErrorReader(self._shown(*word), tuple(found)) for word, found in sorted(self._clients.items()))

    def _shown(self, area: str, word: int) -> str:
        found = self._model.area(area)
        assert found is not None
        return self._model.word_text(found, 2 * word)


def _error_words(model: Model) -> list[tuple[str, int]]:
    """The code word, and every word that an error writes."""
    found = [] if model.code_word is None else [stretch(model.code_word)]
    for error in model.errors():
        found.append(stretch(error.flag))
        found += stretches(error.also)
        for detail in error.details:
            found += stretches(detail.addresses)
    return [(each.area, word) for each in found for word in range(each.first // 16, -(-each.end // 16))]


class SessionDoor:
    """`comm.door.Door` of one client."""

    def __init__(self, session: Session, author: str, readers: ErrorReaders) -> None:
        self.author, self.model = author, session.model
        self._session, self._readers = session, readers

    async def read(self, spans: Sequence[AreaSpan], also: Sequence[AreaSpan] = ()) -> Read:
        """See `Door`."""
        self._readers.note(self.author, spans)
        wanted = (*spans, *also)
        try:
            found = await self._session.instance.ask(lambda ref: ReadAreas(ref, wanted), AreasAre)
        except (Unavailable, Refused) as error:
            raise Away(str(error)) from error
        if found.message:
            raise Away(found.message)
        return Read(
            found.scan, found.mode, found.stopped, _1970 + timedelta(microseconds=found.clock_ns // 1000), found.data
        )

    def noted(self, spans: Sequence[AreaSpan]) -> None:
        """See `Door`."""
        self._readers.note(self.author, spans)

    async def device(self) -> DeviceErrors:
        """See `Door`."""
        try:
            return await self._session.device.now()
        except (Unavailable, Refused) as error:
            raise Away(str(error)) from error

    async def submit(self, command: Command) -> Done:
        """See `Door`."""
        try:
            ack: protocol.Ack = await self._session.instance.submit(command)
        except Unavailable as error:
            raise Away(str(error)) from error
        except Refused as error:
            return Done(False, str(error))
        return Done(ack.ok, ack.message)
