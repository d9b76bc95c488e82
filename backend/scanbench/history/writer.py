"""Who wrote a variable last: a statement, a command, or the PLC itself, whichever came last before a scan."""

from dataclasses import dataclass

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.breakpoints import Breakpoints
from scanbench.debug.frames import frame_name, instance_path, task_of
from scanbench.debug.listener import Position
from scanbench.debug.placed import bytes_of
from scanbench.debug.reverse import Noted, Search, position_before
from scanbench.engines.probe import MakeProbed
from scanbench.history.contract import Writer
from scanbench.history.plc_writes import last_change
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.program.types import BOOL
from scanbench.recording.gaps import gap_before
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.command import Entry, Held, Patch, Refusal, Restarted, Swapped
from scanbench.runtime.forces import read_table
from scanbench.runtime.migrate_image import changes
from scanbench.runtime.restart import retained
from scanbench.runtime.target import Meant, meant, not_called
from scanbench.symbols.names import names_of
from scanbench.symbols.symbols import Symbol, UnknownPath, resolve
from scanbench.symbols.values import format_value
from scanbench.verify.contract import Place

_DEEPEST = 16
"""Blocks that pass an in-out by value on to each other, of which the innermost is looked for."""
_BY_ITS = "a temporary, or nothing: ask for a variable that outlives its call, or halt inside of the block"


@dataclass(frozen=True, slots=True)
class _Bytes:
    """Where a variable lies in one program."""

    offset: int
    size: int
    mask: int

    def touched(self, patch: Patch) -> bool:
        """Whether a patch changes any bit of it."""
        first, end = max(self.offset, patch.offset), min(self.offset + self.size, patch.offset + len(patch.mask))
        return any(patch.mask[at - patch.offset] & self.mask for at in range(first, end))

    def held_by(self, effect: Held) -> bool:
        """Whether a disturbance holds any bit of it."""
        return any(self.touched(Patch(at, bytes((mask,)), bytes(1))) for at, mask, _ in effect.spots)

    def of(self, memory: bytes | bytearray) -> bytes:
        """The value in an image."""
        data = bytes(memory[self.offset : self.offset + self.size])
        return bytes((bool(data[0] & self.mask),)) if self.mask != 0xFF else data


def find_writer(reader: RunReader, path: str, scan: int, prober: MakeProbed | None = None) -> Writer:
    """Who wrote the variable last before `scan` began. `Unreadable` says why that cannot be told.

    The reader has been followed as far as the scan.
    """
    reader.goto(scan)
    resource = reader.timeline.resource
    symbol = _meant(reader, path)
    place = bytes_of(symbol, resource.memory)
    assert place is not None
    where = _Bytes(*place)
    value, version = where.of(resource.memory), resource.version
    held = any(
        offset in range(where.offset, where.offset + where.size) and mask & where.mask
        for offset, (mask, _) in read_table(resource.memory).items()
    )
    # of a scan that ended by a run-time error a part is over, and shown
    here: Position = (scan + resource.header.halted_by_trap, 0)
    gap = gap_before(reader.recording.gaps, scan)
    begun = reader.recording.checkpoints[0].entries if gap is None else gap.entries
    entered = _Commands(reader, symbol.path).last(len(resource.journal), version, begun)
    if held and entered is not None:
        return _by_command(entered, symbol, value, held=True)
    kept = reader.first if gap is None else gap.until
    first = entered.scan if entered is not None else kept
    if held and gap is not None:
        raise Unreadable(f"who forced {symbol.path} is not known: {gap}")
    noted = _statement(reader, symbol.path, here, prober, first)
    position = noted.position if noted is not None else (-1, 0)
    at_command = (entered.scan, entered.step - 1 if entered.step else -1) if entered is not None else (-1, -1)
    changed = last_change(reader, symbol, scan, max(position[0], at_command[0], kept - 1))
    if changed is not None:
        return Writer(
            symbol.path, "plc", changed, 0, None, "PLC",
            f"the PLC itself, in scan {changed}: {symbol.path}" + _said(symbol, value), value, _shown(symbol, value),
        )  # fmt: skip
    if noted is not None and position > at_command:
        return _by_statement(reader, _inside(reader, noted, where, prober), symbol, value)
    if entered is not None:
        return _by_command(entered, symbol, value, held=False)
    if gap is not None:
        raise Unreadable(f"nobody wrote {symbol.path} since scan {kept}, and who wrote it before is not known: {gap}")
    text = f"nobody wrote it since scan {reader.first}, the first one that is kept"
    return Writer(symbol.path, "start", reader.first, 0, None, "", text, value, _shown(symbol, value))


