"""Rows of the table: what the two sides used and came to, pass by pass, and the first place where they part."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from scanbench.program.types import Enumeration, Reference
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.names import Names, NamesInside
from scanbench.symbols.references import slot_text
from scanbench.verify.contract import MAX_COLUMNS, Cause, Column, Input, Mismatch, Output, Row, RowKind
from scanbench.verify.monitor import Inputs
from scanbench.verify.places import FramesAt, Places
from scanbench.verify.sentences import Teller
from scanbench.verify.uses import Access, Pass

MAX_MISMATCHES = 20
"""Of a row."""
MAX_NAMES = 256
"""Of what a reference refers to, of a column; others are shown by where they are."""


class Columns:
    """The columns so far."""

    def __init__(self) -> None:
        self.all: dict[str, Column] = {}
        self._inputs: set[str] = set()
        self._outputs: set[str] = set()
        self._named: dict[str, dict[int, str | None]] = {}
        self._new: tuple[list[Column], list[str], list[str]] = [], [], []

    def used(self, leaf: Leaf, written: bool) -> bool:
        """Notes a use; false where no column can be shown for it."""
        name = leaf.name
        if leaf.passing:
            return False
        if name not in self.all:
            if len(self.all) >= MAX_COLUMNS:
                return False
            self.all[name] = column = _column(leaf)
            self._new[0].append(column)
        known, new = (self._outputs, self._new[2]) if written else (self._inputs, self._new[1])
        if name not in known:
            known.add(name)
            new.append(name)
        return True

    def refer(self, name: str, slot: int, text: str) -> None:
        """What a value of a reference refers to; it is shown like the name of an enumeration's value. The column is told once more."""
        known = self._named.setdefault(name, {})
        if slot in known:
            if known[slot] in (text, None):
                return
            known[slot] = None  # the program has changed, and the rows before that are still there
        elif len(known) >= MAX_NAMES:
            return
        else:
            known[slot] = text
        values = tuple((each, number) for number, each in known.items() if each is not None)
        self.all[name] = column = replace(self.all[name], values=values)
        self._new[0].append(column)

    def take(self) -> tuple[tuple[Column, ...], tuple[str, ...], tuple[str, ...]]:
        """New columns, and names that were inputs and outputs for the first time, since this was last asked."""
        columns, inputs, outputs = self._new
        self._new = [], [], []
        return tuple(columns), tuple(inputs), tuple(outputs)


@dataclass(slots=True)
class Reader:
    """What is needed to make rows of one program."""

    names: Names
    places: Places
    columns: Columns

    def used(self, leaf: Leaf, written: bool, *values: bytes) -> bool:
        """Notes a use and its values; false where no column can be shown for it."""
        if not self.columns.used(leaf, written):
            return False
        if isinstance(leaf.type, Reference):
            for each in values:
                if any(each):
                    text = slot_text(self.names, leaf.type, each)
                    self.columns.refer(leaf.name, int.from_bytes(each, "little"), text)
        return True


@dataclass(slots=True)
class Disturbed:
    """Bytes that are not what the monitor would have there: as the control device has them, and as the monitor would."""

    there: dict[int, int] = field(default_factory=dict)
    own: dict[int, int] = field(default_factory=dict)
    told: set[int] = field(default_factory=set)
    """Those that a row tells of."""
    written: Mapping[int, Sequence[tuple[int, int]]] = field(default_factory=dict)
    """What statements of the scan have written of them (count, bits): what is read of that later is not disturbed."""

    def own_of(self, offset: int, value: bytes, bits: int, position: int) -> bytes | None:
        """What would have been read here, by the statement of this count; None: the same."""
        if not self.own:
            return None
        made = bytearray(value)
        for at, byte in enumerate(value, offset):
            left = bits & ~sum(each for count, each in self.written.get(at, ()) if count < position)
            if at in self.own and left and (self.there[at] ^ byte) & left == 0:
                made[at - offset] = byte & ~left | self.own[at] & left
                if made[at - offset] != byte:
                    self.told.add(at)
        return bytes(made) if made != value else None


@dataclass(slots=True)
class Pair:
    """One pass of both sides."""

    control: Pass | None
    monitor: Pass | None
    scan: int
    call: int
    cut: bool = False
    """A run-time error ended the scan on one side only: that the other one went on says nothing else."""

    @property
    def either(self) -> Pass:
        """The control device's, where it has it."""
        found = self.control or self.monitor
        assert found is not None
        return found


def _column(leaf: Leaf) -> Column:
    type = leaf.type
    return Column(
        leaf.name, type.name, type.kind.value, type.size, type.values if isinstance(type, Enumeration) else ()
    )


