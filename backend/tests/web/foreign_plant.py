"""A plant that somebody else's Modbus server is: pymodbus, in a thread of its own."""

import asyncio
import threading
from types import TracebackType
from typing import Any, Self

from pymodbus.constants import ExcCodes
from pymodbus.server import ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice

COILS, DISCRETE, HOLDING, INPUT = 1, 2, 3, 4
_GROUPS = {15: COILS, 16: HOLDING}
_SIZE = 64


class ForeignPlant:
    """Listens within `with`; `stop` and `start` are what happens to its machine."""

    def __init__(self) -> None:
        self._values = {each: [0] * _SIZE for each in (COILS, DISCRETE, HOLDING, INPUT)}
        bits, words = DataType.BITS, DataType.REGISTERS
        self._device = SimDevice(0, (_block(bits), _block(bits), _block(words), _block(words)), action=self._asked)
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._server: ModbusTcpServer | None = None
        self.port = 0

    def __enter__(self) -> Self:
        self._thread.start()
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    def start(self) -> None:
        """At the port that it had."""
        self._now(self._start())

    def stop(self) -> None:
        """Every connection ends."""
        if self._server is not None:
            self._now(self._server.shutdown())  # type: ignore[no-untyped-call]
            self._server = None

    def set(self, group: int, first: int, *values: int) -> None:
        """What its sensors say."""
        self._values[group][first : first + len(values)] = values

    def get(self, group: int, first: int, count: int = 1) -> list[int]:
        """What its actuators are told."""
        return self._values[group][first : first + count]

    async def _asked(
        self, function: int, _start: int, address: int, _count: int, registers: list[int], values: list[Any] | None
    ) -> ExcCodes | None:
        """Of pymodbus: `registers` are what it answers with."""
        group = _GROUPS.get(function, function)
        if values:
            self.set(group, address, *map(int, values))
            return None
        known = self._values[group]
        if group == DISCRETE:
            known = [sum(bit << at for at, bit in enumerate(known[word : word + 16])) for word in range(0, _SIZE, 16)]
        registers[: len(known)] = known
        return None

    async def _start(self) -> None:
        self._server = ModbusTcpServer(self._device, address=("127.0.0.1", self.port))
        await self._server.listen()
        transport: Any = self._server.transport
        self.port = transport.sockets[0].getsockname()[1]

    def _now(self, work: Any) -> None:
        asyncio.run_coroutine_threadsafe(work, self._loop).result(30)


def _block(type: DataType) -> list[SimData]:
    return [SimData(0, count=_SIZE, datatype=type)]
