"""A client of a plant that is a server of Modbus TCP (Factory I/O and the like): its values are inputs of the PLC, and outputs are its values.

What the plant says is entered as one command for each exchange, with the plant as author: it is in the run, which replays without
the plant. Values that are there already are not kept.
"""

import asyncio
from asyncio import StreamReader, StreamWriter
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from scanbench.comm.desk import Desk
from scanbench.comm.door import Away, Door
from scanbench.comm.modbus import ask
from scanbench.comm.modbus.frame import Broken, Request, Stream
from scanbench.comm.modbus.functions import described
from scanbench.comm.modbus.wires import PlantWanted, Wires, answers_bit, cleared, wires
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.write_areas import AreaWrite, WriteAreas

PATIENCE_S, AGAIN_S = 2.0, 1.0
"""How long an answer is waited for, and how long after a loss the plant is called again."""
_PIECE = 4096
_TRANSACTIONS = 1 << 16
_MS_NS = 1_000_000
NOT_THERE = (OSError, EOFError, Broken, ask.BadAnswer)
"""What it means that the plant does not answer; `TimeoutError` is one of the first."""


@dataclass(slots=True)
class Line:
    """A connection to the plant."""

    reader: StreamReader
    writer: StreamWriter
    stream: Stream
    came: deque[tuple[Request, bytes]]
    transaction: int = 0

    async def answer(self) -> tuple[Request, bytes]:
        """The next frame that comes. `OSError`, `EOFError`, `Broken`."""
        while not self.came:
            async with asyncio.timeout(PATIENCE_S):
                data = await self.reader.read(_PIECE)
            if not data:
                raise EOFError("the plant ended the connection")
            self.came.extend(self.stream.feed(data))
        return self.came.popleft()


class PlantClient:
    """Of one PLC, for as long as `run` runs. `tell` is given a sentence when the plant is found or lost."""

    def __init__(self, door: Door, wanted: PlantWanted, desk: Desk, tell: Callable[[str], None]) -> None:
        """`Refused` where the settings make no sense."""
        self._door, self._wanted, self._desk, self._tell = door, wanted, desk, tell
        found = wires(door.model, wanted)
        self._inputs = [piece for each in found if not each.to_plant for piece in each.pieces()]
        self._outputs = [piece for each in found if each.to_plant for piece in each.pieces()]
        self._cleared = cleared(found) if wanted.lost == "clear" else []
        self._answers = answers_bit(door.model, wanted)
        self.answers = False
        self.trouble = ""
        """Why it does not answer, or why its values are not entered; empty: nothing is wrong."""
        self.exchanges = 0
        self.took_ms = 0.0
        """The last exchange."""

    async def run(self) -> None:
        """Exchanges values for ever."""
        while True:
            try:
                await self._talk()
            except NOT_THERE as error:
                await self.lost(_why(error))
            await asyncio.sleep(AGAIN_S)

    async def _talk(self) -> None:
        wanted = self._wanted
        self._refuse()
        async with asyncio.timeout(PATIENCE_S):
            reader, writer = await asyncio.open_connection(wanted.host, wanted.port)
        line = Line(reader, writer, Stream(), deque())
        try:
            while True:
                begun = monotonic_ns()
                await self._exchange(line)
                self.took_ms = (monotonic_ns() - begun) / _MS_NS
                await asyncio.sleep(max(0.0, (wanted.every_ms - self.took_ms) / 1000))
        finally:
            writer.close()

    async def _exchange(self, line: Line) -> None:
        self._refuse()
        writes: list[AreaWrite] = []
        for each in self._inputs:
            writes += each.writes(await self._read(line, each))
        if self._answers is not None:
            writes.append(self._answers)
        if not await self._enter(writes):
            return
        if self._outputs:
            try:
                values = await self._door.read([each.span for each in self._outputs])
            except Away as away:
                self.trouble = str(away)
                return
            for each, data in zip(self._outputs, values.data, strict=True):
                await self._write(line, each, each.values(data))
        self.exchanges += 1
        if not self.answers:
            self.answers = True
            self._desk.arrive(self._door.author)
            self._tell(f"the plant at {self._wanted.host}:{self._wanted.port} answers")

    def _refuse(self) -> None:
        """Where the fault of the line is that nobody can connect."""
        if self._desk.fault.kind == "refused":
            raise ConnectionRefusedError("nobody can connect")

    async def _enter(self, writes: Sequence[AreaWrite]) -> bool:
        """Whether the PLC took it, and is there at all."""
        try:
            done = await self._door.submit(WriteAreas(self._door.author, tuple(writes)))
        except Away as away:
            self.trouble = str(away)
            return False
        self.trouble = "" if done.ok else done.message
        return done.ok

    async def lost(self, why: str) -> None:
        """There is no exchange now: what the PLC gets to know of it."""
        told = f"the plant at {self._wanted.host}:{self._wanted.port} does not answer: {why}"
        if self.answers:
            self._desk.leave(self._door.author)
            self._tell(told)
        self.answers = False
        off = (
            []
            if self._answers is None
            else [AreaWrite(self._answers.area, self._answers.byte, b"\0", self._answers.bit)]
        )
        if writes := [*self._cleared, *off]:
            await self._enter(writes)
        self.trouble = told

    async def _read(self, line: Line, wires: Wires) -> bytes:
        line.transaction = (line.transaction + 1) % _TRANSACTIONS
        request, frame = ask.read(line.transaction, self._wanted.unit, wires.group, wires.first, wires.count)

        def read(came: Request) -> bytes:
            return ask.data_of(request, came, wires.bits)

        return await self._asked(line, request, frame, read)

    async def _write(self, line: Line, wires: Wires, data: bytes) -> None:
        line.transaction = (line.transaction + 1) % _TRANSACTIONS
        request, frame = ask.write(line.transaction, self._wanted.unit, wires.group, wires.first, wires.count, data)

        def read(came: Request) -> bytes:
            ask.check_written(request, came)
            return b""

        await self._asked(line, request, frame, read)

    async def _asked(self, line: Line, request: Request, frame: bytes, read: Callable[[Request], bytes]) -> bytes:
        name, answered, outcome = self._door.author, b"", ""
        try:
            self._desk.before_request()
            line.writer.write(frame)
            await line.writer.drain()
            came, answered = await line.answer()
            async with asyncio.timeout(PATIENCE_S):
                if not await self._desk.on_the_way(answered):
                    await asyncio.Event().wait()
            return read(came)
        except NOT_THERE as error:
            outcome = _why(error)
            raise
        finally:
            self._desk.note(name, described(request), outcome, frame, answered)


def _why(error: Exception) -> str:
    """For people."""
    if isinstance(error, TimeoutError):
        return f"no answer came within {PATIENCE_S:g} s"
    if isinstance(error, Broken):
        return "what came is no Modbus"
    if isinstance(error, OSError):
        return error.strerror or str(error) or "the connection was cut"
    return str(error)
