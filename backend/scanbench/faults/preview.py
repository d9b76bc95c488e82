"""What raising errors would write now, in the vendor's notation. Nothing is changed."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from scanbench.faults.details import Bits, choose, field_bits
from scanbench.faults.inject import ACTIVE, Generate, present_choices
from scanbench.faults.reference import ErrorRef, find_error
from scanbench.plcmodel.model import Area, Location, Model
from scanbench.public import Public
from scanbench.runtime.command import Patch, Refusal, View

What = Literal["detail", "code", "flag", "log", "time", "outputs", "other"]
"""time: when the latest error came. outputs: cleared by a fatal error, unless memory is held."""
_MOST_OTHERS = 40
"""Words that are named of what changes besides: a fatal error may clear whole areas."""


@dataclass(frozen=True, slots=True)
class PreviewedWrite(Public):
    """A bit or a word, with its values before and after."""

    address: str
    """In the vendor's notation."""
    before: str
    after: str
    what: What
    error: str
    """Which error writes it; empty for the code word, the log, the time and what the PLC itself does."""


@dataclass(frozen=True, slots=True)
class Preview:
    """What would happen, or why it would be refused."""

    ok: bool
    message: str
    writes: tuple[PreviewedWrite, ...] = ()
    """The errors' own first, then the code word, the log, the time, and what the PLC does besides."""
    more: int = 0
    """Words that change besides, and are not named."""


def preview(view: View, errors: Sequence[ErrorRef], again: bool, anyway: bool = False) -> Preview:
    """Plans it, and looks at the plan."""
    plan = Generate("preview", tuple(errors), again=again, anyway=anyway).plan(view)
    if isinstance(plan, Refusal):
        return Preview(False, plan.message)
    looked = _Looked(view, plan.patches)
    looked.take(_own(view, errors))
    looked.take(_replaced(view, errors), only_changed=True)
    word = view.model.code_word
    if word is not None:
        looked.take_code(word)
    looked.take(_log(view), only_changed=True)
    looked.take(_time(view), only_changed=True)
    more = looked.take_others()
    return Preview(True, plan.message, tuple(looked.writes), more)


Part = tuple[What, str, Sequence[Bits]]
"""Bits that belong together: what they are, and whose."""


def _own(view: View, errors: Iterable[ErrorRef]) -> Iterator[Part]:
    layout = view.program.layout
    for ref in errors:
        entry = find_error(view.model, ref.id)
        assert not isinstance(entry, Refusal)  # it was planned
        chosen = choose(entry, dict(ref.details), layout)
        assert not isinstance(chosen, Refusal)
        flag = field_bits(entry.flag, 0, 1, 1, layout)
        yield "flag", entry.id, flag
        yield "detail", entry.id, chosen.contents
        yield "other", entry.id, [part for part in chosen.marks if part not in flag]


def _replaced(view: View, errors: Iterable[ErrorRef]) -> Iterator[Part]:
    """Details of errors that are raised again: the old ones go."""
    present = view.derived(ACTIVE)
    settled = Generate("preview", tuple(errors), again=True).settled(view)
    for id, several in present_choices(view, present).items():
        for ref, one in zip(present[id].refs, several, strict=True):
            if ref in (settled.replaces or ()):
                yield "detail", id, one.contents


def _log(view: View) -> Iterator[Part]:
    log, areas = view.model.log, view.program.layout.areas
    if log is not None:
        first = areas[log.first.area.name] + log.first.byte
        counter = areas[log.counter.area.name] + log.counter.byte
        yield "log", "", [Bits(counter, 0xFF, 0)]
        yield "log", "", [Bits(first + each, 0xFF, 0) for each in range(2 * log.words * log.records)]


def _time(view: View) -> Iterator[Part]:
    time = view.model.error_time
    if time is not None:
        first = view.program.layout.areas[time.first.area.name] + time.first.byte
        yield "time", "", [Bits(first + each, 0xFF, 0) for each in range(len(time.fields))]


