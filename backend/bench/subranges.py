"""What the embedded checks of subranges cost: loops with an index, with checks and without.

`python -m bench subranges`. Each program runs with the types as they are written, and once more where every subrange is its base
type, so that nothing is checked. In the first programs a loop is one statement, of which LLVM makes vectors: without checks a round takes a fraction of a
nanosecond, so any branch in it would show as ten times. "conveyor" is what people write: cases, conditions, values that are read and
written in the same round; in "calls" who calls is noted, too, for the path of a violation. Processor time of a scan in optimised code, the shortest of several; the aim is less than 1.3 times.
"""

import re
import sys
from dataclasses import dataclass
from time import thread_time_ns

from scanbench.check.build import check_sources
from scanbench.engines.engine import Reason
from scanbench.engines.native.compiler import FAST, Compiler
from scanbench.engines.native.engine import NativeEngine
from scanbench.plcmodel.load import model_named

ROUNDS, SCANS = 15, 300
_SUBRANGE = re.compile(r"(INT|DINT) ?\(-?\d+\.\.-?\d+\)")
PROGRAMS = {
    "sum": """PROGRAM Main
VAR i : INT (0..999); sum : DINT; a : ARRAY[0..999] OF INT; END_VAR
sum := 0;
FOR i := 0 TO 989 DO sum := sum + a[i]; END_FOR;
END_PROGRAM""",
    "copy and scale": """PROGRAM Main
VAR i : INT (0..999); k : INT (1..9) := 3; a, b : ARRAY[0..999] OF INT; END_VAR
FOR i := 0 TO 989 DO b[i] := a[i] * k + 1; END_FOR;
END_PROGRAM""",
    "ring": """PROGRAM Main
VAR n : INT; head : INT (0..99); a : ARRAY[0..99] OF DINT; END_VAR
FOR n := 0 TO 989 DO a[head] := a[head] + n; head := (head + 1) MOD 100; END_FOR;
END_PROGRAM""",
    "bounded values": """PROGRAM Main
VAR i : INT (0..999); a : ARRAY[0..999] OF INT (0..100); b : ARRAY[0..999] OF INT (0..1000); END_VAR
FOR i := 0 TO 989 DO b[i] := a[i] * 5 + a[i + 1]; END_FOR;
END_PROGRAM""",
    "calls": """FUNCTION Scaled : INT
VAR_INPUT x : INT; END_VAR
VAR r : INT (0..1000); END_VAR
r := x / 2;
Scaled := r;
END_FUNCTION
FUNCTION_BLOCK Filter
VAR_INPUT x : INT; END_VAR
VAR_OUTPUT y : INT (0..1000); END_VAR
y := y - y / 4 + Scaled(x);
END_FUNCTION_BLOCK
PROGRAM Main
VAR n, last : INT; a : ARRAY[0..989] OF INT; f : ARRAY[0..989] OF Filter; END_VAR
FOR n := 0 TO 989 DO f[n](x := a[n] + last MOD 10); last := f[n].y; END_FOR;
END_PROGRAM""",
    "conveyor": """PROGRAM Main
VAR
    i, free : INT (0..99); level : ARRAY[0..99] OF INT (0..1000); state : ARRAY[0..99] OF INT (0..3);
    full, moved : DINT; raw : ARRAY[0..99] OF INT; n : INT;
END_VAR
full := 0;
FOR n := 1 TO 10 DO
    FOR i := 0 TO 98 DO
        CASE state[i] OF
        0: IF level[i] > 900 THEN state[i] := 1; END_IF;
        1: level[i] := level[i] - level[i] / 4; moved := moved + 1; state[i] := 2;
        2: IF level[i] < 300 THEN state[i] := 3; END_IF; level[i] := level[i] - 1;
        3: state[i] := 0; free := i;
        END_CASE;
        level[i] := MIN(level[i] + raw[i] MOD 7 + 3, 1000);
        IF level[i] > 800 THEN full := full + 1; END_IF;
    END_FOR;
END_FOR;
END_PROGRAM""",
}


@dataclass(frozen=True, slots=True)
class Cost:
    """Microseconds of a scan, and how many checks the program has."""

    checked: float
    plain: float
    checks: int


def measure(text: str) -> Cost:
    """One program, with its checks and without."""
    engines = [_engine(each) for each in (text, _SUBRANGE.sub(r"\1", text))]
    best = [min(_scan(engine) for _ in range(ROUNDS)) for engine, _ in engines]
    return Cost(best[0], best[1], engines[0][1])


def _engine(text: str) -> tuple[NativeEngine, int]:
    program = check_sources({"main.st": text}, model_named("GENERIC-IEC")).program
    assert program is not None
    objects = Compiler().build(program, FAST).objects
    engine = NativeEngine(program, bytearray(program.initial_image), objects=objects)
    assert engine.run(SCANS).reason is Reason.DONE
    return engine, sum(not each.needless for each in program.checks)


def _scan(engine: NativeEngine) -> float:
    begun = thread_time_ns()
    engine.run(SCANS)
    return (thread_time_ns() - begun) / SCANS / 1000


def main() -> None:
    """Prints the figures."""
    sys.stdout.write(f"{'loops of 990 rounds':<22}{'checks':>8}{'with, us':>12}{'without, us':>14}{'times':>8}\n")
    for name, text in PROGRAMS.items():
        cost = measure(text)
        sys.stdout.write(
            f"{name:<22}{cost.checks:>8}{cost.checked:>12.2f}{cost.plain:>14.2f}{cost.checked / cost.plain:>8.2f}\n"
        )


if __name__ == "__main__":
    main()
