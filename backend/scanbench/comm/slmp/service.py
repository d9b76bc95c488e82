"""The server of SLMP over TCP."""

from collections.abc import Awaitable, Iterator

from scanbench.comm.desk import Desk
from scanbench.comm.door import Door
from scanbench.comm.slmp.commands import described, outcome, respond
from scanbench.comm.slmp.frame import Broken, End, Request, Stream, failure
from scanbench.comm.tcp import Answers, Listener, tcp_server


def slmp_server(desk: Desk) -> Listener:
    """A server that is still closed."""

    def begin(name: str, door: Door) -> Answers:
        stream = Stream()

        async def answer(request: Request, frame: bytes) -> bytes:
            desk.before_request()
            if desk.elsewhere:
                answered, end = failure(request, End.NO_STATION), End.NO_STATION
            else:
                answered, end = await respond(request, door, desk.read_only)
            desk.note(name, described(request, door), outcome(end), frame, answered)
            return answered

        def answers(data: bytes) -> Iterator[Awaitable[bytes]]:
            return (answer(*each) for each in stream.feed(data))

        return answers

    return tcp_server(desk, "SLMP", begin, Broken)
