"""The native engine: a program compiled to machine code, which runs many scans in one call without Python's lock."""

import ctypes
from collections.abc import Callable, Sequence
from time import monotonic_ns

from scanbench.check.typed.condition import Condition
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.native import inlining, jit
from scanbench.engines.native.compiler import FAST, QUICK, Compiler
from scanbench.engines.native.condition_code import link_condition
from scanbench.engines.native.emit_loop import (
    ASKED,
    CONDITION,
    DONE,
    FUTEX,
    FUTEX_WAKE_PRIVATE,
    INTERRUPTED,
    RUN_NAME,
    TRAP,
)
from scanbench.engines.native.observer import NativeObserver
from scanbench.engines.native.sample_code import link_samplings
from scanbench.engines.sample import Sampling
from scanbench.program.program import Program

_SLICE_NS = 20_000_000
"""Without a pace, Python gets a look about this often: else a signal (Ctrl-C) would wait for the last scan."""
_FIRST_SLICE = 64
"""Scans, before it is known how long one takes."""


_SOON = 10_000
"""Scans up to which optimising a large program takes longer than it gains."""


def engine_for(scans: int) -> Callable[[Program, bytearray], "NativeEngine"]:
    """Makes the engine for a run of so many scans: a large program begins soon where they are few."""

    def make(program: Program, memory: bytearray) -> NativeEngine:
        soon = scans <= _SOON and any(map(inlining.divided, program.pous))
        return NativeEngine(program, memory, QUICK if soon else FAST)

    return make


class _Control(ctypes.Structure):
    """What the loop shares with other threads; see `emit_loop.RUN`."""

    _fields_ = [
        ("interrupt", ctypes.c_uint32), ("trap", ctypes.c_int64), ("condition", ctypes.c_void_p),
        ("sample", ctypes.c_void_p), ("table", ctypes.c_void_p), ("scan", ctypes.c_void_p),
    ]  # fmt: skip


class _Pace(ctypes.Structure):
    """`Pace`, as the loop reads and writes it."""

    _fields_ = [
        (name, ctypes.c_int64) for name in ("period", "deadline", "late", "worst", "busy", "scans", "late_scans")
    ]


_REASONS = {
    DONE: Reason.DONE, INTERRUPTED: Reason.INTERRUPTED, TRAP: Reason.TRAP, ASKED: Reason.ASKED, CONDITION: Reason.CONDITION
}  # fmt: skip
_LIBC = ctypes.PyDLL(None)
"""Keeps the GIL: waking somebody takes less than giving it away and getting it back."""

_HOLDS = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p)
_RUN = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p)


class NativeEngine(Engine):
    """Runs a program as machine code of this computer."""

    name = "native"

    def __init__(
        self,
        program: Program,
        memory: bytearray,
        opt_level: int = FAST,
        objects: Sequence[bytes] | None = None,
        observer: NativeObserver | None = None,
    ) -> None:
        """`opt_level` 0 builds fast, 2 runs fast. Object code of the program that is there already is only linked.

        With an observer, that is code to be observed, which `observed` compiles.
        """
        if len(memory) != program.layout.size:
            raise ValueError(f"the image has {len(memory)} bytes, but the program needs {program.layout.size}")
        self.timings = jit.Timings()
        if objects is None:
            build = Compiler().build(program, opt_level)
            objects, self.timings = build.objects, build.timings
        self._code = jit.link(objects, self.timings)
        self._observer = observer  # the code writes to its memory
        if observer is not None:
            observer.attach(self._code)
        self._run = _RUN(jit.loop().function(RUN_NAME))
        self._image = (ctypes.c_uint8 * len(memory)).from_buffer(memory)
        self._address = ctypes.addressof(self._image)
        if self._address % 8:
            raise ValueError("the image must start at an address that is a multiple of 8")
        self._control = _Control(scan=self._code.function("scan"))
        self._condition: jit.Code | None = None
        self._samplings: tuple[Sampling, ...] = ()
        self._sampler: tuple[jit.Code, ctypes.Array[ctypes.c_uint64]] | None = None
        self._program = program
        self._slice = _FIRST_SLICE

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """See `Engine.run`. A pace with period 0 runs as fast as possible, and measures the whole run at once."""
        if any(each.full for each in self._samplings):
            return Stop(Reason.INTERRUPTED)
        if pace is not None:
            return self._call(scans, pace)
        while scans > self._slice:
            size, begun = self._slice, monotonic_ns()
            stop = self._call(size, None)
            if stop.reason is not Reason.DONE:
                return stop
            scans -= size
            took = monotonic_ns() - begun
            self._slice = size * 2 if took < _SLICE_NS else max(1, size // 2) if took > 4 * _SLICE_NS else size
        return self._call(scans, None)

    def _call(self, scans: int, pace: Pace | None) -> Stop:
        measured = None if pace is None else _Pace(
            pace.period_ns, pace.deadline_ns, pace.late_ns, pace.worst_ns, pace.busy_ns, pace.scans,
            pace.late_scans,
        )  # fmt: skip
        self._control.trap = 0
        reason = self._run(
            self._address,
            ctypes.addressof(self._control),
            scans,
            None if measured is None else ctypes.addressof(measured),
        )
        if pace is not None and measured is not None:
            pace.deadline_ns, pace.late_ns, pace.worst_ns = measured.deadline, measured.late, measured.worst
            pace.busy_ns, pace.scans, pace.late_scans = measured.busy, measured.scans, measured.late_scans
        return Stop(_REASONS[reason], self._control.trap)

    def stop_when(self, condition: Condition | None, *others: Condition) -> None:
        """See `Engine.stop_when`. Compiling takes some 10 ms, the same condition again next to nothing."""
        conditions = others if condition is None else (condition, *others)
        code = link_condition(self._program, *conditions) if conditions else None
        self._control.condition = None if code is None else code.function("condition")
        self._condition = code

    def holds(self, condition: Condition) -> bool:
        """See `Engine.holds`."""
        code = link_condition(self._program, condition)
        return bool(_HOLDS(code.function("condition"))(self._address))

    def sample(self, *samplings: Sampling) -> None:
        """See `Engine.sample`. Compiling takes some milliseconds for each signal, the same again next to nothing."""
        sampler = None
        if samplings:
            addresses = (ctypes.c_uint64 * len(samplings))(*(each.address for each in samplings))
            sampler = link_samplings(self._program, samplings), addresses
        self._control.sample = None if sampler is None else sampler[0].function("sample")
        self._control.table = None if sampler is None else ctypes.addressof(sampler[1])
        self._sampler, self._samplings = sampler, samplings

    def interrupt(self) -> None:
        """See `Engine.interrupt`."""
        self._control.interrupt = 1
        if FUTEX is not None:
            _LIBC.syscall(FUTEX, ctypes.byref(self._control), FUTEX_WAKE_PRIVATE, 1)
