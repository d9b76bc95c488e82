"""Engines whose machine code can halt before any statement, and that code; see `engines.debug`.

The program is one module, compiled quickly, as observed code is; what its statements call is optimised.
"""

import ctypes
from dataclasses import dataclass

from scanbench.engines.cache import BlobCache
from scanbench.engines.debug import NOTHING, READ, WRITE, DebugEngine, Frame, Hook, Listen, frame_of
from scanbench.engines.engine import Pace, Reason, Stop
from scanbench.engines.native import emit_debug, jit
from scanbench.engines.native.compiler import FAST, QUICK
from scanbench.engines.native.emit_debug import Debugging
from scanbench.engines.native.emit_program import emit_program
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.observer import NativeObserver
from scanbench.engines.observe import Seen
from scanbench.garbage import without_collection
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.sites import Sites

_STATEMENT = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_int32, ctypes.c_uint64, ctypes.c_int32)
_ACCESS = ctypes.CFUNCTYPE(None, ctypes.c_int32, ctypes.c_uint64, ctypes.c_uint64, ctypes.c_uint64, ctypes.c_int32)
_TRAPPED = (1 << 32) + emit_debug.HALTED
"""What the loop says of the trap when the hook halted."""


@dataclass(frozen=True, slots=True)
class DebugCode:
    """What was compiled for one program."""

    objects: tuple[bytes, ...]
    sites: Sites


class DebugBuilds:
    """Compiles programs to be debugged, or takes from the cache what was compiled. Thread-safe."""

    def __init__(self, cache: BlobCache | None = None) -> None:
        self._cache = cache

    def objects(self, program: Program) -> DebugCode:
        """All that `debug_engine` needs to make engines for the program without any delay."""
        with without_collection():
            debugging = Debugging(program)
            text = emit_program(program, debugging)
        objects = self._object(text, QUICK), self._object(emit_debug.helpers(), FAST)
        return DebugCode(objects, debugging.sites)

    def engine(self, program: Program, memory: bytearray) -> DebugEngine:
        """An engine on this image."""
        return debug_engine(program, memory, self.objects(program))

    def _object(self, text: str, opt_level: int) -> bytes:
        key = jit.object_key(text, opt_level)
        code = self._cache.get(key) if self._cache is not None else None
        if code is None:
            code = jit.compile_object(text, opt_level, jit.Timings())
            if self._cache is not None:
                self._cache.put(key, code)
        return code


def debug_engine(program: Program, memory: bytearray, objects: DebugCode) -> "NativeDebugEngine":
    """An engine with what `DebugBuilds` made for the program: only linked."""
    return NativeDebugEngine(program, memory, objects)


class DebugObserver(NativeObserver):
    """Also tells which ways statements went."""

    def __init__(self, program: Program, sites: Sites) -> None:
        super().__init__(program, sites)
        self.ways = (ctypes.c_uint8 * max(len(self.sites.outcomes), 1))()

    def take(self) -> Seen:
        seen, gone = super().take(), bytes(self.ways)
        ctypes.memset(self.ways, 0, len(gone))
        outcomes = frozenset(number for number, mark in enumerate(gone) if mark)
        return Seen(seen.reached, seen.reads, seen.lost, outcomes)


class _Frame(ctypes.Structure):
    """See `emit_debug.FRAME_BYTES`."""

    _fields_ = [("pou", ctypes.c_uint32), ("site", ctypes.c_int32), ("instance", ctypes.c_uint64)]


class _State(ctypes.Structure):
    """See `emit_debug.STATE`."""

    _fields_ = [
        ("count", ctypes.c_uint64),
        ("wanted", ctypes.c_uint64),
        ("depth", ctypes.c_uint32),
        ("every", ctypes.c_uint8),
        ("silent", ctypes.c_uint8),
        ("armed", ctypes.c_uint8),
        ("size", ctypes.c_uint64),
        *((name, ctypes.c_void_p) for name in ("flags", "listen", "frames", "begin", "statement", "access", "ways")),
    ]


