"""The communication units of all PLCs: which servers of protocols are on, who is connected, and that it outlives a restart."""

import asyncio
import logging
from collections.abc import Callable, Coroutine, Mapping
from dataclasses import asdict, dataclass, field, replace
from ipaddress import ip_address
from pathlib import Path
from typing import Protocol

from scanbench.comm.desk import Desk
from scanbench.comm.door import Plc
from scanbench.comm.fins.service import FinsServer
from scanbench.comm.modbus.map_file import MAP_FILE
from scanbench.comm.modbus.mapping import Mapped
from scanbench.comm.modbus.service import modbus_server
from scanbench.comm.modbus.wires import PlantWanted
from scanbench.comm.mqtt.settings import MqttGiven
from scanbench.comm.opcua.service import PORT as OPC_UA_PORT
from scanbench.comm.opcua.service import OpcUaServer, Place
from scanbench.comm.slmp.service import slmp_server
from scanbench.faults.line_faults import (
    LINE_NAMES,
    NO_FAULT,
    BreakLine,
    LineFault,
    LineKind,
    MendLine,
    ServerKind,
    lines_of,
    servers_of,
)
from scanbench.server.communication_door import ErrorReaders, SessionDoor
from scanbench.server.communication_map import MapFile, ModbusMap
from scanbench.server.communication_mqtt import Mqtt
from scanbench.server.communication_network import Member, PlcNetwork
from scanbench.server.communication_plant import Plant
from scanbench.server.communication_plc import SessionPlc
from scanbench.server.communication_shapes import CommunicationSeen, ServerSeen, ServerWanted
from scanbench.server.mqtt_secrets import MqttSecrets
from scanbench.session.session import Session
from scanbench.store.store import Store
from scanbench.typed import BadValue, make_kept
from scanbench.wire.events import Event, FileDeleted, FileSaved, LinesChanged, User, UsersChanged
from scanbench.wire.refused import Refused

log = logging.getLogger("scanbench")
_PORTS = 1 << 16
_NODES = range(1, 255)
_FIRST = ServerWanted()


class Server(Protocol):
    """What serves one protocol."""

    @property
    def port(self) -> int:
        """0 while it is closed."""

    async def open(self, host: str, port: int) -> None:
        """Listens. `OSError`."""

    async def close(self) -> None:
        """Ends, and every connection with it."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A protocol: how its server is made, and how it is set at first."""

    make: Callable[[Desk, ServerWanted, Plc, Place, ModbusMap], Server]
    first: ServerWanted = _FIRST
    slow: bool = False
    """It takes seconds to open: at the start of Scanbench nobody waits for it."""


KINDS: Mapping[ServerKind, Kind] = {
    "fins": Kind(
        lambda desk, wanted, *_: FinsServer(desk, wanted.node, wanted.error_bits),
    ),
    "slmp": Kind(lambda desk, *_: slmp_server(desk)),
    "modbus": Kind(lambda desk, *rest: modbus_server(desk, rest[-1].table)),
    "opcua": Kind(
        lambda desk, wanted, plc, place, _map: OpcUaServer(desk, plc, place, wanted.anonymous_writes),
        ServerWanted(port=OPC_UA_PORT),
        slow=True,
    ),
}


@dataclass(slots=True)
class _Running:
    """A server of a PLC."""

    wanted: ServerWanted
    desk: Desk | None = None
    server: Server | None = None
    trouble: str = ""
    fault: LineFault = NO_FAULT
    port: int = 0
    """The one that it had: it has it again when the line is whole."""


@dataclass(slots=True)
class _Unit:
    """The communication unit of a PLC."""

    session: Session
    readers: ErrorReaders
    plant: Plant
    mqtt: Mqtt
    map: ModbusMap
    servers: dict[ServerKind, _Running] = field(default_factory=dict)
    turning: asyncio.Lock = field(default_factory=asyncio.Lock)
    ignore: Callable[[], None] = field(default=lambda: None)
    """Ends hearing of its lines."""


