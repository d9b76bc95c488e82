"""Places of the image: where they are, and how they are read and written."""

from collections.abc import Callable

from scanbench.engines.interpreter.memory import Value, getter, putter
from scanbench.program.layout import Layout
from scanbench.program.program import Base, Expr, Index, Place
from scanbench.program.types import Kind

Read = Callable[[int], Value]
"""Takes the offset of the running instance."""
Write = Callable[[int, Value], None]
Address = Callable[[int], int]
Reference = Callable[[int], int]
"""A reference as an in-out slot holds it: byte offset in bits 0-31, bit number in bits 32-34."""

BYTE_OFFSET = 0xFFFF_FFFF
BIT_SHIFT = 32
BIT_NUMBER = 7 << BIT_SHIFT
WORD = (1 << 64) - 1


class Trapped(Exception):
    """The program trapped at this site."""

    def __init__(self, trap: int) -> None:
        super().__init__(trap)
        self.trap = trap


class Places:
    """Closures on places, for the body of one POU, whose trap sites count from `first_trap`.

    References reach to `state_size`, as frames follow there, in-outs to the end of the memory.
    """

    def __init__(
        self,
        memory: bytearray,
        state_size: int,
        frame_offset: int,
        evaluate: Callable[[Expr], Read],
        first_trap: int = 0,
    ) -> None:
        self.memory = memory
        self.state_size = state_size
        self.frame_offset = frame_offset
        self.evaluate = evaluate
        self.first_trap = first_trap

    def fixed(self, place: Place) -> int | None:
        """The byte offset of a place that is always there."""
        if place.indices or place.slot is not None or place.reference is not None or place.base is Base.SELF:
            return None
        return place.offset + (self.frame_offset if place.base is Base.FRAME else 0)

    def reference(self, place: Place, size: int = 0) -> Reference:
        """The reference to a place. The target of a reference that is followed must have at least `size` bytes in the image."""
        start = self._start(place, size)
        if not place.indices:
            return start
        if any(not isinstance(index.low, int) for index in place.indices):
            return self._open(place, start)
        steps = [self._step(index) for index in place.indices]
        if len(steps) == 1:
            only = steps[0]
            return lambda instance: start(instance) + only(instance)
        return lambda instance: start(instance) + sum([step(instance) for step in steps])

    def _step(self, index: Index) -> Address:
        """Bytes from the first element of a dimension."""
        value, trap = self.evaluate(index.value), self.first_trap + index.trap
        low, high, stride = index.low, index.high, index.stride
        if isinstance(low, int) and isinstance(high, int) and isinstance(stride, int):

            def step(instance: int, low: int = low, high: int = high, stride: int = stride) -> int:
                number = value(instance)
                if not low <= number <= high:  # type: ignore[operator]
                    raise Trapped(trap)
                return (number - low) * stride  # type: ignore[operator,return-value]

            return step
        parts = [self._number(part) for part in (low, high, stride)]

        def open_step(instance: int) -> int:
            number = value(instance)
            assert isinstance(number, int)
            first, last, bytes_each = (part(instance) for part in parts)
            if not first <= number <= last:
                raise Trapped(trap)
            return (number - first) * bytes_each

        return open_step

    def _number(self, part: int | Expr) -> Address:
        if isinstance(part, int):
            return lambda instance: part
        return self.evaluate(part)  # type: ignore[return-value]

    def _open(self, place: Place, start: Reference) -> Reference:
        """Bounds that come with a call may say anything: so the element is checked as a reference is."""
        steps = [self._step(index) for index in place.indices]
        end, trap = self._end(place, place.type.size), self.first_trap + (place.null_trap or place.indices[-1].trap)

        def indexed(instance: int) -> int:
            first = start(instance)
            at = (first & BYTE_OFFSET) + sum([step(instance) for step in steps]) & WORD
            if not Layout.HEADER_SIZE <= at <= end:
                raise Trapped(trap)
            return at | first & BIT_NUMBER

        return indexed

    def _end(self, place: Place, size: int) -> int:
        """The last offset where so many bytes are where the place may be."""
        return (len(self.memory) if place.reference is None else self.state_size) - size

    def _start(self, place: Place, size: int) -> Reference:
        offset, bit = place.offset, (place.bit or 0) << BIT_SHIFT
        if place.slot is not None or place.reference is not None:
            return self._through(place, size)
        if place.base is Base.SELF:
            return (lambda instance: instance + offset | bit) if bit else (lambda instance: instance + offset)
        fixed = offset + (self.frame_offset if place.base is Base.FRAME else 0) | bit
        return lambda instance: fixed

    def _through(self, place: Place, size: int) -> Reference:
        if place.slot is not None:
            follow = self.follow(place.slot)
        else:
            assert place.reference is not None
            follow = self.evaluate(place.reference)
        offset, trap = place.offset, self.first_trap + place.null_trap
        end = self._end(place, _reach(place, size))
        # what a BOOL's reference says of the bit goes on, unless the place names one itself; other types have none
        kept = BYTE_OFFSET | (BIT_NUMBER if place.type.kind is Kind.BOOL and place.bit is None else 0)
        bit = (place.bit or 0) << BIT_SHIFT

        def through(instance: int) -> int:
            found = follow(instance)
            assert isinstance(found, int)
            if not Layout.HEADER_SIZE <= found & ~BIT_NUMBER <= end:
                raise Trapped(trap)
            return (found & kept) + offset | bit

        return through

    def follow(self, slot: Place) -> Read:
        """What an in-out slot holds."""
        return self.read(slot)

    def address(self, place: Place, size: int = 0) -> Address:
        """The byte offset of a place."""
        reference = self.reference(place, size)
        if place.bit is None and place.slot is None and place.reference is None:
            return reference
        return lambda instance: reference(instance) & BYTE_OFFSET

    def _in_bits(self, place: Place) -> bool:
        referenced = place.slot is not None or place.reference is not None
        return place.type.kind is Kind.BOOL and (place.bit is not None or referenced)

    def read(self, place: Place) -> Read:
        """The value of a place."""
        memory = self.memory
        if self._in_bits(place):
            reference = self.reference(place)

            def read_bit(instance: int) -> Value:
                at = reference(instance)
                return memory[at & BYTE_OFFSET] >> (at >> BIT_SHIFT) & 1

            return read_bit
        get, fixed, offset = getter(memory, place.type), self.fixed(place), place.offset
        if fixed is not None:
            return lambda instance: get(fixed)
        if place.base is Base.SELF and not place.indices and place.slot is None and place.reference is None:
            return lambda instance: get(instance + offset)
        where = self.address(place)
        return lambda instance: get(where(instance))

    def write(self, place: Place) -> Write:
        """Stores a value in a place."""
        memory = self.memory
        if self._in_bits(place):
            reference = self.reference(place)

            def write_bit(instance: int, value: Value) -> None:
                at = reference(instance)
                byte, mask = at & BYTE_OFFSET, 1 << (at >> BIT_SHIFT)
                memory[byte] = memory[byte] | mask if value else memory[byte] & ~mask

            return write_bit
        put, fixed = putter(memory, place.type), self.fixed(place)
        if fixed is not None:
            return lambda instance, value: put(fixed, value)
        where = self.address(place)
        return lambda instance, value: put(where(instance), value)

    def set_bytes(self, place: Place, data: bytes) -> Callable[[int], None]:
        """Stores fixed bytes in a place."""
        memory, where = self.memory, self.address(place)

        def set_bytes(instance: int) -> None:
            at = where(instance)
            memory[at : at + len(data)] = data

        return set_bytes


def _reach(place: Place, size: int) -> int:
    """Bytes that the place may need at the reference's target."""
    reach = place.offset + max(place.type.size, size)
    for index in place.indices:
        if isinstance(index.low, int) and isinstance(index.high, int) and isinstance(index.stride, int):
            reach += (index.high - index.low) * index.stride
    return reach