class NativeDebugEngine(NativeEngine, DebugEngine):
    """Runs debugged machine code."""

    def __init__(self, program: Program, memory: bytearray, code: DebugCode) -> None:
        self.observer = DebugObserver(program, code.sites)
        self.sites = code.sites
        super().__init__(program, memory, objects=code.objects, observer=self.observer)
        self._memory = memory
        self._hook: Hook | None = None
        self._error: BaseException | None = None
        self._bits = 0xFF
        self._listening = NOTHING
        self._mapped, self._told_everywhere = NOTHING.bytes, NOTHING.accesses
        self._flags = (ctypes.c_uint8 * max(len(self.sites.statements), 1))()
        self._map = (ctypes.c_uint8 * len(memory))()
        self._begin = (ctypes.c_uint8 * len(memory)).from_buffer_copy(memory)
        # the first frame is never in use; a POU that may be called while it runs has several
        nested = Layout.DEPTH_LIMIT * sum(pou.recursive for pou in program.pous)
        self._frames = (_Frame * (len(self.sites.bodies) + 2 + nested))()
        self._callbacks = _STATEMENT(self._on_statement), _ACCESS(self._on_access)
        self._state = _State.from_address(self._code.variable(emit_debug.STATE.removeprefix("@")))
        self._state.size = len(memory)
        for name, each in (
            ("flags", self._flags), ("listen", self._map), ("frames", self._frames), ("begin", self._begin),
            ("ways", self.observer.ways),
        ):  # fmt: skip
            setattr(self._state, name, ctypes.addressof(each))
        for name, callback in zip(("statement", "access"), self._callbacks, strict=True):
            setattr(self._state, name, ctypes.cast(callback, ctypes.c_void_p).value)

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """See `DebugEngine`."""
        stop = super().run(scans, pace)
        error, self._error = self._error, None
        if error is not None:
            self.listen(self._listening)
            raise error
        return Stop(Reason.HALTED) if stop.reason is Reason.TRAP and stop.trap == _TRAPPED else stop

    def hook(self, hook: Hook | None) -> None:
        self._hook = hook

    def listen(self, listen: Listen) -> None:
        for site in self._listening.sites - listen.sites:
            self._flags[site] = 0
        for site in listen.sites - self._listening.sites:
            self._flags[site] = 1
        self._map_bytes(listen)
        self._state.every, self._state.wanted = listen.every, listen.count
        self._state.armed = bool(listen.bytes) or listen.accesses != 0
        self._listening = listen

    def _map_bytes(self, listen: Listen) -> None:
        """Which accesses are told. The map stays as it is while none are: who listens to all of them now and then does not
        pay for the size of the image."""
        if not listen.bytes and not listen.accesses:
            return
        if listen.bytes == self._mapped and listen.accesses == self._told_everywhere:
            return
        ctypes.memset(self._map, listen.accesses, len(self._map))
        for offset, how in listen.bytes.items():
            self._map[offset] = (how | listen.accesses) & (READ | WRITE)
        self._mapped, self._told_everywhere = listen.bytes, listen.accesses

    @property
    def bits(self) -> int:
        return self._bits

    @property
    def begin(self) -> bytes:
        return bytes(self._begin)

    @property
    def count(self) -> int:
        return int(self._state.count)

    def frames(self) -> tuple[Frame, ...]:
        running = [self._frames[number] for number in range(self._state.depth, 0, -1)]
        pous = [self._program.pous[each.pou] for each in running]
        return tuple(
            # a body that begins has come to no statement yet: its first one is next
            frame_of(pou, each.instance, each.site if each.site >= 0 else self.sites.bodies[pou][0], self._memory)
            for pou, each in zip(pous, running, strict=True)
        )

    # ---- called by the code -----------------------------------------------------------------------------------

    def _on_statement(self, site: int, count: int, depth: int) -> int:
        if self._hook is None or self._error is not None:
            return int(self._error is not None)
        try:
            return int(self._hook.statement(site, count, depth))
        except BaseException as error:
            self._fail(error)
            return 1

    def _on_access(self, site: int, count: int, offset: int, size: int, how: int) -> None:
        if self._hook is None or self._error is not None:
            return
        self._bits = how >> 8
        try:
            self._hook.access(site, count, offset, size, how & 0xFF == WRITE)
        except BaseException as error:
            self._fail(error)

    def _fail(self, error: BaseException) -> None:
        """Leaves the scan before the next statement, or after it; `run` raises the error."""
        self._error = error
        self._state.every = 1
        self.interrupt()