class Communication:
    """Of all PLCs of this server."""

    def __init__(self, store: Store, data: Path, map_file: MapFile) -> None:
        """`data` is the directory of the server; `map_file` gives the text of a project's map of Modbus."""
        self._store, self._map_file = store, map_file
        self._place, self._secrets = Place(data / "cache", data / "opcua", ""), data / "mqtt"
        self._units: dict[int, _Unit] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._network = PlcNetwork(self._members)

    def protect(self, token: str) -> None:
        """What users of protocols that have users prove with that they may be here. Before anything is opened."""
        self._place = replace(self._place, token=token)

    async def begin(self, session: Session) -> None:
        """A PLC is there: opens the servers that were on."""
        kept, readers = session.row.communication or {}, ErrorReaders(session.model)
        plant = Plant(session, readers, kept.get("plant"), lambda: _tell_clients(unit))
        secrets = MqttSecrets(self._secrets, session.id)
        mqtt = Mqtt(session, readers, secrets, kept.get("mqtt"), lambda: _tell_clients(unit))
        unit = self._units[session.id] = _Unit(session, readers, plant, mqtt, ModbusMap(session, self._map_file))
        await unit.map.read()
        self._network.begin(session)
        unit.ignore = self._follow(unit)
        for kind in servers_of(session.model):
            unit.servers[kind] = _Running(_read(kept.get(kind), KINDS[kind].first))
            if KINDS[kind].slow and unit.servers[kind].wanted.on:
                self._begin_task(self._turn_later(unit, kind))
            else:
                await self._turn(unit, kind)
        plant.begin()
        await mqtt.begin()

    async def forget(self, id: int) -> None:
        """A PLC is deleted: closes its servers, and forgets what it proved itself with."""
        unit = self._units.get(id)
        await self.end(id)
        if unit is not None:
            await unit.mqtt.forget()

    async def end(self, id: int) -> None:
        """A PLC is gone: closes its servers."""
        unit = self._units.pop(id, None)
        if unit is None:
            return
        unit.ignore()
        self._network.end(unit.session)
        async with unit.turning:
            for running in unit.servers.values():
                await _close(running)
            await unit.plant.end()
            await unit.mqtt.end()

    async def close(self) -> None:
        """Closes all servers."""
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        await self._network.close()
        for id in list(self._units):
            await self.end(id)

    def seen(self, session: Session) -> CommunicationSeen:
        """As it is now."""
        unit = self._units[session.id]
        servers = tuple(_seen(kind, running) for kind, running in unit.servers.items())
        return CommunicationSeen(
            servers, unit.readers.all, unit.plant.seen, unit.mqtt.seen, unit.map.own, unit.map.trouble
        )

    async def set(self, session: Session, kind: ServerKind, wanted: ServerWanted, author: str) -> CommunicationSeen:
        """Switches a server on or off, or gives it other settings; they are kept. `Refused`."""
        unit = self._units[session.id]
        if kind not in unit.servers:
            raise Refused(f"{session.model.name} does not speak {LINE_NAMES[kind]}", tuple(unit.servers))
        _refuse_wrong(wanted)
        async with unit.turning:
            before = unit.servers[kind]
            listens = before.server is not None and wanted.on
            same = (wanted.host, wanted.port) == (before.wanted.host, before.wanted.port)
            await _close(before)
            # clients find it where they know it, also where any port was wanted
            unit.servers[kind] = _Running(wanted, fault=before.fault, port=before.port if listens and same else 0)
            await self._turn(unit, kind)
            await self._keep(unit)
        session.log.add(author, _told(kind, unit.servers[kind]), "system")
        return self.seen(session)

    async def set_plant(self, session: Session, wanted: PlantWanted, author: str) -> CommunicationSeen:
        """Switches the exchange with a plant on or off, or gives it other settings; they are kept. `Refused`."""
        unit = self._units[session.id]
        unit.plant.check(wanted)
        async with unit.turning:
            await unit.plant.set(wanted)
            await self._keep(unit)
        on = f"values are exchanged with the plant at {wanted.host}:{wanted.port}"
        session.log.add(author, on if wanted.on else "values are exchanged with no plant", "system")
        return self.seen(session)

    async def set_mqtt(self, session: Session, wanted: MqttGiven, author: str) -> CommunicationSeen:
        """Switches publishing on or off, or gives it other settings; they are kept. `Refused`."""
        unit = self._units[session.id]
        wanted.check()
        async with unit.turning:
            await unit.mqtt.set(wanted)
            await self._keep(unit)
        on = f"{len(wanted.variables)} variables are published to the broker at {wanted.host}:{wanted.port}"
        session.log.add(author, on if wanted.on else "nothing is published", "system")
        return self.seen(session)

    async def _keep(self, unit: _Unit) -> None:
        kept: dict[str, object] = {each: asdict(running.wanted) for each, running in unit.servers.items()}
        kept["plant"] = asdict(unit.plant.wanted)
        kept["mqtt"] = asdict(unit.mqtt.wanted)
        await asyncio.to_thread(self._store.instances.keep_communication, unit.session.id, kept)

    async def break_line(self, session: Session, kind: LineKind, fault: LineFault, author: str) -> CommunicationSeen:
        """Lets something be wrong with a line, or nothing any more. `Refused`."""
        unit = self._units[session.id]
        if kind not in lines_of(session.model):
            raise Refused(f"{session.model.name} does not speak {LINE_NAMES[kind]}", lines_of(session.model))
        command = MendLine(author, kind) if fault.kind == "none" else BreakLine(author, kind, fault)
        ack = await session.submit(command)
        if not ack.ok:
            raise Refused(ack.message)
        async with unit.turning:
            await self._apply(unit, kind, fault if fault.kind != "none" else NO_FAULT)
        return self.seen(session)

    def modbus_table(self, session: Session) -> tuple[Mapped, ...]:
        """Which memory each coil and register means."""
        return self._units[session.id].map.table()

    def _members(self) -> list[Member]:
        """The PLCs that speak FINS."""
        found = [(unit, unit.servers["fins"]) for unit in self._units.values() if "fins" in unit.servers]
        return [
            Member(
                unit.session, fins.wanted.node, fins.wanted.error_bits, fins.desk if fins.server is not None else None
            )
            for unit, fins in found
        ]

    def _begin_task(self, work: Coroutine[None, None, None]) -> None:
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def _follow(self, unit: _Unit) -> Callable[[], None]:
        """Does to clients what the journal says of the lines, also after a start, and where the PLC goes on from its past; and reads the
        map of Modbus when it was changed. What is given back ends that."""

        def hear(event: Event) -> None:
            if isinstance(event, LinesChanged) and not unit.session.state.past_by:
                self._begin_task(self._bring_up_to_date(unit))
            elif isinstance(event, FileSaved | FileDeleted) and event.path == MAP_FILE:
                self._begin_task(unit.map.read())

        unit.session.listen(hear)
        return lambda: unit.session.ignore(hear)

    async def _bring_up_to_date(self, unit: _Unit) -> None:
        async with unit.turning:
            faults = {each.server: each.now for each in unit.session.errors.lines}
            for kind in lines_of(unit.session.model):
                if self._units.get(unit.session.id) is unit:
                    await self._apply(unit, kind, faults.get(kind, NO_FAULT))

    async def _apply(self, unit: _Unit, kind: LineKind, fault: LineFault) -> None:
        if kind == "plant":
            unit.plant.break_line(fault)
        elif kind in unit.servers and unit.servers[kind].fault != fault:
            await self._apply_to(unit, kind, fault)

    async def _apply_to(self, unit: _Unit, kind: ServerKind, fault: LineFault) -> None:
        running = unit.servers[kind]
        closed, running.fault = running.fault.kind == "refused", fault
        if fault.kind == "refused":
            desk = running.desk
            await _close(running)
            running.desk = desk  # what was asked before is still told
            if desk is not None:
                desk.leave_all()
        elif closed:
            await self._turn(unit, kind)
        if running.desk is not None:
            running.desk.fault = fault
        if isinstance(running.server, OpcUaServer):
            running.server.break_line(fault)

    async def _turn_later(self, unit: _Unit, kind: ServerKind) -> None:
        async with unit.turning:
            if self._units.get(unit.session.id) is unit and unit.servers[kind].server is None:
                await self._turn(unit, kind)

    async def _turn(self, unit: _Unit, kind: ServerKind) -> None:
        """Opens a server that is wanted on; where that cannot be, its trouble says why."""
        running = unit.servers[kind]
        wanted = running.wanted
        if not wanted.on or running.fault.kind == "refused":
            return
        desk = running.desk or Desk(
            lambda name: SessionDoor(unit.session, name, unit.readers),
            lambda: _tell_clients(unit),
            wanted.access == "read",
        )
        desk.fault = running.fault
        server = KINDS[kind].make(desk, wanted, SessionPlc(unit.session), self._place, unit.map)
        try:
            await server.open(wanted.host, running.port or wanted.port)
        except OSError as error:
            why = error.strerror or str(error)
            running.trouble = (
                f"{wanted.host}:{wanted.port} cannot be listened on: {why}. Choose a different port or address"
            )
            return
        running.desk, running.server, running.port, running.trouble = desk, server, server.port, ""


