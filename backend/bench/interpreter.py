"""Speed of the reference engine: simple statements a second, in thread CPU time."""

from statistics import median
from time import thread_time_ns

from scanbench.check.build import check_sources
from scanbench.engines.engine import Reason
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.plcmodel.load import model_named

ROUNDS = 500
STATEMENTS = (
    "a := a + b;",
    "b := a - 3;",
    "n := n * 5 + i;",
    "x := b > a;",
    "y := x AND NOT z OR y;",
    "z := n >= 0;",
    "r := r + 0.25;",
    "w := w XOR 16#55AA;",
    "list[i MOD 8] := a;",
    "IF x THEN c := c + 1; ELSE d := d + 1; END_IF;",
)
"""Each counts as one, though IF runs an assignment as well; and so does a round of the FOR around them."""
SOURCE = f"""\
PROGRAM Main
VAR a, b : INT := 1; n, c, d : DINT; i : INT; x, y, z : BOOL; r : REAL; w : WORD; list : ARRAY[0..7] OF INT; END_VAR
FOR i := 1 TO {ROUNDS} DO
{chr(10).join(STATEMENTS)}
END_FOR;
END_PROGRAM
"""
SAMPLES = 5
SCANS = 10


def statements_per_second() -> float:
    """The median of five samples."""
    checked = check_sources({"bench.st": SOURCE}, model_named("GENERIC-IEC"))
    assert checked.program is not None, "\n".join(map(str, checked.problems))
    engine = ReferenceEngine(checked.program, bytearray(checked.program.initial_image))
    samples = []
    for _ in range(SAMPLES):
        start = thread_time_ns()
        stop = engine.run(SCANS)
        spent = thread_time_ns() - start
        assert stop.reason is Reason.DONE
        samples.append(SCANS * ROUNDS * (len(STATEMENTS) + 1) / spent * 1e9)
    return median(samples)
