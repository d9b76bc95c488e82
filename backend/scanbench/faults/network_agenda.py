"""What comes by itself of communications instructions: ports that are ready, answers that never came, and the error of a port."""

from scanbench.check.system.network_text import NAMES
from scanbench.faults.inject import ACTIVE, Generate
from scanbench.faults.network import TIMEOUT, WAITING, NetworkAnswer, PortsReady
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.network import COMPLETION_CODE, Port, ports
from scanbench.program.origin import SYSTEM_FILE
from scanbench.program.program import Program
from scanbench.runtime.agenda import NOTHING, Met, Waits
from scanbench.runtime.command import Command, Plan, Refusal, View


class Network:
    """`runtime.agenda.Agenda` of the ports. Programs without such instructions cost it nothing."""

    def __init__(self) -> None:
        self._program: Program | None = None
        self._ports: tuple[Port, ...] = ()

    def due(self, view: View, met: Met) -> Command | None:
        """The first of what there is to enter."""
        if view.program is not self._program:
            self._program = view.program
            self._ports = ports(view.model) if _uses(view.program) else ()
        if not self._ports:
            return None
        error = self._error(view)
        if error is not None:
            return error
        waiting = view.derived(WAITING)
        for number, each in waiting.items():
            if each.request.fails or each.until <= view.header.scan:
                return NetworkAnswer("PLC", number, each.since, each.request.fails or TIMEOUT)
        if any(each.number not in waiting and not _on(view, each) for each in self._ports):
            return PortsReady("PLC")
        return None

    def _error(self, view: View) -> Command | None:
        """That of the port whose answer was entered last, if it failed."""
        last = view.journal[-1].command if view.journal else None
        if not isinstance(last, NetworkAnswer) or not last.end:
            return None
        port = self._ports[last.port] if last.port < len(self._ports) else None
        if port is None or port.error.id in view.derived(ACTIVE):
            return None
        raised = Generate("PLC", (ErrorRef(port.error.id, ((COMPLETION_CODE, f"{last.end:X}"),)),), "plc")
        return raised if isinstance(raised.plan(view), Plan) else None

    def refused(self, command: Command, refusal: Refusal) -> Command:
        """What is due here was looked at before."""
        raise ValueError(f"{command} was refused: {refusal.message}")

    def waits(self, view: View) -> Waits:
        """The end of the first one that is waited for."""
        if not self._ports:
            return NOTHING
        ends = [each.until for each in view.derived(WAITING).values()]
        return Waits(min(ends)) if ends else NOTHING


def _uses(program: Program) -> bool:
    return any(pou.name in NAMES and pou.span.file == SYSTEM_FILE for pou in program.pous)


def _on(view: View, port: Port) -> bool:
    place = port.enabled
    assert place.bit is not None
    return bool(view.memory[view.program.layout.areas[place.area.name] + place.byte] >> place.bit & 1)
