"""The bits of errors that come and go, as patches: flags, details and the code word of what is left."""

from collections.abc import Iterable, Iterator, Sequence

from scanbench.faults.details import Bits, Chosen, field_bits
from scanbench.plcmodel.model import Location
from scanbench.runtime.command import Patch, View


def switch(view: View, off: Sequence[Chosen], on: Sequence[Chosen], others: Sequence[Chosen]) -> Iterator[Patch]:
    """The bits of `off` cleared, but for those that `others` share; the bits of `on` set; the code word of all."""
    bits: dict[int, tuple[int, int]] = {}
    for one in off:
        _merge(bits, (Bits(part.offset, part.mask, 0) for part in one.bits))
    cleared = {offset: mask for offset, (mask, _) in bits.items()}
    for one in others:
        shared = (Bits(part.offset, part.mask & cleared.get(part.offset, 0), part.value) for part in one.bits)
        _merge(bits, shared)
    for one in on:
        _merge(bits, one.bits)
    word = view.model.code_word
    if word is not None:
        _merge(bits, field_bits(word, 0, word.bits, shown_code([*others, *on]), view.program.layout))
    for query in view.model.queries:
        code = shown_code([one for one in (*others, *on) if _in_word(one.error.flag, query.flags)])
        _merge(bits, field_bits(query.code, 0, query.code.bits, code, view.program.layout))
    for offset, (mask, value) in sorted(bits.items()):
        yield Patch(offset, bytes((mask,)), bytes((value,)))


def shown_code(present: Sequence[Chosen]) -> int:
    """The code of the most serious error that has one; of one that is present with several numbers the lowest; 0 where none is."""
    first = min((one for one in present if one.error.coded), key=rank, default=None)
    return 0 if first is None else first.code


def rank(one: Chosen) -> tuple[int, int, int]:
    """The most serious first: the device's own fatal errors, then fatal errors of a project, then everything by priority."""
    place = 2 if one.error.severity == "nonfatal" else 1 if one.error.user else 0
    return place, one.error.priority, one.code


def _in_word(flag: Location, word: Location) -> bool:
    return (flag.area.name, flag.word) == (word.area.name, word.word)


def _merge(bits: dict[int, tuple[int, int]], more: Iterable[Bits]) -> None:
    for part in more:
        mask, value = bits.get(part.offset, (0, 0))
        bits[part.offset] = (mask | part.mask, value & ~part.mask | part.value & part.mask)
