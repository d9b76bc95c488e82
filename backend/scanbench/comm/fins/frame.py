"""Frames of FINS: bytes to a request, an answer to bytes. (Wireshark `packet-omron-fins.c`, libfins.)

0  ICF  80 a command, 40 an answer, 01 no answer is wanted
1  RSV  00
2  GCT  gateways that are left
3  DNA, DA1, DA2  network, node and unit of the destination
6  SNA, SA1, SA2  of the source
9  SID  the sender's number, which comes back
10 MRC, SRC  the command
12 its parameters
"""

from dataclasses import dataclass
from struct import Struct

HEAD = 12
LARGEST = 2012
"""Bytes of a frame."""
_ANSWERS, _UNANSWERED = 0x40, 0x01
_END = Struct(">H")


@dataclass(frozen=True, slots=True)
class Request:
    """A command as it came."""

    head: bytes
    """The first ten bytes."""
    command: int
    """MRC and SRC: 0101 is memory area read."""
    body: bytes

    @property
    def wants_answer(self) -> bool:
        """False: it is done, and nothing is sent."""
        return not self.head[0] & _UNANSWERED

    @property
    def unit(self) -> int:
        """DA2: 0 is the CPU Unit."""
        return self.head[5]

    @property
    def node(self) -> int:
        """SA1: whose it is."""
        return self.head[7]


def parse(frame: bytes) -> Request | None:
    """The request in a frame; None where there is none: too short, or an answer."""
    if len(frame) < HEAD or frame[0] & _ANSWERS:
        return None
    return Request(frame[:10], int.from_bytes(frame[10:12], "big"), frame[12:])


def answer(request: Request, end: int, body: bytes = b"") -> bytes:
    """The frame that answers it: source and destination change places."""
    head = request.head
    turned = bytes((head[0] | _ANSWERS, 0, 2)) + head[6:9] + head[3:6] + head[9:10]
    return turned + request.command.to_bytes(2, "big") + _END.pack(end) + body
