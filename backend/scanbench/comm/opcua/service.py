"""The server of OPC UA, from the server of Scanbench: a process of its own, which asks through here."""

import asyncio
import logging
from collections.abc import Coroutine
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path

from scanbench.comm.desk import Desk
from scanbench.comm.door import Away, Door, Plc
from scanbench.faults.line_faults import LineFault
from scanbench.host.zygote import OPC_UA, NoProcess, Process
from scanbench.jobs.channel import connect, messages
from scanbench.jobs.client import FAULT
from scanbench.wire.codec import BadMessage, pack
from scanbench.wire.host import Sources
from scanbench.wire.opcua import (
    OpcUaAsked,
    OpcUaClient,
    OpcUaDone,
    OpcUaErrors,
    OpcUaFailed,
    OpcUaFault,
    OpcUaProgram,
    OpcUaReady,
    OpcUaStart,
    OpcUaSubmit,
)
from scanbench.wire.variables import ReadVariables, VariablesAre

log = logging.getLogger("scanbench")
PORT = 4840
"""Registered for OPC UA."""
_START_S = 120.0
SLOW = "its process does not answer"
_UNREAD_BYTES = 64 << 20
FIRST_PAUSE_S, LONGEST_PAUSE_S = 1.0, 30.0
"""Before another process is started; each time that is twice as long, until one has served for longer than the longest."""
_rest = asyncio.sleep


@dataclass(frozen=True, slots=True)
class Place:
    """What servers of all PLCs have in common."""

    cache: Path
    """Where checked programs are kept."""
    certificates: Path
    token: str
    """What users prove with that they may be here."""


