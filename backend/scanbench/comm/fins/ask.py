"""The other side of FINS: requests as a client sends them, and what their answers say. No socket. (W342, section 5.)

Over UDP a request is a datagram. Over TCP a client sends `hello()`, takes its node from the answer (`nodes_of`), and puts
`tcp_frame.message(Kind.FRAME, ...)` around each request.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from scanbench.comm.fins import tcp_frame
from scanbench.comm.fins.areas import swapped, word_code
from scanbench.comm.fins.codes import FATAL, NONFATAL
from scanbench.comm.fins.frame import HEAD

MOST_READ, MOST_WRITTEN = 999, 996
"""Words of a request. (W342, section 5-3-2.)"""
_COMMAND, _SILENT, _GATEWAYS, _ANSWER = 0x80, 0x01, 0x02, 0x40
_RELAYED = 0x8000


class BadAnswer(Exception):
    """What came is no answer to what was asked: the message says why."""


@dataclass(frozen=True, slots=True)
class Address:
    """Where a frame comes from, or goes to."""

    network: int = 0
    """0 is the local one."""
    node: int = 0
    unit: int = 0
    """0 is the CPU Unit."""

    @property
    def bytes(self) -> bytes:
        """As a frame has it."""
        return bytes((self.network, self.node, self.unit))


@dataclass(frozen=True, slots=True)
class Answer:
    """What came back."""

    end: int
    """The end code, without the bits that tell of errors of the CPU Unit: 0 is done."""
    nonfatal: bool
    """The CPU Unit has a non-fatal error."""
    fatal: bool
    body: bytes


def request(
    command: int, body: bytes, to: Address, source: Address, number: int, wants_answer: bool = True
) -> bytes:  # fmt: skip
    """The frame of a command: MRC and SRC, and its parameters. `number` (SID, 0 to 255) comes back in the answer."""
    icf = _COMMAND | (0 if wants_answer else _SILENT)
    return (
        bytes((icf, 0, _GATEWAYS))
        + to.bytes
        + source.bytes
        + bytes((number & 0xFF,))
        + command.to_bytes(2, "big")
        + body
    )


def answer_to(asked: bytes, frame: bytes) -> Answer:
    """What a frame says that answers this request; `BadAnswer`: too short, or of a different request."""
    if len(frame) < HEAD + 2:
        raise BadAnswer(f"an answer of {len(frame)} bytes is too short")
    if not frame[0] & _ANSWER:
        raise BadAnswer("it is a command, and no answer")
    if frame[9:12] != asked[9:12]:
        raise BadAnswer("it answers a different request")
    code = int.from_bytes(frame[12:14], "big")
    end = code & ~(_RELAYED | NONFATAL | FATAL)
    return Answer(end, bool(code & NONFATAL), bool(code & FATAL), frame[14:])


def read_words(area: str, word: int, count: int) -> bytes:
    """The parameters of 0101, memory area read; `ValueError` where FINS has no such area."""
    return _place(area, word) + count.to_bytes(2, "big")


def write_words(area: str, word: int, data: bytes) -> bytes:
    """The parameters of 0102, memory area write. `data`: words as they lie in memory, low byte first."""
    return _place(area, word) + (len(data) // 2).to_bytes(2, "big") + swapped(data)


def words_of(answer: Answer, count: int) -> bytes:
    """The words of an answer to 0101 as they lie in memory; `BadAnswer` where they are not so many."""
    if len(answer.body) != 2 * count:
        raise BadAnswer(f"{len(answer.body)} bytes came for {count} words")
    return swapped(answer.body)


def read_places(places: Sequence[tuple[str, int]]) -> bytes:
    """The parameters of 0104, multiple memory area read, of words here and there."""
    return b"".join(_place(area, word) for area, word in places)


def words_of_places(answer: Answer, places: Sequence[tuple[str, int]]) -> list[int]:
    """The words of an answer to 0104, in their order; `BadAnswer`."""
    if len(answer.body) != 3 * len(places):
        raise BadAnswer(f"{len(answer.body)} bytes came for {len(places)} words")
    return [int.from_bytes(answer.body[at + 1 : at + 3], "big") for at in range(0, len(answer.body), 3)]


def hello(node: int = 0) -> bytes:
    """What a client sends first over TCP: the node that it wants, 0 for any."""
    return tcp_frame.message(tcp_frame.Kind.ASK_NODE, node.to_bytes(4, "big"))


def nodes_of(message: tcp_frame.Message) -> tuple[int, int]:
    """The nodes of the client and of the server, from the answer to `hello`; `BadAnswer`."""
    if message.kind != tcp_frame.Kind.GIVE_NODE or len(message.content) < 8:
        raise BadAnswer("the server gives no node")
    return int.from_bytes(message.content[:4], "big"), int.from_bytes(message.content[4:8], "big")


def _place(area: str, word: int) -> bytes:
    code = word_code(area)
    if code is None:
        raise ValueError(f"FINS has no area {area}")
    return bytes((code,)) + word.to_bytes(2, "big") + b"\0"
