"""One PLC as OPC UA shows it: its folders, its methods, and what changes when its program does."""

import asyncio
import logging
from collections.abc import Callable, Sequence
from typing import Any

from asyncua import ua
from asyncua.server.address_space import AttributeService, AttributeValue, NodeManagementService, ViewService
from asyncua.server.event_generator import EventGenerator
from asyncua.server.subscription_service import SubscriptionService

from scanbench.comm.opcua.clients import Desk, ToPlc
from scanbench.comm.opcua.connection import Line
from scanbench.comm.opcua.device import show_device
from scanbench.comm.opcua.errors import Errors
from scanbench.comm.opcua.forms import Form
from scanbench.comm.opcua.ids import INDEX, own, standard
from scanbench.comm.opcua.items import Publishing
from scanbench.comm.opcua.link import Link
from scanbench.comm.opcua.plcopen import put_tasks
from scanbench.comm.opcua.socket import OpcUa
from scanbench.comm.opcua.space import NAMESPACE, Space, Variable
from scanbench.comm.opcua.values import Values, bad, clock_of
from scanbench.engines.cache import BlobCache
from scanbench.faults.clear import ClearErrors
from scanbench.host.program_cache import key_of, recall
from scanbench.jobs.starting import checked_program, model_of
from scanbench.program.program import Program
from scanbench.runtime.command import Command
from scanbench.runtime.modes import SetMode
from scanbench.wire.host import Sources
from scanbench.wire.opcua import OpcUaErrors, OpcUaFault, OpcUaProgram, OpcUaStart
from scanbench.wire.variables import VariablesAre

log = logging.getLogger("scanbench")
RENEWED = "the program of the PLC was changed"


class Plc:
    """Serves one PLC. In the event loop of its process."""

    def __init__(self, link: Link, cache: BlobCache | None, start: OpcUaStart) -> None:
        self._link, self._cache, self._start = link, cache, start
        self._news: asyncio.Queue[object] = asyncio.Queue()
        self._line = Line()
        self._space = Space()
        self._values = Values(link, self._space)
        self._server: OpcUa | None = None
        self._errors: Errors | None = None
        self._changed: EventGenerator | None = None
        self._iec = 0
        """The index of the namespace of PLCopen."""

    @property
    def port(self) -> int:
        """Where it listens."""
        return 0 if self._server is None else self._server.port

    def hear(self, message: object) -> None:
        """What the server of Scanbench tells."""
        if isinstance(message, OpcUaFault):
            self._line.fault = message
        else:
            self._news.put_nowait(message)

    async def open(self) -> None:
        """Makes the nodes that are always there, and those of the first program, and listens. `OSError`."""
        iserver = ToPlc(Desk(self._start, self._link, self._space, self._values, {}, None, (_PLC, _ERRORS)))
        _use(iserver, self._space)
        self._values.publishing = Publishing(iserver.subscription_service)
        server = self._server = OpcUa(self._start, iserver, self._line)
        await server.prepare()
        index = await server.register_namespace(NAMESPACE)
        assert index == INDEX
        self._make(iserver.desk)
        self._iec = await show_device(
            server, self._space, _PLC, (_PROGRAMS, _GLOBALS), (_STATUS, _ERRORS), self._start.plc, self._start.model
        )
        self._errors = iserver.desk.alarms = Errors(server, self._values, _ERRORS, self._shown_errors())
        self._changed = await server.get_event_generator(ua.ObjectIds.GeneralModelChangeEventType)
        await self._take(await self._news.get())  # the program: whoever comes at once finds its nodes
        await server.start()

    async def live(self) -> None:
        """Takes news, and reads what clients have subscribed to, for ever."""
        await asyncio.gather(self._values.go_on(), self._take_all())

    async def _take_all(self) -> None:
        while True:
            await self._take(await self._news.get())

    async def _take(self, message: object) -> None:
        try:
            match message:
                case OpcUaProgram(sources):
                    await self._renew(sources)
                case OpcUaErrors():
                    assert self._errors is not None
                    await self._errors.take(message)
        except Exception:  # the next one may be better
            log.exception("an OPC UA server could not take %s", type(message).__name__)

    # ---- nodes ----------------------------------------------------------------------------------------------------

    def _make(self, desk: Desk) -> None:
        space, plc = self._space, self._start.plc
        folder = standard(ua.ObjectIds.FolderType)
        for id, name, parent in (
            (_PLC, plc, standard(ua.ObjectIds.ObjectsFolder)), (_PROGRAMS, "Programs", _PLC), (_GLOBALS, "Globals", _PLC),
            (_STATUS, "Status", _PLC), (_ERRORS, "Errors", _PLC),
        ):  # fmt: skip
            space.put_object(id, name, folder, parent, events=id in (_PLC, _ERRORS))
        for number, (name, form, head) in enumerate(_HEADS, _FIRST_HEAD):
            space.put_fixed(_waiting(number, name, form, head), name, _STATUS)
        for number, (name, form) in enumerate(_SHOWN, _FIRST_ERROR):
            space.put_fixed(_waiting(number, name, form), name, _ERRORS)
        for id, name, arguments, method in _METHODS:
            space.put_method(id, name, _PLC, arguments)
            desk.methods[id] = (name, method)

    def _shown_errors(self) -> dict[str, Variable]:
        numbers = enumerate(_SHOWN, _FIRST_ERROR)
        return {name: self._space.variables[own(number)] for number, (name, _) in numbers}

    async def _renew(self, sources: Sources) -> None:
        """Shows the nodes of another program, and tells who has subscribed to what is gone."""
        program = await asyncio.to_thread(self._program, sources)
        gone = self._space.take(program, _PROGRAMS, _GLOBALS)
        put_tasks(self._space, self._iec, program)
        self._values.on_program(sources.version)
        for each in gone:
            await self._values.give(each, None, bad(ua.StatusCodes.BadNodeIdUnknown))
        self._values.watch(each.id for each in self._space.variables.values() if each.watched)
        if self._changed is not None:
            self._changed.event.Changes = [ua.ModelChangeStructureDataType(_PLC, standard(ua.ObjectIds.FolderType), 31)]
            await self._changed.trigger(message=RENEWED)

    def _program(self, sources: Sources) -> Program:
        """The checked program: from the disk, or checked now."""
        program = None if self._cache is None else recall(self._cache, key_of(sources, model_of(sources)))
        return program or checked_program(sources, model_of(sources))


