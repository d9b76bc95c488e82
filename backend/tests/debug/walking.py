"""PLCs to walk around in, for the tests of the debugger: what is seen at each position of a straight run."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from scanbench.debug.breakpoint import Breakpoint, Verdict
from scanbench.debug.debugger import Debugger
from scanbench.debug.halt import Halt
from scanbench.engines.debug import DebugEngine
from scanbench.engines.native.probed import ProbedBuilds
from scanbench.engines.probe import Probe, ProbedEngine
from scanbench.faults.inject import Generate
from scanbench.problems import Span
from scanbench.program.program import Program
from scanbench.runtime.command import Command, Entry, Refusal
from tests.recording.recorded import begun

MakeDebug = Callable[[Program, bytearray], DebugEngine]

STATIONS = """FUNCTION Twice : DINT
VAR_INPUT x : DINT; END_VAR
VAR half : DINT; END_VAR
  half := x;
  Twice := half + half;
END_FUNCTION
FUNCTION_BLOCK Station
VAR_INPUT up : DINT; END_VAR
VAR_IN_OUT sum : DINT; END_VAR
VAR_OUTPUT total : DINT; END_VAR
VAR last : DINT; small : INT(0..100); END_VAR
VAR_TEMP t : DINT; END_VAR
  last := total;
  t := Twice(up);
  IF t > 6 THEN
    total := total + 1;
  ELSE
    total := total + t;
  END_IF;
  sum := sum + total;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n, i, sum, other : DINT; a, b : Station; list : ARRAY[0..4] OF DINT; motor AT CIO 100.00 : BOOL; END_VAR
  n := n + 1;
  a(up := n MOD 5, sum := sum);
  b(up := 2 * n, sum := other);
  FOR i := 0 TO 2 DO
    list[i] := list[i] + i * n;
  END_FOR;
  motor := n MOD 2 = 0;
END_PROGRAM
"""


@dataclass
class Heard:
    """What the debugger told."""

    logs: list[tuple[int, int, str]] = field(default_factory=list)
    """Breakpoint, scan, text."""

    def said(self, breakpoint: Breakpoint, text: str, scan: int, span: Span | None) -> None:
        self.logs.append((breakpoint.id, scan, text))

    def raised(self, entry: Entry) -> tuple[str, ...]:
        return tuple(each.id for each in entry.command.errors) if isinstance(entry.command, Generate) else ()


class Counted:
    """Makes probed engines, and counts them."""

    def __init__(self) -> None:
        self.made = 0
        self._builds = ProbedBuilds()

    def __call__(self, program: Program, memory: bytearray, probes: Sequence[Probe]) -> ProbedEngine:
        self.made += 1
        return self._builds.engine(program, memory, probes)


class Walker:
    """A PLC with its debugger."""

    def __init__(self, path: Path, source: str = STATIONS, make: MakeDebug | None = None) -> None:
        self.timeline = begun(path, source)
        self.make = make
        self.prober: Counted | None = None
        self.fit()
        self.heard = Heard()
        self.debugger = Debugger(self.timeline, self.heard)

    def fit(self) -> None:
        """Another engine than the reference one, for the program that runs."""
        loaded = self.timeline.live
        if self.make is not None:
            loaded.debug = self.make(loaded.statements, loaded.memory)

    def close(self) -> None:
        self.timeline.close()

    @property
    def halt(self) -> Halt:
        halt = self.debugger.halt
        assert halt is not None
        return halt

    @property
    def here(self) -> tuple[int, int]:
        return self.halt.scan, self.halt.count

    @property
    def line(self) -> int:
        assert self.halt.span is not None
        return self.halt.span.line

    def set(self, *breakpoints: Breakpoint) -> tuple[Verdict, ...]:
        return self.debugger.set("", None, None, breakpoints)

    def run(self, scans: int = 200) -> Halt | None:
        """Up to a halt, or so many scans further."""
        debugger = self.debugger
        end = self.timeline.live_scan + scans
        while debugger.moving:
            debugger.move()
        while debugger.halt is None and self.timeline.live_scan < end and self.timeline.resource.runnable:
            debugger.run(end - self.timeline.live_scan)
        return debugger.halt

    def step(self, action: str, **more: str | int) -> Halt | None:
        refusal = self.debugger.step(action, "Ann", **more)  # type: ignore[arg-type]
        assert refusal is None, refusal.message
        return self.run()

    def submit(self, command: Command) -> Entry:
        entry = self.debugger.submit(command)
        assert not isinstance(entry, Refusal), entry.message
        return entry

    @property
    def seen(self) -> tuple[object, ...]:
        """What is to be the same wherever a position is come to from."""
        resource = self.timeline.resource
        inside = resource.listening.inside
        frames = tuple((each.pou.name, each.instance, each.site) for each in inside.frames) if inside else ()
        count = inside.count if inside is not None else 0
        return resource.header.scan, count, frames, resource.state
