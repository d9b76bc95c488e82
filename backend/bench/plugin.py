"""`python -m bench plugin`: what the tests of the samples take with the plugin for pytest, as somebody runs them who wrote the samples.

CPU time is that of the whole command: Python, pytest, what it imports, compiling three projects, and the tests. Wall time is that of this machine as busy as it is.
"""

import argparse
import json
import re
import resource
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

HERE = Path(__file__).parents[1]
SUITE = "tests/testing/test_samples.py"
_PASSED = re.compile(r"(\d+) passed")


@dataclass(frozen=True, slots=True)
class Measured:
    """Of one run of the suite."""

    tests: int
    cpu_s: float
    wall_s: float


def measure_suite() -> Measured:
    """Runs it in a process of its own; `RuntimeError` where a test fails."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", SUITE]
    done = subprocess.run(command, cwd=HERE, capture_output=True, text=True, check=False)
    wall = time.monotonic() - begun
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    passed = _PASSED.search(done.stdout)
    if done.returncode or passed is None:
        raise RuntimeError(f"the suite did not pass:\n{done.stdout}{done.stderr}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Measured(int(passed.group(1)), cpu, wall)


def main() -> None:
    """Prints the best of a few runs."""
    parser = argparse.ArgumentParser(prog="python -m bench plugin", description=__doc__)
    parser.add_argument("--runs", type=int, default=3, help="the quickest of so many counts (3)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    given = parser.parse_args()
    best = min((measure_suite() for _ in range(max(1, given.runs))), key=lambda each: each.cpu_s)
    if given.json:
        sys.stdout.write(json.dumps(asdict(best)) + "\n")
        return
    sys.stdout.write(f"{best.tests} tests: {best.cpu_s:.1f} s of CPU, {best.wall_s:.1f} s on the clock\n")


if __name__ == "__main__":
    main()
