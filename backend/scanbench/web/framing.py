"""DAP and LSP on a stream of bytes: `Content-Length: N`, an empty line, N bytes of JSON."""

import json
import re

LARGEST = 64 << 20
_LONGEST_HEADER = 4096
_MOST_DIGITS = 18
_LENGTH = re.compile(rb"content-length:[ \t]*0*(\d+)[ \t]*\Z", re.IGNORECASE)


class BadFrame(Exception):
    """What came is no message, and nobody can say where the next one begins."""


class Framing:
    """Takes bytes as they come, however they are cut, and gives whole messages."""

    def __init__(self) -> None:
        self._bytes = bytearray()
        self._length: int | None = None

    def feed(self, data: bytes) -> list[bytes]:
        """The bodies of the messages that are whole now."""
        self._bytes += data
        found = []
        while (message := self._next()) is not None:
            found.append(message)
        return found

    def _next(self) -> bytes | None:
        if self._length is None:
            end = self._bytes.find(b"\r\n\r\n")
            if end < 0:
                if len(self._bytes) > _LONGEST_HEADER:
                    raise BadFrame("a header has no end: is this a debug or language client?")
                return None
            self._length = _length(bytes(self._bytes[:end]))
            del self._bytes[: end + 4]
        if len(self._bytes) < self._length:
            return None
        message = bytes(self._bytes[: self._length])
        del self._bytes[: self._length]
        self._length = None
        return message


def _length(header: bytes) -> int:
    for line in header.split(b"\r\n"):
        match = _LENGTH.match(line)
        if match:
            digits = match.group(1)
            if len(digits) > _MOST_DIGITS or int(digits) > LARGEST:
                raise BadFrame(f"a message of {digits[:20].decode()} bytes is larger than {LARGEST >> 20} MiB")
            return int(digits)
    raise BadFrame(f"a header has no Content-Length: {header[:80]!r}")


def parsed(body: bytes) -> object:
    """What a body says; its text where it is no JSON: whoever serves it says what is wrong with it."""
    try:
        return json.loads(body)
    except (ValueError, RecursionError):
        return body.decode(errors="replace")


def framed(message: dict[str, object]) -> bytes:
    """A message as it goes over the stream."""
    text = json.dumps(message, ensure_ascii=False, separators=(",", ":"))
    data = text.encode(errors="backslashreplace")  # half of a surrogate pair: as JSON would write it
    return b"Content-Length: %d\r\n\r\n%s" % (len(data), data)
