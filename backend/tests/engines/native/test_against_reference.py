"""Random programs: the two engines must leave the same bytes after every scan, traps included."""

from random import Random

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.layout import Layout
from tests.amounts import amount
from tests.caseformat import first_difference
from tests.engines.native.plc import MODEL
from tests.engines.native.program_text import program_text

SCANS = 4
BUDGET = 300


def agree(seed: int, opt_level: int) -> None:
    """Runs a random program on both engines. A seed, as programs made of hypothesis' own choices come out too plain to go wrong."""
    source = program_text(Random(seed))
    program = check_sources({"random.st": source}, MODEL, 1_000_000).program
    assume(program is not None)
    assert program is not None
    image = bytearray(program.initial_image)
    image[Layout.BUDGET_LIMIT : Layout.BUDGET_LIMIT + 8] = BUDGET.to_bytes(8, "little")
    memories = bytearray(image), bytearray(image)
    engines = ReferenceEngine(program, memories[0]), NativeEngine(program, memories[1], opt_level)
    for scan in range(SCANS):
        stops = [engine.run(1) for engine in engines]
        assert stops[0] == stops[1], f"scan {scan} of\n{source}"
        assert first_difference(program, *memories) == "", f"scan {scan} of\n{source}"


@settings(max_examples=amount(160, 12))
@given(st.integers(0, (1 << 32) - 1), st.sampled_from([0, 2, 2, 2]))
def test_the_engines_agree(seed: int, opt_level: int) -> None:
    agree(seed, opt_level)
