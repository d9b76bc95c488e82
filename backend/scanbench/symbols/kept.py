"""The variables that people count where two states differ: down to single values, by every name that a byte has."""

from collections.abc import Generator, Iterator

from scanbench.plcmodel.areas import Area
from scanbench.program.origin import in_library
from scanbench.program.own_variables import SYSTEM
from scanbench.program.program import Program
from scanbench.program.types import BOOL, ArrayType, Elementary, Kind, Record, Section, StringType
from scanbench.symbols.descent import Descent, Part
from scanbench.symbols.leaves import Leaf
from scanbench.symbols.symbols import RAW_TYPES

_SYSTEM = Part("", SYSTEM, 0)


class KeptNames:
    """Names what a program keeps: all that the user declared, and the outputs of the library's blocks. What is only passed on
    (in-outs, and unless they are wanted inputs of blocks), the inside of the library's blocks, and what the compiler made have no
    name here."""

    def __init__(self, program: Program, inputs: bool = False) -> None:
        """`inputs`: those of blocks, too."""
        self._layout, self._inputs = program.layout, inputs
        self._descent = Descent(program)
        self._library = {pou.instance.name for pou in program.pous if in_library(pou.span)}

    def at(self, offset: int, mask: int) -> Iterator[Leaf]:
        """The variables that have any of these bits of the two bytes from an even offset on, in the order of the bytes.

        Addresses of the model where no variable is: of the bit when it is one, else of the word.
        """
        area = self._layout.area_at(offset)
        left = 0
        for index in range(2):
            part = mask >> 8 * index & 0xFF
            if area is not None:
                left |= (yield from self._in_area(offset + index, part)) << 8 * index
            elif part:
                yield from self._declared(offset + index, part)
        if left and area is not None:
            yield self._raw(*area, offset, left)

    def _declared(self, offset: int, mask: int) -> Iterator[Leaf]:
        root = self._descent.root(offset)
        if root is not None:
            yield from self._down(root, offset, mask, root.member is None)
        elif offset < self._layout.HEADER_SIZE:
            for each in self._descent.inner(_SYSTEM, offset, offset + 1):
                yield from self._down(each, offset, mask)

    def _in_area(self, offset: int, mask: int) -> Generator[Leaf, None, int]:
        """Variables of one bit come first: a word around them says less. Returns the bits that no variable has."""
        known = self._descent.located(offset)
        for each in known:
            if each.bit is not None and mask >> each.bit & 1:
                yield Leaf(each.name, BOOL, offset, each.bit)
        left = mask
        for each in known:
            left &= ~(1 << each.bit) if each.bit is not None else 0xFF
        for each in known:
            if each.bit is None and left:
                yield from self._down(each, offset, mask)
                left = 0
        return left

    def _down(self, part: Part, offset: int, mask: int, program: bool = False) -> Iterator[Leaf]:
        """To the single values that have bits of the byte."""
        type = part.type
        if isinstance(type, Elementary | StringType) and (part.bit is None or mask >> part.bit & 1):
            yield Leaf(part.name, type, part.offset, part.bit)
        if not isinstance(type, Record | ArrayType):
            return
        of_library = isinstance(type, Record) and type.name in self._library
        of_block = type.kind is Kind.BLOCK and not program
        for each in self._descent.inner(part, offset, offset + 1):
            section = None if each.member is None else each.member.section
            if each.elsewhere or (each.member is not None and each.member.hidden):
                continue
            if of_block and section is Section.INPUT and not self._inputs:
                continue
            if not of_library or section is Section.OUTPUT:
                yield from self._down(each, offset, mask)

    def _raw(self, area: Area, byte: int, offset: int, mask: int) -> Leaf:
        if mask & (mask - 1) == 0:
            index, bit = divmod(mask.bit_length() - 1, 8)
            name = self._layout.model.format(area, byte + index, bit, 1)
            return Leaf(name, RAW_TYPES[1], offset + index, bit, raw=True)
        return Leaf(self._layout.model.format(area, byte, None, 16), RAW_TYPES[16], offset, None, raw=True)
