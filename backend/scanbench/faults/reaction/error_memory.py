"""Which bits of the image are error memory, and which of them say what about one error."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scanbench.faults.details import Bits, Chosen, choose, field_bits
from scanbench.faults.reaction.reaction import What
from scanbench.faults.standby import standby_bits, watched_bits
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.runtime.command import Patch, Refusal

Words = NDArray[np.uint64]
WORD = 8
"""Bytes: states are compared in words of this size."""


def words_of(program: Program) -> int:
    """So many words hold the state. The last one may reach beyond it."""
    return -(-program.layout.state_size // WORD)


def kept_bits(program: Program) -> Words:
    """The bits that hold what a program keeps: not the system's own, the code word and the log of errors."""
    layout, model = program.layout, program.layout.model
    mask = bytearray(words_of(program) * WORD)
    mask[Layout.HEADER_SIZE : layout.state_size] = b"\xff" * (layout.state_size - Layout.HEADER_SIZE)
    mask[Layout.SUBRANGE_ERROR] = 0xFF
    mask[Layout.SUBRANGE_COUNT : Layout.SUBRANGE_COUNT + 4] = b"\xff" * 4
    if layout.violations:
        mask[layout.violations : layout.state_size] = bytes(layout.state_size - layout.violations)
    for instance in program.common:
        size = instance.pou.instance.size
        mask[instance.offset : instance.offset + size] = bytes(size)
    for special in model.specials:
        if special.role:
            bits = special.location.bits if special.role != "clock" else 8 * len(special.fields)
            _clear(mask, field_bits(special.location, 0, bits, 0, layout))
    _clear(mask, code_bits(program))
    _clear(mask, log_bits(program))
    _clear(mask, standby_bits(layout))
    return np.frombuffer(bytes(mask), np.uint64).copy()


def without_patches(kept: Words, patches: Iterable[Patch]) -> Words:
    """The same without the bits that these patches write."""
    left = bytearray(kept.tobytes())
    for patch in patches:
        for index, byte in enumerate(patch.mask, patch.offset):
            if index < len(left):
                left[index] &= ~byte
    return np.frombuffer(bytes(left), np.uint64)


def code_bits(program: Program) -> list[Bits]:
    """The code word; nothing where the model has none."""
    word = program.layout.model.code_word
    return [] if word is None else field_bits(word, 0, word.bits, 0, program.layout)


def log_bits(program: Program) -> list[Bits]:
    """The model's own error log with its counter; nothing where it has none."""
    log, layout = program.layout.model.log, program.layout
    if log is None:
        return []
    records = field_bits(log.first, 0, 16 * log.words * log.records, 0, layout)
    return [*records, *field_bits(log.counter, 0, log.counter.bits, 0, layout)]


def error_bits(program: Program) -> list[Bits]:
    """All that the errors of the model write, whatever their details are."""
    layout = program.layout
    found = [*code_bits(program), *log_bits(program), *standby_bits(layout)]
    for entry in layout.model.errors():
        chosen = choose(entry, {}, layout)
        found += () if isinstance(chosen, Refusal) else chosen.bits
        for address in (each for detail in entry.details for each in detail.addresses):
            if address.location is not None:
                most = address.maximum or 0
                bits = 8 * most if address.is_text else most + 1 if address.kind == "BitArray" else 0
                found += field_bits(address.location, 0, max(bits, address.location.bits), 0, layout)
    return list({(each.offset, each.mask): each for each in found}.values())


def _clear(mask: bytearray, parts: Iterable[Bits]) -> None:
    for part in parts:
        mask[part.offset] &= ~part.mask


@dataclass(frozen=True, slots=True)
class Watched:
    """What a program may read of one error: masks by byte."""

    flag: dict[int, int]
    code: dict[int, int]
    detail: dict[int, int]
    log: dict[int, int]

    @staticmethod
    def of(program: Program, chosen: Chosen) -> "Watched":
        """Of an error with its details decided."""
        single = {(part.offset, part.mask) for part in chosen.marks if part.mask & (part.mask - 1) == 0}
        flags = [part for part in chosen.marks if (part.offset, part.mask) in single]
        flags += watched_bits(program.layout.model, chosen.error.id, program.layout)
        details = [*chosen.contents, *(part for part in chosen.marks if part not in flags)]
        code, log = (code_bits(program), log_bits(program)) if chosen.error.coded else ([], [])
        return Watched(_by_byte(flags), _by_byte(code), _by_byte(details), _by_byte(log))

    @property
    def bits(self) -> Iterator[tuple[int, int]]:
        """For `Observer.watch`."""
        for part in (self.flag, self.code, self.detail, self.log):
            yield from part.items()

    def kinds(self, offset: int, mask: int) -> Iterator[What]:
        """What somebody looks at who reads these bits of a byte."""
        if self.flag.get(offset, 0) & mask:
            yield "flag"
        if self.code.get(offset, 0) & mask:
            yield "code"
        if self.detail.get(offset, 0) & mask:
            yield "detail"
        if self.log.get(offset, 0) & mask:
            yield "log"


def _by_byte(parts: Iterable[Bits]) -> dict[int, int]:
    found: dict[int, int] = {}
    for part in parts:
        found[part.offset] = found.get(part.offset, 0) | part.mask
    return found
