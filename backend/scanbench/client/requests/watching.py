"""Watching: values as they change, by the PLC's WebSocket."""

import json
import struct
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import cast

from scanbench.client.asking import Hear, Refused, Say, Steps, asked
from scanbench.client.requests.traces import Number, number
from scanbench.client.shapes.running import Symbol, Watched, Watching
from scanbench.runtime.clock import monotonic_ns

_HEAD = struct.Struct("<BBHIQq")
_TEXT = struct.Struct("<II")
"""Of frames, as `web/socket/frames.py` has them."""
_ANSWER_S = 60.0
_REF = 1


@dataclass(frozen=True, slots=True)
class Frame:
    """What is watched, between two scans. There are 20 of them a second at most, and one only where something changed."""

    scan: int
    """The scan that is next."""
    time_ns: int
    """When it begins, in the time of the PLC."""
    values: Mapping[str, Number | str | None]
    """All that is watched, by its path: BOOL as bool, REAL as float, texts as str, references as what they refer to
    (`-> Main.tank[3].level`, `NULL`), times and dates as ns, other types as int. None: an in-out
    that leads nowhere yet."""
    changed: frozenset[str]
    """The paths whose values came with this frame."""


class WatchRequests:
    """Paths that are watched as long as the connection lasts; each iteration waits for the next frame. None is lost: a script that is slower
    than they come lags behind."""

    def __init__(self, paths: Sequence[str]) -> None:
        self._paths = tuple(paths)
        self._symbols: dict[int, tuple[str, Symbol]] = {}
        self._values: dict[str, Number | str | None] = dict.fromkeys(self._paths)

    @asked
    def next(self, timeout_s: float | None = None) -> Steps[Frame]:
        """The next frame; `TimeoutError` when none comes for so long, None waits for ever."""
        return self._next(timeout_s)

    def _begin(self) -> Steps[None]:
        yield Say(json.dumps({"type": "watch", "ref": _REF, "paths": list(self._paths)}))
        while True:
            came = yield Hear(_ANSWER_S)
            if isinstance(came, str) and self._take_text(came):
                return

    def _next(self, timeout_s: float | None) -> Steps[Frame]:
        end = None if timeout_s is None else monotonic_ns() + int(timeout_s * 1e9)
        while True:
            came = yield Hear(None if end is None else max(0.0, (end - monotonic_ns()) / 1e9))
            if isinstance(came, str):
                self._take_text(came)
                continue
            _, _, _, _, scan, time_ns = _HEAD.unpack_from(came)
            changed = dict(self._read(came))
            self._values |= changed
            if changed:
                return Frame(scan, time_ns, dict(self._values), frozenset(changed))

    def _take_text(self, text: str) -> bool:
        """Whether it tells where in frames what is watched is: at first, and when a new program moved it."""
        message = json.loads(text)
        if message["type"] != "watching":
            return False
        told = cast(Watching, message)
        self._symbols |= {id: found for item in told["items"] for id, found in _placed(item)}
        return told["ref"] == _REF

    def _read(self, data: bytes) -> Iterator[tuple[str, Number | str]]:
        _, _, _, count, _, _ = _HEAD.unpack_from(data)
        ids = struct.unpack_from(f"<{count}I", data, _HEAD.size)
        at = _HEAD.size + 4 * (count + count % 2)
        for id, raw in zip(ids, struct.unpack_from(f"<{count}Q", data, at), strict=True):
            if id in self._symbols:
                path, symbol = self._symbols[id]
                yield path, number(raw, symbol["kind"], symbol["size"])
        at += 8 * count
        (texts,) = struct.unpack_from("<I", data, at)
        at += 4
        for _ in range(texts):
            id, length = _TEXT.unpack_from(data, at)
            at += _TEXT.size
            if id in self._symbols:
                path, symbol = self._symbols[id]
                yield path, data[at : at + length].decode(_encoding(symbol), "replace")
            at += length


def _encoding(symbol: Symbol) -> str:
    if symbol["kind"] == "ref":
        return "utf-8"
    return "utf-16-le" if symbol["type"].upper().startswith("WSTRING") else "latin-1"


def _placed(item: Watched) -> Iterator[tuple[int, tuple[str, Symbol]]]:
    path, symbol, refusal = item["path"], item["symbol"], item["refusal"]
    if refusal is not None:
        raise Refused(refusal["message"], tuple(refusal.get("near", ())))
    if symbol is None or item["id"] is None or symbol["expandable"]:
        raise Refused(f"`{path}` has no single value: watch its members")
    yield item["id"], (path, symbol)
