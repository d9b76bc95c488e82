"""One large POU: from its text to the first scan, and to optimised code, for growing numbers of lines.

`python -m bench pou [LINES...]`. Seconds of the processor in this process, and milliseconds for 1,000 lines: these stay the
same where the time grows with the lines and no faster. Memory is the peak of the process so far.
"""

import resource
import sys
from dataclasses import dataclass
from time import process_time

from scanbench.check.build import check_sources
from scanbench.engines.native.compiler import FAST, QUICK, Compiler
from scanbench.engines.native.engine import NativeEngine
from scanbench.plcmodel.load import model_named

LINES = (1_000, 5_000, 20_000)
VARIABLES = 50


@dataclass(frozen=True, slots=True)
class Taken:
    """Seconds, and MB."""

    lines: int
    check: float
    first_scan: float
    """Quick code, linked, and one scan."""
    optimise: float
    memory: float


def text(lines: int) -> str:
    """A PROGRAM of so many lines in its body."""
    declared = " ".join(f"a{n}, b{n} : DINT;" for n in range(VARIABLES))
    made = [f"PROGRAM Main\nVAR {declared} END_VAR"]
    for n in range(lines // 5):
        a, b, c = n % VARIABLES, n * 7 % VARIABLES, n * 3 % VARIABLES
        made.append(f"IF a{a} > {n} THEN\n  b{a} := b{c} + a{b} * 3;\nELSE\n  a{a} := a{b} + 1;\nEND_IF;")
    return "\n".join([*made, "END_PROGRAM\n"])


def measure(lines: int) -> Taken:
    """What one size takes."""
    begun = process_time()
    program = check_sources({"large.st": text(lines)}, model_named("GENERIC-IEC")).program
    assert program is not None
    checked = process_time()
    objects = Compiler().build(program, QUICK).objects
    NativeEngine(program, bytearray(program.initial_image), objects=objects).run(1)
    ran = process_time()
    Compiler().build(program, FAST)
    optimised = process_time()
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return Taken(lines, checked - begun, ran - checked, optimised - ran, memory)


def say(line: str) -> None:
    """Prints at once: the next size takes longer."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def main() -> None:
    """Prints the figures."""
    say(f"{'lines':>8}{'check':>9}{'+ first scan':>14}{'optimised':>11}{'ms per 1,000 lines':>30}{'peak MB':>9}")
    for each in map(measure, [int(given) for given in sys.argv[1:]] or LINES):
        parts = (each.check, each.first_scan, each.optimise)
        shares = " / ".join(f"{part * 1e6 / each.lines:.0f}" for part in parts)
        say(
            f"{each.lines:>8,}{each.check:>8.2f}s{each.first_scan:>13.2f}s{each.optimise:>10.2f}s{shares:>30}{each.memory:>9.0f}"
        )


if __name__ == "__main__":
    main()