class OpcUaServer:
    """A server that is still closed. Its process is started again when it dies."""

    def __init__(self, desk: Desk, plc: Plc, place: Place, anonymous_writes: bool) -> None:
        self._desk, self._plc, self._place, self._anonymous = desk, plc, place, anonymous_writes
        self._doors: dict[str, Door] = {}
        self._times: dict[str, int] = {}
        self._process: Process | None = None
        self._writer: asyncio.StreamWriter | None = None
        self._task: asyncio.Task[None] | None = None
        self._answers: set[asyncio.Task[None]] = set()
        self._told: tuple[Sources, OpcUaErrors] | None = None
        self._host = ""
        self.port = 0
        """0 while it is closed."""
        self.trouble = ""
        """Why it does not listen now, although it is open: its process is gone, and another one is tried again and again."""

    async def open(self, host: str, port: int) -> None:
        """Listens. `OSError`."""
        self._host = host
        ready: asyncio.Future[int] = asyncio.get_running_loop().create_future()
        self._task = asyncio.get_running_loop().create_task(self._live(port, ready))
        try:
            async with asyncio.timeout(_START_S):
                self.port = await asyncio.shield(ready)
        except (TimeoutError, OSError) as error:
            await self.close()
            raise OSError(str(error) or SLOW) from error
        except BaseException:
            await self.close()
            raise

    async def close(self) -> None:
        """Nobody is served any more."""
        self.port = 0
        task, self._task = self._task, None
        if task is not None:
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)

    def break_line(self, fault: LineFault) -> None:
        """Something is wrong with the line to the clients, or nothing any more."""
        self._say(OpcUaFault(fault.kind, fault.late_ms))

    # ---- the process ----------------------------------------------------------------------------------------------

    async def _live(self, port: int, ready: asyncio.Future[int]) -> None:
        """One process after the other; what goes wrong with the first is told by `ready`."""
        ignore = self._plc.listen(self._changed)
        now, pause = asyncio.get_running_loop().time, FIRST_PAUSE_S
        try:
            while True:
                begun = now()
                try:
                    self.trouble = await self._one(port, ready)
                except Exception:
                    log.exception("the process of the OPC UA server of %s could not be served", self._plc.name)
                    self.trouble = FAULT
                if not ready.done():
                    ready.set_exception(OSError(self.trouble))
                if ready.exception() is not None:
                    return
                port = ready.result()
                if now() - begun > LONGEST_PAUSE_S:
                    pause = FIRST_PAUSE_S
                log.error(
                    "the OPC UA server of %s does not listen: %s. Another process is started in %d s",
                    self._plc.name, self.trouble, pause,
                )  # fmt: skip
                await _rest(pause)
                pause = min(2 * pause, LONGEST_PAUSE_S)
        finally:
            ignore()

    async def _one(self, port: int, ready: asyncio.Future[int]) -> str:
        """Serves until the process ends; why it did."""
        try:
            self._process, reader, writer = await connect(self._place.cache, OPC_UA)
        except (NoProcess, OSError) as error:
            return str(error)
        self._writer, self._told = writer, None
        try:
            self._say(self._start(port))
            self._changed()
            async for message in messages(reader):
                if isinstance(message, OpcUaFailed):
                    return message.message
                self._hear(message, ready)
        except BadMessage:
            log.exception("the process of an OPC UA server does not speak the protocol")
        finally:
            self._writer = None
            self._process.kill()
            writer.close()
            for task in list(self._answers):
                task.cancel()
            for name, times in self._times.items():
                for _ in range(times):
                    self._desk.leave(name)
            self._doors, self._times = {}, {}
            await asyncio.to_thread(self._process.wait)
        return FAULT

    def _start(self, port: int) -> OpcUaStart:
        token = sha256(self._place.token.encode()).digest()
        return OpcUaStart(
            self._host, port, self._plc.name, self._plc.model.name, str(self._place.certificates), token,
            not self._desk.read_only, self._anonymous,
        )  # fmt: skip

    def _say(self, message: object) -> None:
        writer = self._writer
        if writer is None or writer.is_closing():
            return
        writer.write(pack(message))
        if writer.transport.get_write_buffer_size() > _UNREAD_BYTES and self._process is not None:
            log.error("the process of an OPC UA server does not read: it is ended")
            self._process.kill()

    def _changed(self) -> None:
        """Tells what the PLC runs, and its errors, where that is new."""
        present, sources = self._plc.errors, self._plc.sources
        errors = OpcUaErrors(present is not None, present or ())
        before, self._told = self._told, (sources, errors)
        if before is None or before[0] != sources:
            self._say(OpcUaProgram(sources))
        if before is None or before[1] != errors:
            self._say(errors)

    # ---- what it says ---------------------------------------------------------------------------------------------

    def _hear(self, message: object, ready: asyncio.Future[int]) -> None:
        match message:
            case OpcUaReady(port):
                self.break_line(self._desk.fault)
                self.trouble = ""
                if not ready.done():
                    ready.set_result(port)
            case OpcUaClient(name, there):
                self._here(name, there)
            case OpcUaAsked(client, text, outcome, spans):
                self._desk.note(client, text, outcome, b"", b"")
                if spans and client in self._doors:
                    self._doors[client].noted(spans)
            case ReadVariables(ref, paths):
                self._answer(self._read(ref, paths))
            case OpcUaSubmit():
                self._answer(self._submit(message))
            case _:
                raise BadMessage(type(message).__name__)

    def _here(self, name: str, there: bool) -> None:
        times = self._times.get(name, 0) + (1 if there else -1)
        if there and not self._desk.arrive(name):
            return
        if not there:
            self._desk.leave(name)
        if times > 0:
            self._times[name] = times
            self._doors.setdefault(name, self._desk.make_door(name))
        else:
            self._times.pop(name, None)
            self._doors.pop(name, None)

    def _answer(self, answering: Coroutine[None, None, None]) -> None:
        task = asyncio.get_running_loop().create_task(answering)
        self._answers.add(task)
        task.add_done_callback(self._answers.discard)

    async def _read(self, ref: int, paths: tuple[str, ...]) -> None:
        try:
            found = await self._plc.variables(paths)
        except Away as error:
            self._say(VariablesAre(ref, 0, 0, "", False, 0, b"", b"", str(error) or "away"))
            return
        self._say(replace(found, ref=ref))

    async def _submit(self, asked: OpcUaSubmit) -> None:
        door = self._doors.get(asked.client)
        if door is None:
            self._say(OpcUaDone(asked.ref, False, "the client is not connected any more"))
            return
        try:
            done = await door.submit(asked.command)
        except Away as error:
            self._say(OpcUaDone(asked.ref, False, str(error), away=True))
            return
        self._say(OpcUaDone(asked.ref, done.ok, done.message))
