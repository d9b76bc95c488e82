"""What the checker takes for programs that are long in one way: unknown names, chains, many branches, deep nesting.

`python -m bench.checking [--json]`. Seconds for each, seconds of the processor in *did you mean* alone, and the problems that were found.
"""

import argparse
import json
import sys
from collections.abc import Iterable
from time import perf_counter, process_time

from scanbench.check import context
from scanbench.check.build import check_sources
from scanbench.plcmodel.load import load_all, model_directory, model_named

KNOWN, UNKNOWN, CHAIN, BRANCHES, LEVELS = 2000, 5000, 1000, 10_000, 3000


def programs() -> dict[str, str]:
    """The texts, by what is long in them."""
    known = "".join(f"  motor_speed_value_{n:04} : INT;\n" for n in range(KNOWN))
    wrong = "".join(f"motor_sped_value_{n:04}x := 1;\n" for n in range(UNKNOWN))
    right = "".join(f"motor_speed_value_{n % KNOWN:04} := 1;\n" for n in range(UNKNOWN))
    bare = "".join(f"FUNCTION_BLOCK B{n} EXTENDS B{n - 1}\nEND_FUNCTION_BLOCK\n" for n in range(1, CHAIN))
    full = "".join(
        f"FUNCTION_BLOCK B{n} EXTENDS B{n - 1}\nVAR v{n} : INT; END_VAR\nMETHOD PUBLIC m{n} : INT\nm{n} := v{n};\nEND_METHOD\n"
        f"v{n} := 1;\nEND_FUNCTION_BLOCK\n"
        for n in range(1, CHAIN)
    )
    base, use = "FUNCTION_BLOCK B0\nEND_FUNCTION_BLOCK\n", _main(f"b : B{CHAIN - 1};", "b();\n")
    elsif = "".join(f"ELSIF x = {n} THEN y := {n};\n" for n in range(1, BRANCHES))
    labels = "".join(f"{n}: y := {n};\n" for n in range(BRANCHES))
    return {
        f"{UNKNOWN} names that are known": _main(known, right),
        f"{UNKNOWN} unknown names beside {KNOWN}": _main(known, wrong),
        f"EXTENDS {CHAIN} deep": base + bare + use,
        f"EXTENDS {CHAIN} deep, with variables and methods": base + full + use,
        f"{BRANCHES} ELSIF": _main("x, y : INT;", f"IF x = 0 THEN y := 0;\n{elsif}END_IF;\n"),
        f"{BRANCHES} CASE labels": _main("x, y : INT;", f"CASE x OF\n{labels}END_CASE;\n"),
        f"IF {LEVELS} deep": _main("x : INT;", "IF x = 1 THEN\n" * LEVELS + "END_IF;\n" * LEVELS),
    }


def _main(variables: str, statements: str) -> str:
    return f"PROGRAM Main\nVAR\n{variables}\nEND_VAR\n{statements}END_PROGRAM\n"


class Near:
    """*Did you mean*, and the seconds of the processor that it took."""

    def __init__(self) -> None:
        self._made = context.did_you_mean
        self.took = 0.0
        context.did_you_mean = self

    def __call__(self, name: str, known: Iterable[str]) -> str:
        begin = process_time()
        try:
            return self._made(name, known)
        finally:
            self.took += process_time() - begin


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(prog="python -m bench.checking", description=__doc__)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    given = parser.parse_args()
    model = model_named("GENERIC-IEC", load_all(model_directory())[0])
    figures: dict[str, tuple[float, float, int]] = {}
    near = Near()
    for name, text in programs().items():
        begin, near.took = perf_counter(), 0.0
        found = len(check_sources({"main.st": text}, model).problems)
        figures[name] = perf_counter() - begin, near.took, found
    if given.json:
        keys = ("seconds", "did_you_mean", "problems")
        sys.stdout.write(json.dumps({name: dict(zip(keys, each, strict=True)) for name, each in figures.items()}))
    for name, (took, hints, found) in () if given.json else figures.items():
        sys.stdout.write(f"{name:50}{took:8.2f} s, did you mean {1000 * hints:5.0f} ms{found:7} problems\n")


if __name__ == "__main__":
    main()