def _meant(reader: RunReader, path: str) -> Symbol:
    """The variable itself, after in-outs have been followed, at its present place."""
    resource = reader.timeline.resource
    found = meant(resource.view, path, "")
    if not isinstance(found, Meant):
        raise Unreadable(found.message, found.near)
    symbol = resolve(resource.program, found.path)
    if symbol.type.size == 0:
        raise Unreadable(f"{symbol.path} takes no memory, so nobody writes it")
    if symbol.locate(resource.memory) is None:
        raise Unreadable(not_called(resource.view, symbol))
    if symbol.slots:
        raise Unreadable(f"{symbol.path} means {_BY_ITS}")
    return symbol


class _Commands:
    """What was entered, and whether it wrote the variable."""

    def __init__(self, reader: RunReader, path: str) -> None:
        self._reader, self._path = reader, path
        self._programs = reader.timeline.programs
        self._places: dict[int, _Bytes | None] = {}

    def last(self, end: int, version: int, begun: int) -> Entry | None:
        """The last of the entries from `begun` to `end` that wrote it, seen from where program `version` runs."""
        reader = self._reader
        entries, versions = reader.entries, reader.versions()
        for index in range(end - 1, begun - 1, -1):
            entry, effect = entries[index], entries[index].plan.effect
            place = self._place(versions[index + 1])
            if place is not None and any(map(place.touched, entry.plan.patches)):
                return entry
            if place is not None and isinstance(effect, Held) and place.held_by(effect):
                return entry
            if isinstance(effect, Swapped) and self._begins_differently(versions[index], effect):
                return entry
            if isinstance(effect, Restarted) and place is not None and not self._survives(entry, effect, place):
                return entry
        return None

    def _place(self, version: int) -> _Bytes | None:
        if version not in self._places:
            self._places[version] = _in_program(self._programs.get(version).program, self._path)
        return self._places[version]

    def _begins_differently(self, old: int, effect: Swapped) -> bool:
        """Whether the new program began with a different value than the old one had."""
        program = self._programs.get(effect.version).program
        place, before = self._place(effect.version), self._programs.get(old).program
        if place is None:
            return False
        if effect.fresh and not _covered(retained(program, program.initial_image), place):
            return True
        lost = changes(before, program).lost
        return any(_within(self._path, each.path) or _within(each.path, self._path) for each in lost)

    def _survives(self, entry: Entry, effect: Restarted, place: _Bytes) -> bool:
        here = self._reader.timeline.resource.header.scan
        self._reader.goto(entry.scan)
        resource = self._reader.timeline.resource
        kept = retained(resource.program, resource.memory, effect.kind)
        self._reader.goto(here)
        return _covered(kept, place)


def _in_program(program: Program, path: str) -> _Bytes | None:
    try:
        symbol = resolve(program, path)
    except UnknownPath:
        return None
    place = None if symbol.slots else bytes_of(symbol, bytearray(program.initial_image))
    return None if place is None else _Bytes(*place)


def _within(path: str, outer: str) -> bool:
    path, outer = path.upper(), outer.upper()
    return path == outer or (path.startswith(outer) and path[len(outer)] in ".[")


