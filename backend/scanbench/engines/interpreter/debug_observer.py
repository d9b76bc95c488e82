"""What closures of the debug flavour do besides: count statements, keep frames, tell of accesses, mark outcomes, halt."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from scanbench.engines.debug import NOTHING, READ, WRITE, Frame, Hook, Listen, frame_of
from scanbench.engines.interpreter.memory import Value, putter
from scanbench.engines.interpreter.observer import ALL, ObservedPlaces, ReferenceObserver
from scanbench.engines.interpreter.places import BIT_SHIFT, BYTE_OFFSET, Places, Read, Write
from scanbench.engines.observe import Seen
from scanbench.program.copies import makes_copies
from scanbench.program.program import Expr, Place, Pou, Program, Stmt
from scanbench.program.tasks import ProgramInstance

Run = Callable[[int], int]


class Halted(Exception):
    """The hook wants to halt here; leaves the scan."""


class DebugObserver(ReferenceObserver):
    """Of one engine. Whatever ends a scan leaves count and frames as they were there."""

    def __init__(self, program: Program, memory: bytearray) -> None:
        super().__init__(program)
        self.memory = memory
        self.count = 0
        self.hook: Hook | None = None
        self._frames: list[tuple[Pou, int, int | None]] = []  # with the site of the caller
        self._innermost: int | None = None
        self._outcomes: set[int] = set()
        self._sites: frozenset[int] = frozenset()
        self._every = False
        self._wanted = 0
        self._bytes: Mapping[int, int] = {}
        self._accesses = 0
        self._hears = False
        self.bits = ALL

    def listen(self, listen: Listen = NOTHING) -> None:
        """What the hook is called for from now on."""
        self._sites, self._every, self._wanted = listen.sites, listen.every, listen.count
        self._bytes = {at: kinds for at, kinds in listen.bytes.items() if kinds}
        self._accesses = listen.accesses
        self._hears = bool(self._bytes) or listen.accesses != 0

    def take(self) -> Seen:
        seen = replace(super().take(), outcomes=frozenset(self._outcomes))
        self._outcomes = set()
        return seen

    def begin(self) -> None:
        """A scan begins."""
        self.count, self._innermost = 0, None
        self._frames.clear()

    def end(self) -> None:
        """The scan is over, in whatever way: what runs now belongs to no statement."""
        self._innermost, self._site, self._silent = self._site, None, False

    def frames(self) -> tuple[Frame, ...]:
        """Innermost first."""
        site, found = self._site if self._site is not None else self._innermost, list[Frame]()
        for pou, instance, caller in reversed(self._frames):
            if site is None and found:
                site = self.sites.bodies[pou][0]  # it begins, and calls what initialises a block: its first one is next
            if site is not None:
                found.append(frame_of(pou, instance, site, self.memory))
            site = caller
        return tuple(found)

    # ---- closures -------------------------------------------------------------------------------------------

    def places(
        self,
        memory: bytearray,
        state_size: int,
        frame_offset: int,
        evaluate: Callable[[Expr], Read],
        first_trap: int,
    ) -> Places:
        return DebugPlaces(self, memory, state_size, frame_offset, evaluate, first_trap)

    def body(self, pou: Pou, run: Run) -> Run:
        """The body of a POU of the user's, which has a frame."""
        if pou not in self.sites.bodies:
            return run
        frames, copies = self._frames, makes_copies(pou.instance)

        def body(instance: int) -> int:
            caller = self._site
            frames.append((pou, instance, caller))
            if not copies:
                self._site = None  # start values are no part of the statement that calls
            end = run(instance)
            frames.pop()
            self._site = caller
            return end

        return body

    def connected(self, instance: ProgramInstance, run: Run) -> Run:
        """Lines of a CONFIGURATION: they run in a frame of their program instance, which does not run yet."""
        frames, frame = self._frames, (instance.pou, instance.offset, None)

        def lines(nobody: int) -> int:
            frames.append(frame)
            end = run(nobody)
            frames.pop()
            return end

        return lines

    def way(self, node: Stmt, way: int, run: Run) -> Run:
        number = self.sites.outcome(node, way)
        if number is None:
            return run

        def marked(instance: int) -> int:
            if not self._silent:
                self._outcomes.add(number)
            return run(instance)

        return marked

    def tries(self) -> object:
        return len(self._frames), self._site

    def caught(self, known: object) -> None:
        assert isinstance(known, tuple)
        depth, self._site = known
        del self._frames[depth:]

    def statement(self, node: Stmt, run: Run) -> Run:
        """The closure of a statement, before which it may halt."""
        site = self.sites.number(node)
        if site is None:
            return run

        def statement(instance: int) -> int:
            if self._silent:
                return run(instance)
            outer, self._site = self._site, site
            self.count += 1
            self._reached.add(site)
            if self._every or self.count == self._wanted or site in self._sites:
                self._begins(site)
            end = run(instance)
            self._site = outer
            return end

        return statement

    def _begins(self, site: int) -> None:
        if self.hook is not None and self.hook.statement(site, self.count, len(self._frames)):
            raise Halted

    # ---- accesses -------------------------------------------------------------------------------------------

    def read(self, offset: int, size: int, mask: int) -> None:
        if self._watched:
            super().read(offset, size, mask)
        if self._hears:
            self._access(offset, size, READ, mask)

    def written(self, offset: int, size: int, mask: int = ALL) -> None:
        """These bytes have been written, or these bits of one."""
        if self._hears:
            self._access(offset, size, WRITE, mask)

    def _access(self, offset: int, size: int, kind: int, mask: int) -> None:
        if self._site is None or self._silent or self.hook is None:
            return
        self.bits = mask
        if self._accesses & kind:
            self.hook.access(self._site, self.count, offset, size, kind == WRITE)
            return
        listened, span = self._bytes, range(offset, offset + size)
        inside: Iterable[int] = span if size <= len(listened) else (at for at in listened if at in span)
        if any(listened.get(at, 0) & kind for at in inside):
            self.hook.access(self._site, self.count, offset, size, kind == WRITE)


class DebugPlaces(ObservedPlaces):
    """Places whose writes are told, too."""

    observer: DebugObserver

    def fixed(self, place: Place) -> int | None:
        """None: what writes straight to an offset would not be told."""
        return None

    def follow(self, slot: Place) -> Read:
        """Untold: nobody wrote a slot in the text."""
        return Places.read(self, slot)

    def write(self, place: Place) -> Write:
        memory, told = self.memory, self.observer.written
        if self._in_bits(place):
            reference = self.reference(place)

            def write_bit(instance: int, value: Value) -> None:
                at = reference(instance)
                byte, mask = at & BYTE_OFFSET, 1 << (at >> BIT_SHIFT)
                memory[byte] = memory[byte] | mask if value else memory[byte] & ~mask
                told(byte, 1, mask)

            return write_bit
        put, where, size = putter(memory, place.type), self.address(place), place.type.size

        def write(instance: int, value: Value) -> None:
            at = where(instance)
            put(at, value)
            told(at, size)

        return write

    def set_bytes(self, place: Place, data: bytes) -> Callable[[int], None]:
        memory, where, told = self.memory, self.address(place), self.observer.written

        def set_bytes(instance: int) -> None:
            at = where(instance)
            memory[at : at + len(data)] = data
            told(at, len(data))

        return set_bytes
