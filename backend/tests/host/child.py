"""The process of a PLC as its parent sees it, for tests."""

import socket
from collections.abc import Callable
from pathlib import Path
from typing import Self, TypeVar

from scanbench.debug.halt import Halt
from scanbench.host.zygote import zygote
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import host as protocol
from scanbench.wire.codec import Splitter, pack
from scanbench.wire.host import Sources

T = TypeVar("T")
MODEL = "CJ1M-CPU63"


class Child:
    """A host over its socket."""

    def __init__(
        self, run: Path, source: str, cache: Path, driven: protocol.Driven | None = None, until: int = 0
    ) -> None:
        ours, theirs = socket.socketpair()
        self._socket, self._splitter = ours, Splitter()
        ours.settimeout(60)
        self.process = zygote().spawn(theirs, cache)
        theirs.close()
        self.messages: list[object] = []
        self.state: protocol.PlcState | None = None
        """What was told last of it."""
        self._ref = 0
        sources = Sources(MODEL, {"main.st": source}, 10_000_000, 1)
        self.send(protocol.Start("plc", sources, str(run), None, None, None, until, driven))
        self.wait(protocol.Ready)
        self.send(protocol.Attend(True))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        if self.process.wait(0) is None:
            self.send(protocol.Quit())
        self._socket.close()
        self.process.wait(30)

    def send(self, message: object) -> None:
        self._socket.sendall(pack(message))

    def take(self) -> list[object]:
        """What comes next; kept too."""
        data = self._socket.recv(1 << 20)
        assert data, "the host has ended"
        new = list(self._splitter.feed(data))
        self.messages += new
        self.state = next((each for each in reversed(new) if isinstance(each, protocol.PlcState)), self.state)
        return new

    def until(self, test: Callable[[protocol.PlcState], bool]) -> protocol.PlcState:
        """Its state, when it is like that; also where that was told before other messages."""
        while self.state is None or not test(self.state):
            self.take()
        return self.state

    def wait(self, kind: type[T], test: Callable[[T], bool] = lambda message: True) -> T:
        """The first message of this kind that is to come (or came, of those not looked at yet)."""
        seen = 0
        while True:
            for message in self.messages[seen:]:
                if isinstance(message, kind) and test(message):
                    del self.messages[: self.messages.index(message) + 1]
                    return message
            seen = len(self.messages)
            self.take()

    def ask(self, make: Callable[[int], object], kind: type[T]) -> T:
        """A request and its answer."""
        self._ref += 1
        ref = self._ref
        self.send(make(ref))
        return self.wait(kind, lambda message: getattr(message, "ref", None) == ref)

    def step(self, action: debug_protocol.StepAction, **more: object) -> protocol.Ack:
        return self.ask(lambda ref: debug_protocol.Step(ref, action, "Ann", **more), protocol.Ack)  # type: ignore[arg-type]

    def halted(self, after: int = 0) -> Halt:
        """The next halt."""
        state = self.until(lambda state: state.halt is not None and state.halt.number > after)
        assert state.halt is not None
        return state.halt

    def value(self, text: str, frame: int | None = None) -> str:
        found = self.ask(lambda ref: debug_protocol.Evaluate(ref, frame, text, "Ann"), debug_protocol.Evaluated)
        assert found.variable is not None, found.message
        return found.variable.value
