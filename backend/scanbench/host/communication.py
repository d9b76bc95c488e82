"""Phase 5, the virtual communication unit: what protocol clients read and write, whole, in one seam."""

from scanbench.debug.debugger import Debugger
from scanbench.host.link import Link
from scanbench.host.lookup import watch_item
from scanbench.host.services import Services
from scanbench.host.variables import Variables
from scanbench.program.layout import Layout
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Plan, Refusal
from scanbench.runtime.copy_areas import CopyAreas
from scanbench.runtime.forces import ForceSeveral, read_table
from scanbench.runtime.header import Header
from scanbench.runtime.holds import held
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.write_areas import WriteAreas
from scanbench.runtime.write_variables import WriteVariables
from scanbench.wire.host import Ack, Submit
from scanbench.wire.memory import AreasAre, AreaSpan, ReadAreas
from scanbench.wire.variables import DescribeVariables, ReadVariables, VariablesDescribed

UNCHANGED = "nothing changed"
"""What is answered to a write of what is there already: it is not kept in the run."""


class Communication:
    """Serves protocol clients between scans. They read the PLC that runs, also while people look at its past."""

    def __init__(self, timeline: Timeline, debugger: Debugger, services: Services, link: Link) -> None:
        self._timeline, self._debugger, self._services, self._link = timeline, debugger, services, link
        self._variables = Variables()

    def serve(self, message: object) -> bool:
        """Serves what comes from protocol clients; whether it did."""
        match message:
            case ReadAreas():
                loaded, memory = self._timeline.live_image
                self._link.post(areas_are(message, loaded, memory, self._timeline.live_journal))
            case ReadVariables():
                self._link.post(self._variables.are(message, *self._timeline.live_image))
            case DescribeVariables():
                self._link.post(described(message, self._timeline.live_image[0]))
            case Submit(ref, WriteAreas() | WriteVariables() | CopyAreas() | ForceSeveral() as command):
                self._write(ref, command)
            case _:
                return False
        return True

    def _write(self, ref: int, command: WriteAreas | WriteVariables | CopyAreas | ForceSeveral) -> None:
        """Enters it, unless all that it writes is there: a client may repeat itself for weeks."""
        scan = self._timeline.live_scan
        if not self._timeline.past:
            plan = command.plan(self._timeline.resource.view)
            if isinstance(plan, Plan) and not plan.patches:
                self._link.post(Ack(ref, True, UNCHANGED, scan))
                return
        outcome = self._debugger.submit(command)
        self._services.entered()
        if isinstance(outcome, Refusal):
            self._link.post(Ack(ref, False, outcome.message, scan, outcome.near))
        else:
            self._link.post(Ack(ref, True, outcome.plan.message, outcome.scan))


def described(question: DescribeVariables, loaded: Loaded) -> VariablesDescribed:
    """Answers a `DescribeVariables`."""
    items = [watch_item(loaded.program, number, path)[0] for number, path in enumerate(question.paths)]
    return VariablesDescribed(question.ref, loaded.version, tuple(items))


def areas_are(question: ReadAreas, loaded: Loaded, memory: bytes | bytearray, journal: Journal) -> AreasAre:
    """Answers a `ReadAreas` from an image and the journal that led to it."""
    header, layout = Header(memory), loaded.program.layout
    data: list[bytes] = []
    message = ""
    for span in question.spans:
        begin = _place(layout, span)
        if begin is None:
            data, message = [], f"{layout.model.name} has no byte {span.byte + span.size - 1} of {span.area}"
            break
        where = slice(begin, begin + span.size)
        data.append(_forced(memory, journal, where) if span.forced else bytes(memory[where]))
    return AreasAre(
        question.ref, header.scan, header.mode.name, bool(header.halt),
        header.epoch_ns + header.next_clock_ns(loaded.program.interval_ns), tuple(data), message,
    )  # fmt: skip


def _place(layout: Layout, span: AreaSpan) -> int | None:
    area = layout.model.area(span.area)
    if area is None or min(span.byte, span.size) < 0 or span.byte + span.size > area.size:
        return None
    return layout.areas[area.name] + span.byte


def _forced(memory: bytes | bytearray, journal: Journal, where: slice) -> bytes:
    """Bits that somebody forced: not those that a disturbance holds."""
    table, holds = read_table(memory), held(journal)
    return bytes(table.get(at, (0, 0))[0] & ~holds.get(at, 0) for at in range(where.start, where.stop))
