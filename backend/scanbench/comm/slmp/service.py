"""The server of SLMP over TCP."""

from collections.abc import Awaitable, Iterator

from scanbench.comm.desk import ELSEWHERE, Desk
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
                answered, told = failure(request, End.NO_STATION), f"{End.NO_STATION:04X} {ELSEWHERE}"
            else:
                answered, end = await respond(request, door, desk.read_only)
                told = outcome(end)
            desk.note(name, described(request, door), told, frame, answered)
            return answered

        def answers(data: bytes) -> Iterator[Awaitable[bytes]]:
            return (answer(*each) for each in stream.feed(data))

        return answers

    return tcp_server(desk, "SLMP", begin, Broken)
