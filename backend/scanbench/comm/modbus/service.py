"""The server of Modbus TCP. Requests of a connection are answered one after the other, each with its own transaction."""

from collections.abc import Awaitable, Callable, Iterator

from scanbench.comm.desk import ELSEWHERE, Desk
from scanbench.comm.door import Door
from scanbench.comm.modbus.frame import Broken, Code, Request, Stream, failure
from scanbench.comm.modbus.functions import Target, described, outcome, respond
from scanbench.comm.modbus.mapping import Mapped
from scanbench.comm.tcp import Answers, Listener, tcp_server


def modbus_server(desk: Desk, table: Callable[[], tuple[Mapped, ...]]) -> Listener:
    """A server that is still closed. `table` says what registers mean, which may change."""

    def begin(name: str, door: Door) -> Answers:
        stream = Stream()

        async def answer(request: Request, frame: bytes) -> bytes:
            desk.before_request()
            if desk.elsewhere:
                answered, told = failure(request, Code.NO_TARGET), f"{Code.NO_TARGET:02X} {ELSEWHERE}"
            else:
                answered, code = await respond(request, Target(door, table()), desk.read_only)
                told = outcome(code)
            desk.note(name, described(request), told, frame, answered)
            return answered

        def answers(data: bytes) -> Iterator[Awaitable[bytes]]:
            return (answer(*each) for each in stream.feed(data))

        return answers

    return tcp_server(desk, "Modbus", begin, Broken)