def row_of(
    reader: Reader, pair: Pair, inputs: Inputs, number: int, disturbed: Disturbed, control_at: FramesAt,
    monitor_at: FramesAt,
) -> Row:  # fmt: skip
    """The row of a pass."""
    made = pair.either
    names = reader.names.within(made.inside)
    path = reader.places.path(made.pou, made.instance)
    teller = Teller(reader.names, reader.places, names, pair.scan, path, made.pou is not None)
    read, differences = _inputs(reader, names, inputs, number, disturbed, teller) if pair.control else ({}, [])
    outputs = _outputs(reader, names, pair)
    differences += _differences(pair, names, teller, control_at, monitor_at)
    kind: RowKind = "scan" if made.pou is None else "pass"
    note = ""
    full = made.full or (pair.monitor is not None and pair.monitor.full)
    if full:
        made = made if made.full or pair.monitor is None else pair.monitor
        used = f"more than {made.used:,}" if made.uncounted else f"{made.used:,}"
        note = f"record full: {len(made.log):,} of {used} uses kept"
    if pair.cut and (pair.control is None or pair.monitor is None):
        note = f"not run {'in the reference' if pair.monitor is None else 'by the control device'}: a run-time error came before"
    place = None
    if made.pou is not None and made.frames:
        place = reader.places.of(made.frames[0].site, made.frames)
    return Row(
        kind, pair.scan, pair.call, 0, path, place, outputs, read, tuple(differences[:MAX_MISMATCHES]), (), made.used, note,
        compared=not full,
    )  # fmt: skip


def _outputs(reader: Reader, names: NamesInside, pair: Pair) -> dict[str, Output]:
    control, monitor = pair.control, pair.monitor
    mine = _written(reader, names, control.log) if control is not None else {}
    if control is not None and monitor is not None and control.log == monitor.log:
        return {name: Output(value, value) for name, value in mine.items()}
    other = _written(reader, names, monitor.log) if monitor is not None else {}
    return {name: Output(mine.get(name), other.get(name)) for name in {**mine, **other}}


def _written(reader: Reader, names: NamesInside, log: list[Access]) -> dict[str, bytes]:
    """The last values, by columns, in the order of the first writes."""
    found: dict[str, bytes] = {}
    for _, _, offset, size, bits, written, value in log:
        if written:
            for leaf in names.at(offset, size, bits):
                data = leaf.cut(value, offset)
                known = leaf.name in found and not isinstance(leaf.type, Reference)
                if known or reader.used(leaf, True, data):
                    found[leaf.name] = data
    return found


def written_by(reader: Reader, made: Pass) -> dict[str, bytes]:
    """The outputs of one side's pass."""
    return _written(reader, reader.names.within(made.inside), made.log)


def _inputs(
    reader: Reader, names: NamesInside, inputs: Inputs, number: int, disturbed: Disturbed, teller: Teller
) -> tuple[dict[str, Input], list[Mismatch]]:  # fmt: skip
    found: dict[str, Input] = {}
    differences: list[Mismatch] = []
    instead = inputs.expected[number]
    for (_, position, offset, size, bits, _, value), _ in inputs.fresh[number]:
        own = disturbed.own_of(offset, value, bits, position)
        if instead:
            patched = bytearray(value if own is None else own)
            for at in range(offset, offset + size):
                if at in instead:
                    patched[at - offset] = instead[at] & bits
            own = None if patched == value else bytes(patched)
        for leaf in names.at(offset, size, bits):
            if leaf.name in found:
                continue
            recorded = leaf.cut(value, offset)
            expected = None if own is None else leaf.cut(own, offset)
            if expected == recorded:
                expected = None
            if reader.used(leaf, False, recorded, expected or b""):
                found[leaf.name] = Input(recorded, expected)
            if expected is not None:
                differences.append(teller.input(leaf, recorded, expected))
    return found, differences


def _differences(
    pair: Pair, names: NamesInside, teller: Teller, control_at: FramesAt, monitor_at: FramesAt
) -> list[Mismatch]:  # fmt: skip
    """The first place where the two differ, then every result that differs at the end."""
    control = pair.control.log if pair.control is not None else []
    monitor = pair.monitor.log if pair.monitor is not None else []
    if control == monitor and pair.control is not None and pair.monitor is not None:
        return []
    full = any(each is not None and each.full for each in (pair.control, pair.monitor))
    made: list[Mismatch] = []
    told: set[str] = set()
    last: dict[str, tuple[Leaf, Access, bytes, bytes]] = {}
    for one, other in zip(control, monitor, strict=False):
        if one == other:
            continue
        if one[:6] != other[:6]:
            made.append(teller.order(one, other, control_at(one.position), monitor_at(other.position)))
            break
        for leaf in names.at(one.offset, one.size, one.bits):
            here, there = leaf.cut(one.value, one.offset), leaf.cut(other.value, one.offset)
            if here == there:
                last.pop(leaf.name, None)
                continue
            if not made or (one.written and leaf.name not in told):
                told.add(leaf.name)
                cause: Cause = "logic" if one.written else "input"
                made.append(teller.differs(cause, leaf, here, there, one.site, control_at(one.position)))
            last[leaf.name] = leaf, one, here, there
    else:
        if len(control) != len(monitor) and not full and not pair.cut:
            index = min(len(control), len(monitor))
            longer, at = (control, control_at) if len(control) > index else (monitor, monitor_at)
            made.append(teller.only_one(longer[index], longer is control, at(longer[index].position)))
    ended = last.keys()
    # what was right again in the end is told where it is the first
    return [
        each for index, each in enumerate(made) if index == 0 or each.cause == "order" or each.name in ended or not last
    ]