class _Looked:
    """The memory before and after the plan, and what was told of it."""

    def __init__(self, view: View, patches: Iterable[Patch]) -> None:
        self._layout, self._before = view.program.layout, view.memory
        self._after = bytearray(view.memory)
        self._told: set[tuple[int, int]] = set()
        self._symbols = _word_symbols(view.model)
        self.writes: list[PreviewedWrite] = []
        self._patched: list[int] = []
        for patch in patches:
            for index, (mask, data) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
                self._after[index] = self._after[index] & ~mask | data & mask
                self._patched.append(index)

    def take(self, parts: Iterable[Part], only_changed: bool = False) -> None:
        """Tells of these bits, unless that was done."""
        for what, error, bits in parts:
            words: dict[int, int] = {}
            for part in bits:
                at, shift = self._word(part.offset)
                words[at] = words.get(at, 0) | part.mask << shift
            for at, mask in sorted(words.items()):
                self._tell(at, mask, what, error, only_changed)

    def take_code(self, word: Location) -> None:
        """The code word as one number, however wide, in the form in which the device shows codes."""
        start = self._layout.areas[word.area.name] + word.byte
        size = word.bits // 8
        before, after = (int.from_bytes(memory[start : start + size], "little") for memory in self._both)
        texts = self._layout.model.show_code(before), self._layout.model.show_code(after)
        self.writes.append(PreviewedWrite(self._address(word.area, word.byte, None), *texts, "code", ""))
        self._told.update((start + each, 0xFFFF) for each in range(0, size, 2))

    def take_others(self) -> int:
        """What else changes, in words that have an address: what the PLC does when it stops. How many are not named."""
        known = {at for at, _ in self._told}
        changed = {self._word(each)[0] for each in self._patched if self._differs(each)}
        words = sorted(at for at in changed - known if self._layout.area_at(at) is not None)
        for at in words[:_MOST_OTHERS]:
            self._tell(at, 0xFFFF, "outputs" if self._is_output(at) else "other", "", True)
        return max(len(words) - _MOST_OTHERS, 0)

    @property
    def _both(self) -> tuple[bytes | bytearray | memoryview, bytearray]:
        return self._before, self._after

    def _word(self, offset: int) -> tuple[int, int]:
        """Where the word begins that holds a byte, and by how much the byte is shifted in it."""
        return offset - offset % 2, 8 * (offset % 2)

    def _is_output(self, at: int) -> bool:
        found = self._layout.area_at(at)
        return found is not None and any(
            words.area.name == found[0].name and words.first <= found[1] // 2 <= words.last
            for words in self._layout.model.fatal.outputs
        )

    def _address(self, area: Area, byte: int, bit: int | None) -> str:
        """The name that people know: some devices have names for words, to which Scanbench assigns numbers of its own."""
        symbol = self._symbols.get((area.name, byte))
        if bit is None:
            return symbol or self._layout.model.format(area, byte, None, 16)
        address = self._layout.model.format(area, byte + bit // 8, bit % 8, 1)
        return address if symbol is None else f"{symbol}.{address.rpartition('.')[2]}"

    def _differs(self, offset: int) -> bool:
        return self._before[offset] != self._after[offset]

    def _tell(self, at: int, mask: int, what: What, error: str, only_changed: bool) -> None:
        found = self._layout.area_at(at)
        before, after = (int.from_bytes(memory[at : at + 2], "little") for memory in self._both)
        if found is None or (at, mask) in self._told or (only_changed and not (before ^ after) & mask):
            return
        self._told.add((at, mask))
        area, byte = found
        bit = mask.bit_length() - 1
        if mask == 1 << bit:
            address = self._address(area, byte, bit)
            texts = str(before >> bit & 1), str(after >> bit & 1)
        else:
            address = self._address(area, byte, None)
            texts = f"{before:04X}", f"{after:04X}"
        self.writes.append(PreviewedWrite(address, *texts, what, error))


def _word_symbols(model: Model) -> dict[tuple[str, int], str]:
    """The names of whole words, by area and byte: `_PLC_ErrSta`. Bits with a name are known by their address too."""
    words = (each for each in model.specials if each.symbol and each.location.bit is None)
    return {(each.location.area.name, each.location.byte): each.symbol for each in words}