def _use(iserver: ToPlc, space: Space) -> None:
    """Has asyncua use our address space, before anything is in its own."""
    iserver.aspace = space
    iserver.attribute_service = AttributeService(space)
    iserver.view_service = ViewService(space)
    iserver.method_service._aspace = space
    iserver.node_mgt_service = NodeManagementService(space)
    iserver.subscription_service = SubscriptionService(space, iserver)
    iserver.isession.aspace, iserver.isession.subscription_service = space, iserver.subscription_service


def _waiting(number: int, name: str, form: Form, head: Callable[[VariablesAre], Any] | None = None) -> Variable:
    """A variable that is always there, before anything is known."""
    value = AttributeValue(bad(ua.StatusCodes.BadWaitingForInitialData))
    return Variable(own(number), "", name, form, value, False, head)


def _set_mode(author: str, arguments: Sequence[ua.Variant]) -> Command | None:
    mode = arguments[0].Value if len(arguments) == 1 else None
    return SetMode(author, mode.strip().upper()) if isinstance(mode, str) else None


def _clear_errors(author: str, arguments: Sequence[ua.Variant]) -> Command | None:
    return None if arguments else ClearErrors(author, "all")


def _form(variant: ua.VariantType, data_type: int = 0, dimensions: tuple[int, ...] = ()) -> Form:
    return Form(variant, standard(data_type or variant.value), 0, _no_bytes, _no_value, dimensions)


def _no_bytes(_data: bytes) -> Any:
    raise AssertionError("it is told of, and lies nowhere")


def _no_value(_value: Any) -> bytes:
    raise AssertionError("it cannot be written")


_PLC, _PROGRAMS, _GLOBALS, _STATUS, _ERRORS = map(own, range(1, 6))
_FIRST_HEAD, _FIRST_ERROR = 10, 20
_HEADS: tuple[tuple[str, Form, Callable[[VariablesAre], Any]], ...] = (
    ("Mode", _form(ua.VariantType.String), lambda told: told.mode),
    ("Stopped", _form(ua.VariantType.Boolean), lambda told: told.stopped),
    ("Scan", _form(ua.VariantType.UInt64), lambda told: told.scan),
    ("Clock", _form(ua.VariantType.DateTime), clock_of),
    ("ProgramVersion", _form(ua.VariantType.UInt32), lambda told: told.version),
)
_SHOWN = (
    ("Present", _form(ua.VariantType.String, dimensions=(0,))),
    ("Count", _form(ua.VariantType.UInt32)),
    ("Fatal", _form(ua.VariantType.Boolean)),
)
_METHODS = (
    (own(30), "SetMode", (("Mode", "PROGRAM, MONITOR or RUN"),), _set_mode),
    (own(31), "ClearErrors", (), _clear_errors),
)
"""Number, name, arguments (all of them String), and what makes the command."""
