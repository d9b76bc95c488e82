"""What goes on in a server and comes back when it starts again, as small files: verifications and campaigns."""

import asyncio
import json
import logging
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from scanbench.wire.codec import BadMessage, pack_body, unpack_kept

log = logging.getLogger("scanbench")
SUFFIX, DATA = ".going", ".data"


@dataclass(frozen=True, slots=True)
class Going:
    """One, as it was when it changed last."""

    id: int
    status: object
    """Packed by the codec."""
    more: dict[str, str]
    data: Path
    """A file that belongs to it; it need not be there."""


class GoingFiles:
    """`directory` has a file for each. They are written one after the other by a thread of their own."""

    def __init__(self, directory: Path) -> None:
        self._directory = directory
        self._writer = ThreadPoolExecutor(1, "going")

    def keep(self, id: int, status: object, more: dict[str, str], data: Path | None = None) -> None:
        """Has it written, soon; `data` is copied when it is not there yet."""
        text = json.dumps({"status": pack_body(status).hex(), "more": more})
        self._writer.submit(self._write, id, text, data)

    def forget(self, id: int) -> None:
        """It does not come back."""
        self._writer.submit(self._remove, id)

    async def close(self) -> None:
        """Waits until all is written."""
        await asyncio.to_thread(self._writer.shutdown)

    def all(self) -> Iterator[Going]:
        """Those of the server before, the oldest first. What cannot be read is forgotten. Waits for the disk."""
        self._directory.mkdir(parents=True, exist_ok=True)
        paths = {int(each.stem): each for each in self._directory.glob(f"*{SUFFIX}") if each.stem.isdigit()}
        for id, path in sorted(paths.items()):
            try:
                found = json.loads(path.read_text("utf-8"))
                status = unpack_kept(bytes.fromhex(found["status"]))
                yield Going(id, status, dict(found["more"]), self._directory / f"{id}{DATA}")
            except (OSError, ValueError, KeyError, TypeError, BadMessage) as error:
                log.warning("%s cannot be taken up again: %s", path.name, error)
                self._remove(id)

    def _write(self, id: int, text: str, data: Path | None) -> None:
        try:
            self._directory.mkdir(parents=True, exist_ok=True)
            copy = self._directory / f"{id}{DATA}"
            if data is not None and not copy.exists():
                copy.write_bytes(data.read_bytes())
            new = self._directory / f"{id}.new"
            new.write_text(text, "utf-8")
            new.replace(self._directory / f"{id}{SUFFIX}")
        except OSError as error:
            log.warning("number %d would not come back after a restart: %s", id, error)

    def _remove(self, id: int) -> None:
        for suffix in (SUFFIX, DATA):
            (self._directory / f"{id}{suffix}").unlink(missing_ok=True)
