"""What observed closures note: at each read and at each statement, by the way that they run."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager

from scanbench.engines.interpreter.memory import Value, getter
from scanbench.engines.interpreter.places import BIT_SHIFT, BYTE_OFFSET, Places, Read
from scanbench.engines.observe import LIMIT, Observer, ReadAt, Seen
from scanbench.program.program import Expr, Place, Pou, Program, Stmt

ALL = 0xFF


class ReferenceObserver(Observer):
    """Notes what the closures of one program do."""

    def __init__(self, program: Program) -> None:
        super().__init__(program)
        self._watched: dict[int, int] = {}
        self._reached: set[int] = set()
        self._reads: dict[tuple[int, int], int] = {}
        self._lost = 0
        self._site: int | None = None
        self._silent = False

    def watch(self, bits: Iterable[tuple[int, int]]) -> None:
        self._watched = self._masks(bits)

    def take(self) -> Seen:
        reads = tuple(ReadAt(site, offset, mask) for (site, offset), mask in self._reads.items())
        seen = Seen(frozenset(self._reached), reads, self._lost)
        self._reached, self._reads, self._lost = set(), {}, 0
        return seen

    def places(
        self,
        memory: bytearray,
        state_size: int,
        frame_offset: int,
        evaluate: Callable[[Expr], Read],
        first_trap: int,
    ) -> Places:
        """The places of the body of one POU."""
        return ObservedPlaces(self, memory, state_size, frame_offset, evaluate, first_trap)

    def body(self, pou: Pou, run: Callable[[int], int]) -> Callable[[int], int]:
        """The closure of a whole body."""
        return run

    def way(self, node: Stmt, way: int, run: Callable[[int], int]) -> Callable[[int], int]:
        """The closure of one way that a statement can go, see `Sites.outcome`."""
        return run

    def tries(self) -> object:
        """A __TRY begins; gives what `caught` needs to know."""
        return None

    def caught(self, known: object) -> None:
        """A trap in this __TRY, or in what it called, is caught."""

    # ---- while the program runs -----------------------------------------------------------------------------

    @contextmanager
    def silence(self) -> Iterator[None]:
        """What runs meanwhile is not the user's program."""
        self._silent = True
        try:
            yield
        finally:
            self._silent = False

    def statement(self, node: Stmt, run: Callable[[int], int]) -> Callable[[int], int]:
        """The closure of a statement, which is marked when it begins."""
        number = self.sites.number(node)
        if number is None:
            return run

        def observed(instance: int) -> int:
            if self._silent:
                return run(instance)
            outer, self._site = self._site, number
            self._reached.add(number)
            try:
                return run(instance)
            finally:
                self._site = outer

        return observed

    def read(self, offset: int, size: int, mask: int) -> None:
        """Bits in these bytes are read."""
        site = self._site
        if site is None or self._silent or not self._watched:
            return
        for at in range(offset, offset + size):
            bits = self._watched.get(at, 0) & mask
            if not bits:
                continue
            key = site, at
            if key in self._reads or len(self._reads) < LIMIT:
                self._reads[key] = self._reads.get(key, 0) | bits
            else:
                self._lost += 1


class ObservedPlaces(Places):
    """Places whose reads are noted."""

    def __init__(
        self,
        observer: ReferenceObserver,
        memory: bytearray,
        state_size: int,
        frame_offset: int,
        evaluate: Callable[[Expr], Read],
        first_trap: int = 0,
    ) -> None:
        super().__init__(memory, state_size, frame_offset, evaluate, first_trap)
        self.observer = observer

    def read(self, place: Place) -> Read:
        memory, note = self.memory, self.observer.read
        if self._in_bits(place):
            reference = self.reference(place)

            def read_bit(instance: int) -> Value:
                found = reference(instance)
                at, bit = found & BYTE_OFFSET, found >> BIT_SHIFT
                note(at, 1, 1 << bit)
                return memory[at] >> bit & 1

            return read_bit
        get, where, size = getter(memory, place.type), self.address(place), place.type.size

        def read(instance: int) -> Value:
            at = where(instance)
            note(at, size, ALL)
            return get(at)

        return read
