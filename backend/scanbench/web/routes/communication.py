"""REST: the communication unit of a PLC: servers that protocol clients connect to."""

from fastapi import APIRouter, Request
from fastapi.responses import Response

from scanbench.comm.modbus.mapping import Mapped, as_csv
from scanbench.comm.modbus.wires import PlantWanted
from scanbench.comm.mqtt.settings import MqttGiven
from scanbench.faults.line_faults import LineFault, LineKind, ServerKind
from scanbench.server.communication_shapes import CommunicationSeen, ServerWanted
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api/instances/{instance}/communication", tags=["communication"])


@router.get("")
async def on_communication(bench: Bench, instance: Id) -> CommunicationSeen:
    """Its servers, who is connected, what was asked lately, and who reads the error memory."""
    return bench.communication.seen(bench.session(instance))


@router.put("/plant")
async def on_set_plant(bench: Bench, request: Request, instance: Id, wanted: PlantWanted) -> CommunicationSeen:
    """Switches the exchange of values with a plant on or off, which is a server of Modbus TCP (Factory I/O and the like), or says what
    is wired to what. It is kept: it is on again when Scanbench starts again."""
    return await bench.communication.set_plant(bench.session(instance), wanted, user_of(request).name)


@router.put("/mqtt")
async def on_set_mqtt(bench: Bench, request: Request, instance: Id, wanted: MqttGiven) -> CommunicationSeen:
    """Switches the publishing of variables by MQTT or Sparkplug B on or off, or says which of them go where. It is kept: it is on
    again when Scanbench starts again."""
    return await bench.communication.set_mqtt(bench.session(instance), wanted, user_of(request).name)


@router.put("/{kind}")
async def on_set(
    bench: Bench, request: Request, instance: Id, kind: ServerKind, wanted: ServerWanted
) -> CommunicationSeen:
    """Switches a server on or off, or gives it other settings. They are kept: it is on again when Scanbench starts again."""
    return await bench.communication.set(bench.session(instance), kind, wanted, user_of(request).name)


@router.put("/{kind}/fault")
async def on_break_line(
    bench: Bench, request: Request, instance: Id, kind: LineKind, fault: LineFault
) -> CommunicationSeen:
    """Lets something be wrong with the line to the clients of a server or to the plant, or nothing any more. It is in the run file, and stays when
    the PLC or its server is switched off and on."""
    return await bench.communication.break_line(bench.session(instance), kind, fault, user_of(request).name)


@router.get("/modbus/map")
async def on_modbus_map(bench: Bench, instance: Id) -> list[Mapped]:
    """Which memory each coil and register of Modbus means."""
    return list(bench.communication.modbus_table(bench.session(instance)))


@router.get("/modbus/map.csv", response_class=Response)
async def on_modbus_csv(bench: Bench, instance: Id) -> Response:
    """The same as a spreadsheet opens it."""
    session = bench.session(instance)
    return Response(
        as_csv(bench.communication.modbus_table(session)), media_type="text/csv",
        headers={"content-disposition": f'attachment; filename="modbus-{instance}.csv"'},
    )  # fmt: skip
