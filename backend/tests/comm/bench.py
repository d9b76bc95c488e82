"""A PLC without a process, seen through the door of a protocol."""

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

from scanbench.comm.door import Done, Read
from scanbench.faults.detect import Detection
from scanbench.faults.device import read_device
from scanbench.faults.device_shapes import DeviceErrors
from scanbench.host.communication import areas_are
from scanbench.plcmodel.model import Model
from scanbench.runtime.command import Command, Refusal
from scanbench.runtime.resource import Resource
from scanbench.wire.memory import AreaSpan, ReadAreas
from tests.runtime.bench import plc

SOURCE = "PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM"
_1970 = datetime(1970, 1, 1, tzinfo=UTC)


def machine(model: str = "CJ1M-CPU13", source: str = SOURCE) -> Resource:
    resource = plc(source, model_name=model)
    resource.detect = Detection()
    return resource


class LocalDoor:
    """`comm.door.Door`."""

    author = "FINS 127.0.0.1, node 25"

    def __init__(self, resource: Resource) -> None:
        self.resource = resource

    @property
    def model(self) -> Model:
        return self.resource.program.layout.model

    async def read(self, spans: Sequence[AreaSpan], also: Sequence[AreaSpan] = ()) -> Read:
        resource = self.resource
        found = areas_are(ReadAreas(0, (*spans, *also)), resource.loaded, resource.memory, resource.journal)
        assert not found.message, found.message
        clock = _1970 + timedelta(microseconds=found.clock_ns // 1000)
        return Read(found.scan, found.mode, found.stopped, clock, found.data)

    def noted(self, spans: Sequence[AreaSpan]) -> None:
        pass

    async def device(self) -> DeviceErrors:
        return read_device(self.resource.view)

    async def submit(self, command: Command) -> Done:
        outcome = self.resource.submit(command)
        return Done(
            not isinstance(outcome, Refusal), outcome.message if isinstance(outcome, Refusal) else outcome.plan.message
        )