def _told(kind: ServerKind, running: _Running) -> str:
    """What the log says of a server that was set."""
    if running.trouble:
        return running.trouble
    name = LINE_NAMES[kind]
    return f"{name} server on: {_address(kind, running)}" if running.server else f"{name} server off"


def _tell_clients(unit: _Unit) -> None:
    """Everybody at the PLC sees who is connected."""
    desks = (*(running.desk for running in unit.servers.values()), unit.plant.desk, unit.mqtt.desk)
    names = (client.name for desk in desks if desk is not None for client in desk.clients)
    unit.session.tools = tuple(User(name, client=True) for name in names)
    unit.session.tell(UsersChanged(unit.session.users))


async def _close(running: _Running) -> None:
    server, running.server = running.server, None
    if server is not None:
        await server.close()
    running.desk = None


def _read(kept: object, first: ServerWanted) -> ServerWanted:
    """What was kept; what cannot be understood is off."""
    if not isinstance(kept, dict):
        return first
    try:
        return make_kept(ServerWanted, kept)
    except BadValue as error:
        log.error("the settings of a server cannot be read: %s", error)
        return first


def _refuse_wrong(wanted: ServerWanted) -> None:
    try:
        ip_address(wanted.host)
    except ValueError:
        raise Refused(f"{wanted.host!r} is no IP address: 127.0.0.1 is this machine alone") from None
    if not 0 <= wanted.port < _PORTS:
        raise Refused(f"port {wanted.port} is outside of 1 to {_PORTS - 1}; 0 is one that is free")
    if wanted.node not in _NODES:
        raise Refused(f"node {wanted.node} is outside of 1 to {_NODES[-1]}")


def _address(kind: ServerKind, running: _Running) -> str:
    if running.server is None:
        return ""
    host = running.wanted.host
    scheme = "opc.tcp://" if kind == "opcua" else ""
    return f"{scheme}[{host}]:{running.server.port}" if ":" in host else f"{scheme}{host}:{running.server.port}"


def _seen(kind: ServerKind, running: _Running) -> ServerSeen:
    desk = running.desk
    if desk is None:
        return ServerSeen(kind, running.wanted, False, "", running.trouble, running.fault, 0.0, (), ())
    away = running.server.trouble if isinstance(running.server, OpcUaServer) else ""
    on = running.server is not None and not away
    address = _address(kind, running) if on else ""
    trouble = f"It does not listen: {away}. It is tried again" if away else running.trouble
    return ServerSeen(
        kind, running.wanted, on, address, trouble, running.fault, desk.per_second, desk.clients, desk.frames
    )  # fmt: skip
