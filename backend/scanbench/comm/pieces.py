"""Messages out of a stream of bytes, which comes in any pieces."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import Generic, TypeVar

T = TypeVar("T")


class Pieces(ABC, Generic[T]):
    """Cuts what comes in a connection into messages. No more than one that is not whole is ever kept."""

    def __init__(self) -> None:
        self._bytes = bytearray()

    def feed(self, data: bytes) -> Iterator[T]:
        """The messages that are whole now. What `size` raises at what can be none comes out here."""
        self._bytes += data
        while (size := self.size(self._bytes)) and len(self._bytes) >= size:
            frame = bytes(self._bytes[:size])
            del self._bytes[:size]
            yield self.made(frame)

    @abstractmethod
    def size(self, begun: bytearray) -> int:
        """Bytes of the message that begins here; 0 while too few are there to tell."""

    @abstractmethod
    def made(self, frame: bytes) -> T:
        """The message of so many bytes."""
