"""Runs a random program on both engines: whole images after every scan, and the same traps."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

from scanbench.check.build import check_sources
from scanbench.engines.engine import Reason
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.problems import Severity
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from tests.caseformat import MODELS, first_difference

SCANS = 3
BUDGET = 2000
KNOWN_TO_FAIL = {"S004", "T012"}
"""Constants that the checker rightly refuses: a division by zero, an index out of bounds."""


OPTIMISED_EACH = 8
"""Building at O2 takes several times as long as at O0, so only every eighth program is run there as well."""


def levels(seed: int) -> tuple[int, ...]:
    """The optimisation levels that the program of a seed is compared at."""
    return (0,) if seed % OPTIMISED_EACH else (0, 2)


class Refused(AssertionError):
    """The checker does not take a program that should be well-formed."""


def checked(source: str, in_out: Literal["reference", "value"] = "reference") -> Program | None:
    """The program; None where the checker saw a constant that it must refuse."""
    found = check_sources({"random.st": source}, replace(MODELS["GENERIC-IEC"], in_out=in_out))
    errors = {problem.code for problem in found.problems if problem.severity is Severity.ERROR}
    if errors and errors <= KNOWN_TO_FAIL:
        return None
    if found.program is None:
        raise Refused("\n".join(str(each) for each in found.problems if each.severity is Severity.ERROR))
    return found.program


def limited(program: Program) -> bytearray:
    """A fresh image, in which loops do not go on for long."""
    image = bytearray(program.initial_image)
    image[Layout.BUDGET_LIMIT : Layout.BUDGET_LIMIT + 8] = BUDGET.to_bytes(8, "little")
    return image


def difference(program: Program, opt_level: int, objects: Sequence[bytes] | None = None) -> str:
    """What the engines disagree about, or ''. The machine code may be there already."""
    images = [limited(program) for _ in range(2)]
    engines = [ReferenceEngine(program, images[0]), NativeEngine(program, images[1], opt_level, objects)]
    for scan in range(SCANS):
        stops = [engine.run(1) for engine in engines]
        if stops[0] != stops[1]:
            return f"scan {scan}: reference {stops[0]}, native {stops[1]}"
        if where := first_difference(program, *images):
            return f"scan {scan}: reference and native differ at {where}"
        if stops[0].reason is Reason.TRAP:
            break
    return ""


def compare(source: str, opt_level: int, in_out: Literal["reference", "value"] = "reference") -> bool:
    """Whether the program could be compared; a difference is an AssertionError."""
    program = checked(source, in_out)
    if program is None:
        return False
    found = difference(program, opt_level)
    assert not found, found
    return True
