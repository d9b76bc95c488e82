"""What the people at one PLC watch: told to each of its processes, and frames to each of them."""

from collections.abc import Callable, Iterable, Mapping, Sequence

from scanbench.session.instance import Telling
from scanbench.session.watches import Watches
from scanbench.wire import events
from scanbench.wire import host as protocol
from scanbench.wire.events import Event, Subscriber

_EVERYBODY = 0


class Watching:
    """Asks the host by a number of its own, whose answer is for one subscriber."""

    def __init__(
        self, tell: Callable[[Telling], object], publish: Callable[[Event], None], subscribers: Mapping[int, Subscriber]
    ) -> None:
        self._tell, self._publish, self._subscribers = tell, publish, subscribers
        self._watches = Watches()
        self._questions: dict[int, tuple[int, int, tuple[tuple[int, str], ...]]] = {}
        self._next_question = _EVERYBODY + 1
        self._lost = False
        """What is watched must be told to the next host."""

    def watch(self, subscriber: int, ref: int, paths: Sequence[str]) -> None:
        """Watches paths; the answer is a `Watching` event, before any frame with the new ids.

        All subscribers share the ids, each value is in the frames once.
        """
        pairs = self._watches.add(subscriber, paths)
        question, self._next_question = self._next_question, self._next_question + 1
        self._questions[question] = (subscriber, ref, pairs)  # whoever is not there now is asked when it is
        self._tell(protocol.WatchPaths(question, pairs))

    def unwatch(self, subscriber: int, ids: Iterable[int]) -> None:
        """Ends watching for this subscriber."""
        self._end(self._watches.forget(subscriber, ids))

    def drop(self, subscriber: int) -> None:
        """The subscriber is gone, and what only it watched is watched no more."""
        self._end(self._watches.drop(subscriber))

    def want_snapshot(self, subscriber: int) -> None:
        """A frame with all values, for this subscriber alone."""
        self._tell(protocol.WantSnapshot(subscriber))

    def _end(self, ids: Sequence[int]) -> None:
        if ids:
            self._tell(protocol.UnwatchIds(tuple(ids)))

    # ---- from the host --------------------------------------------------------------------------------------------

    def on_gone(self) -> None:
        """The process is gone."""
        self._lost = True

    def on_ready(self) -> None:
        """Tells a new host process what the last one knew."""
        if self._lost:
            self._lost = False
            self._tell(protocol.WatchPaths(_EVERYBODY, self._watches.all()))
        for question, (_, _, pairs) in self._questions.items():
            self._tell(protocol.WatchPaths(question, pairs))

    def on_message(self, message: object) -> bool:
        """What the host says; whether it was for who watches."""
        match message:
            case protocol.Frame():
                self._on_frame(message)
            case protocol.Watching():
                self._on_watching(message)
            case _:
                return False
        return True

    def _on_frame(self, frame: protocol.Frame) -> None:
        if frame.to is None:
            for subscriber in self._subscribers.values():
                subscriber.on_frame(frame.data)
        elif frame.to in self._subscribers:
            self._subscribers[frame.to].on_snapshot(frame.data)

    def _on_watching(self, answer: protocol.Watching) -> None:
        if answer.ref is None or answer.ref == _EVERYBODY:
            self._publish(events.Watching(None, answer.items))
            return
        subscriber, ref, _ = self._questions.pop(answer.ref, (0, 0, ()))
        self._end(self._watches.forget(subscriber, [item.id for item in answer.items if not item.sent]))
        if subscriber in self._subscribers:
            self._subscribers[subscriber].on_event(events.Watching(ref, answer.items))
