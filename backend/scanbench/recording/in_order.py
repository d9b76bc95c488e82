"""The good blocks of a damaged file in the order in which they were written: a disk may have mixed them up."""

from collections.abc import Sequence

from scanbench.recording.format import Block, Kind

_ALONE = (Kind.ABOUT, Kind.PROGRAM)
"""They may be anywhere."""


def in_order(blocks: Sequence[Block]) -> list[Block]:
    """These blocks by the numbers of the entries before them, no entry twice, and none whose scan does not fit."""
    alone = [each for each in blocks if each.kind in _ALONE]
    scan, number = 0, -1
    kept: list[Block] = []
    for block in sorted((each for each in blocks if each.kind not in _ALONE), key=_key):
        again = block.kind is Kind.ENTRY and block.entries == number
        if block.scan < scan or again:
            continue
        scan = block.scan
        number = block.entries if block.kind is Kind.ENTRY else number
        kept.append(block)
    return [*alone, *kept]


def _key(block: Block) -> tuple[int, bool, int, int]:
    return block.entries, block.kind is Kind.ENTRY, block.scan, block.offset
