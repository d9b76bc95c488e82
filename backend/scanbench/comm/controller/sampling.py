"""Samples of a controller at an interval, over connections that are lost and made again."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from contextlib import aclosing
from dataclasses import dataclass, replace

from scanbench.comm.controller.contract import Connection, Found, Source, Unreachable
from scanbench.runtime.clock import monotonic_ns

Open = Callable[[Connection], Awaitable[Source]]
MOST_AGAIN = 5
"""Reads until the scan after a changed input is over."""
FIRST_S, LONGEST_S = 0.5, 10.0
"""Pause before a connection is tried again: it doubles up to the longest one."""


@dataclass(frozen=True, slots=True)
class Read:
    """A sample: when, and the cells of all columns; those that nobody wants are empty."""

    at_ns: int
    """On this machine, in the middle between question and answer."""
    cells: tuple[str, ...]
    after_break: bool = False
    """The connection was lost before it."""


@dataclass(frozen=True, slots=True)
class Settling:
    """What says that the outputs of a sample belong to its inputs."""

    scan: int
    """Place of the column that counts scans."""
    inputs: tuple[int, ...]
    """Places of the columns that the reference is given."""


class Sampler:
    """Of one controller."""

    def __init__(self, connection: Connection, open: Open, on_trouble: Callable[[str], None]) -> None:
        """`on_trouble` is told why there are no samples, and an empty text when there are again."""
        self._connection, self._open, self._on_trouble = connection, open, on_trouble
        self._source: Source | None = None
        self.found = Found(())
        self._last: Read | None = None
        """The one that was handed on last."""

    async def begin(self) -> Found:
        """Connects for the first time, and asks what there is; `Unreachable`."""
        self._source = await self._open(self._connection)
        self.found = await self._source.find()
        return self.found

    async def close(self) -> None:
        """Leaves the controller."""
        source, self._source = self._source, None
        if source is not None:
            await source.close()

    async def once(self, wanted: Sequence[int]) -> Read:
        """One sample, from the connection that is open; `Unreachable`."""
        if self._source is None:
            raise Unreachable("the connection was left while the verification was stopped")
        before = monotonic_ns()
        cells = await self._source.read(wanted)
        row = [""] * len(self.found.columns)
        for at, cell in zip(wanted, cells, strict=True):
            row[at] = cell
        read = Read((before + monotonic_ns()) // 2, tuple(row))
        self._last = self._last or read
        return read

    async def samples(self, wanted: Sequence[int], settling: Settling | None = None) -> AsyncIterator[Read]:
        """One after the other, for ever. A lost connection is made again; `Unreachable` where that is of no use.

        Without `settling`, an input that was written after the last scan may come with the outputs of that scan.
        """
        every, loop, lost = self._connection.interval_ms / 1000, asyncio.get_running_loop(), False
        due = loop.time()
        while True:
            await asyncio.sleep(max(0.0, due - loop.time()))
            try:
                found = await self.once(wanted)
                read = found if settling is None else await self._settled(wanted, settling, found)
            except Unreachable as error:
                await self._again(error)
                lost, due = True, loop.time()
                continue
            if read is not None:
                yield replace(read, after_break=lost)
                lost = False
            due = max(due + every, loop.time())

    async def _settled(self, wanted: Sequence[int], settling: Settling, read: Read) -> Read | None:
        """A sample whose inputs were there before its scan; None: the controller runs no scan with the inputs that it has now.

        Where inputs changed, they are read again after a further scan. Inputs that change in each scan are taken as they are.
        """
        before = self._last or read
        for _ in range(MOST_AGAIN):
            if all(read.cells[at] == before.cells[at] for at in settling.inputs):
                break
            later = await self._after(wanted, settling, read)
            if later is None:
                return None
            before, read = read, later
        self._last = read
        return read

    async def _after(self, wanted: Sequence[int], settling: Settling, read: Read) -> Read | None:
        """The next sample of a further scan."""
        for _ in range(MOST_AGAIN):
            await asyncio.sleep(self._connection.interval_ms / 1000 / MOST_AGAIN)
            later = await self.once(wanted)
            if later.cells[settling.scan] != read.cells[settling.scan]:
                return later
        return None

    async def _again(self, error: Unreachable) -> None:
        """Connects again, as often as it takes."""
        pause = FIRST_S
        await self.close()
        while True:
            if error.for_good:
                raise error
            self._on_trouble(f"{error.message}. It is tried again")
            await asyncio.sleep(pause)
            pause = min(2 * pause, LONGEST_S)
            try:
                self._source = await self._open(self._connection)
                again = await self._source.find()
                if again.columns != self.found.columns:
                    raise Unreachable(
                        "the controller has other variables than before: begin a new verification", for_good=True
                    )
                self._on_trouble("")
                return
            except Unreachable as new:
                await self.close()
                error = new


async def taken(sampler: Sampler, wanted: Sequence[int], settling: Settling | None, most: int) -> AsyncIterator[Read]:
    """So many samples at most."""
    async with aclosing(sampler.samples(wanted, settling)) as samples:  # type: ignore[type-var]
        count = 0
        async for each in samples:
            yield each
            count += 1
            if count >= most:
                return
