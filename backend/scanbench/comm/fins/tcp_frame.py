"""What FINS over TCP puts before frames, and the handshake that gives a client its node. (nmap `omron-info`, npm `omron-fins`.)

0   FINS
4   u32  bytes after this field
8   u32  command: 0 and 1 the handshake, 2 a frame, 3 an error, 6 is the connection there
12  u32  error
16  content
"""

from dataclasses import dataclass
from enum import IntEnum
from struct import Struct

from scanbench.comm.fins.frame import LARGEST
from scanbench.comm.pieces import Pieces

HEAD = Struct(">4sIII")
_MAGIC = b"FINS"
_COUNTED = 8
"""Bytes of the head that its length counts."""
_NODES = Struct(">II")


class Kind(IntEnum):
    """The command of a message."""

    ASK_NODE = 0
    GIVE_NODE = 1
    FRAME = 2
    ERROR = 3
    CONFIRM = 6


class Error(IntEnum):
    """What is wrong with a message, or a connection."""

    NO_FINS = 1
    TOO_LONG = 2
    UNKNOWN = 3
    ALL_IN_USE = 0x20
    NO_NODE = 0x25


class Broken(Exception):
    """The connection is told of this error, and closed."""

    def __init__(self, error: Error) -> None:
        super().__init__(error.name)
        self.error = error


@dataclass(frozen=True, slots=True)
class Message:
    """One message of a connection."""

    kind: int
    content: bytes


class Stream(Pieces[Message]):
    """The messages of a connection; `Broken`."""

    def size(self, begun: bytearray) -> int:
        """See `Pieces`."""
        if len(begun) < HEAD.size:
            return 0
        magic, length, _, _ = HEAD.unpack_from(begun)
        if magic != _MAGIC:
            raise Broken(Error.NO_FINS)
        if not _COUNTED <= length <= LARGEST + _COUNTED:
            raise Broken(Error.TOO_LONG)
        return HEAD.size - _COUNTED + int(length)

    def made(self, frame: bytes) -> Message:
        """See `Pieces`."""
        return Message(HEAD.unpack_from(frame)[2], frame[HEAD.size :])


def message(kind: Kind, content: bytes = b"", error: int = 0) -> bytes:
    """A message as one piece: some clients take the first piece that comes for all of it."""
    return HEAD.pack(_MAGIC, _COUNTED + len(content), kind, error) + content


def asked_node(content: bytes) -> int:
    """The node that a client wants; 0 is any."""
    return int.from_bytes(content[:4], "big")


def given_nodes(client: int, server: int) -> bytes:
    """The answer to a handshake."""
    return message(Kind.GIVE_NODE, _NODES.pack(client, server))
