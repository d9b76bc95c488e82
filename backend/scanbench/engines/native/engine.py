"""The native engine: a program compiled to machine code, which runs many scans in one call without Python's lock."""

import ctypes
from collections.abc import Sequence

from scanbench.check.program import Program
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.native import jit
from scanbench.engines.native.compiler import FAST, Compiler
from scanbench.engines.native.emit_scan import KNOCKED, TRAP


class _Control(ctypes.Structure):
    """What the loop shares with other threads; see `emit_scan.RUN`."""

    _fields_ = [("knock", ctypes.c_uint8), ("trap", ctypes.c_int64)]


class _Pace(ctypes.Structure):
    """`Pace`, as the loop reads and writes it."""

    _fields_ = [(name, ctypes.c_int64) for name in ("period", "deadline", "late", "worst", "busy", "scans")]


_RUN = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p)


class NativeEngine(Engine):
    """Runs a program as machine code of this computer."""

    name = "native"

    def __init__(
        self, program: Program, memory: bytearray, opt_level: int = FAST, objects: Sequence[bytes] | None = None
    ) -> None:
        """`opt_level` 0 builds fast, 2 runs fast. Object code of the program that is there already is only linked."""
        if len(memory) != program.layout.size:
            raise ValueError(f"the image has {len(memory)} bytes, but the program needs {program.layout.size}")
        self.timings = jit.Timings()
        if objects is None:
            build = Compiler().build(program, opt_level)
            objects, self.timings = build.objects, build.timings
        self._code = jit.link(objects, self.timings)
        self._run = _RUN(self._code.function("run"))
        self._image = (ctypes.c_uint8 * len(memory)).from_buffer(memory)
        self._address = ctypes.addressof(self._image)
        if self._address % 8:
            raise ValueError("the image must start at an address that is a multiple of 8")
        self._control = _Control()

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """See `Engine.run`. A pace with period 0 runs as fast as possible, and measures the whole run at once."""
        measured = None if pace is None else _Pace(
            pace.period_ns, pace.deadline_ns, pace.late_ns, pace.worst_ns, pace.busy_ns, pace.scans
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
            pace.busy_ns, pace.scans = measured.busy, measured.scans
        if reason == TRAP:
            return Stop(Reason.TRAP, self._control.trap)
        return Stop(Reason.KNOCKED if reason == KNOCKED else Reason.DONE)

    def knock(self) -> None:
        """See `Engine.knock`."""
        self._control.knock = 1
