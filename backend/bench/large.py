"""Programs of 10,000 lines, made of 122 function blocks like `st/unit.st`, which differ in their numbers: the same text each time.

`big10k` has timers, counters and arrays; `big10kflat` only numbers, so that other compilers take it, too.
"""

from collections.abc import Iterator
from pathlib import Path
from string import Template

UNITS = {"big10k": "unit", "big10kflat": "unitflat"}
"""The block of which each program is made."""
BLOCKS = 122
LINES = 10_000
_PROGRAM = "PROGRAM bench\nVAR\n  cyc : DINT := 0;\n  chk : DINT := 0;\n  x : REAL := 0.0;"


def large(name: str) -> str:
    """The text of one of `UNITS`."""
    unit = Template(Path(__file__).with_name("st").joinpath(f"{UNITS[name]}.st").read_text("utf-8"))
    blocks = "\n".join(unit.substitute(_numbers(n)) for n in range(BLOCKS))
    lines = [
        *blocks.splitlines(),
        "",
        *_PROGRAM.splitlines(),
        *(f"  u{n} : Unit{n};" for n in range(BLOCKS)),
        "END_VAR",
    ]
    lines += _calls()
    return "\n".join([*lines, *_filling(LINES - len(lines) - 1), "END_PROGRAM", ""])


def _numbers(n: int) -> dict[str, int]:
    """What is put into the text of block `n`."""
    return {
        "n": n, "offset": n % 101, "delay": 50 + n, "count": n % 9 + 3, "ki": n % 8 + 1, "kp": n % 5 + 1, "factor": n % 17 + 1,
        "high": 80 + n % 20, "low": 80 + n % 15,
    }  # fmt: skip


def _calls() -> Iterator[str]:
    yield "  cyc := cyc + 1;"
    yield "  x := DINT_TO_REAL(cyc MOD 100);"
    for n in range(BLOCKS):
        enable, reset = f"(cyc MOD {n % 7 + 3}) <> 0", f"(cyc MOD {50 + n}) = 0"
        yield f"  u{n}(enable := {enable}, reset := {reset}, pv := x, sp := {n % 50}.0);"
        yield f"  chk := (chk * 31 + u{n}.total) MOD 1000003;"


def _filling(count: int) -> Iterator[str]:
    """Statements up to the wanted length."""
    for n in range(count):
        yield f"  chk := (chk + {n % 997}) MOD 1000003;" if n % 2 else f"  x := x * 0.5 + {n % 89}.25;"