def _covered(spans: list[tuple[int, int]], place: _Bytes) -> bool:
    """Whether all bytes of it are in these stretches."""
    end = place.offset + place.size
    return all(any(first <= at < first + size for first, size in spans) for at in range(place.offset, end)) or (
        place.offset < Layout.HEADER_SIZE
    )


def _statement(reader: RunReader, path: str, here: Position, prober: MakeProbed | None, first: int) -> Noted | None:
    """The last write by a statement since scan `first`."""
    wanted = [Breakpoint(0, "data", "", path=path, access="write")]
    found = Search(reader.timeline, Breakpoints(), wanted, here, prober, lambda entry: (), first).run()
    if isinstance(found, Refusal):
        raise Unreadable(found.message, found.near)
    return found


def _inside(reader: RunReader, noted: Noted, where: _Bytes, prober: MakeProbed | None) -> Noted:
    """Of a call that copied an in-out by value back, the statement of the block that made the value, or of one that it passed its copy on
    to. Where none did, the call itself."""
    for _ in range(_DEEPEST):  # what is at the position of the call itself was written in it, too
        begin = position_before(reader.timeline, noted)
        paths = _copied(reader, noted, where)
        found = [_statement(reader, path, (begin[0], noted.position[1] + 1), prober, begin[0]) for path in paths]
        within = [
            each
            for each in found
            if each is not None and begin < each.position <= noted.position and each.writer != noted.writer
        ]
        if not within:
            return noted
        noted = max(within, key=lambda each: (each.position, position_before(reader.timeline, each)))
    return noted


def _copied(reader: RunReader, noted: Noted, where: _Bytes) -> list[str]:
    """The in-outs by value that are copies of the variable where something was noted."""
    program = reader.timeline.resource.program
    copies, names = program.layout.copies, names_of(program)
    if not copies.all:
        return []
    reader.goto(*noted.position)
    memory = reader.timeline.resource.memory
    found = []
    for each in copies.all:
        spot = copies.actual(memory, each.start, None)
        if spot is not None and 0 <= where.offset - spot[0] < each.end - each.start:
            path = names.path(each.start + where.offset - spot[0]).replace(" (in-out)", "")
            found += [path] if _is_path(program, path) else []
    return found


def _is_path(program: Program, path: str) -> bool:
    try:
        resolve(program, path)
    except UnknownPath:  # of what is between two members, say
        return False
    return True


def _by_statement(reader: RunReader, noted: Noted, symbol: Symbol, value: bytes) -> Writer:
    """The statement that wrote the value; afterwards the reader shows the state before it."""
    timeline = reader.timeline
    scan, count = position_before(timeline, noted)
    reader.goto(scan, count)
    resource = timeline.resource
    inside, program, sites = resource.listening.inside, resource.loaded.statements, resource.loaded.debugged().sites
    assert inside is not None
    frame = inside.frames[0]
    span = sites.statements[noted.writer if noted.writer is not None else frame.site].span
    instance = instance_path(program, frame) or frame_name(program, frame)
    line = reader.text(resource.version, span.file, span.line)
    where = Place(task_of(program, inside.frames), instance, frame.pou.name, span.file, span.line, line)
    text = f"{span.file}:{span.line}, {instance}" + (f": {line}" if line else "")
    return Writer(symbol.path, "program", scan, count, where, "", text, value, _shown(symbol, value))


def _by_command(entry: Entry, symbol: Symbol, value: bytes, held: bool) -> Writer:
    command = entry.command
    text = entry.plan.message or type(command).__name__
    if held:
        text += f"; it holds since scan {entry.scan}"
    return Writer(
        symbol.path, "command", entry.scan, entry.step, None, command.author, text, value, _shown(symbol, value)
    )


def _said(symbol: Symbol, value: bytes) -> str:
    shown = _shown(symbol, value)
    return f" is {shown}" if shown else " changed"


def _shown(symbol: Symbol, value: bytes) -> str:
    return format_value(BOOL if symbol.bit is not None else symbol.type, value)
