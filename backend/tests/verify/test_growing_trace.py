"""The trace of a controller that runs: samples that come one after the other, and what is compared of them."""

from collections.abc import Sequence

import pytest

from scanbench.jobs.verification import VerifyJob
from scanbench.verify.contract import Range, ScanVerified
from scanbench.verify.ranges import parse_range
from scanbench.verify.trace.growing import LONGEST, TIME, GrowingTrace, Sample, controller_table
from scanbench.verify.trace.mapping import ColumnMap, TraceMapping
from scanbench.verify.trace.subject import TraceSubject
from scanbench.verify.trace.table import BadTraceFile, Unit
from scanbench.verify.verifier import Verifier
from scanbench.wire.host import Sources
from scanbench.wire.verification import BeginController, ScansDone, TakeSamples, VerifyBegun
from tests.verify.trace_parts import program_of

SOURCE = """\
PROGRAM Main
VAR a : INT; b : INT; x : LREAL; r : REAL; END_VAR
b := a * 2;
x := 1.0;
r := 1.0;
END_PROGRAM
"""
"""Its interval is 10 ms."""


class Controller:
    """Samples of `a`, and of one output."""

    def __init__(self, output: str, first: Sequence[str], unit: Unit = "ms") -> None:
        columns = (ColumnMap("a", "Main.a", "input"), ColumnMap(output, f"Main.{output}", "output"))
        program = program_of(SOURCE)
        mapping = TraceMapping(TIME, unit, "hold", columns)
        self.growing = GrowingTrace(controller_table("opc.tcp://press", (TIME, "a", output), first), mapping, program)
        self.verifier = Verifier(TraceSubject(program, self.growing.trace))
        self.verifier.begin(parse_range(""))
        self._next = self.verifier.first

    def take(self, *samples: Sample) -> list[ScanVerified]:
        """All scans that they tell of."""
        self.growing.add(samples)
        first, self._next = self._next, self.growing.until(last=True)
        self.verifier.follow(self._next)
        return [self.verifier.verify(scan) for scan in range(first, self._next)]


def differing(verified: Sequence[ScanVerified]) -> list[int]:
    return [each.scan for each in verified if any(row.differs for row in each.rows)]


def test_samples_far_apart_are_compared() -> None:
    controller = Controller("b", ("0", "1", "2"))
    verified = controller.take(*(Sample((str(at * 15_000), "1", "3")) for at in range(1, 4)))
    assert differing(verified) == [1501, 3001, 4501]


def test_a_controller_that_always_goes_on_by_more_than_can_be_run_is_refused() -> None:
    far = LONGEST + 1
    controller = Controller("b", ("0", "1", "2"), "scan")
    once = controller.take(Sample((str(far), "1", "2")), Sample((str(far + 5), "1", "2")))
    assert differing(once) == []
    with pytest.raises(BadTraceFile, match=r"goes on by 10,001 scans from one sample to the next.*shorter interval"):
        controller.take(*(Sample((str(far + 5 + at * far), "1", "2")) for at in (1, 2)))


@pytest.mark.parametrize(
    ("output", "value", "scans"),
    [("x", "1.0000000001", [2]), ("x", "1.0", []), ("r", "1.00000001", []), ("r", "1.001", [2])],
)
def test_an_lreal_is_compared_exactly_and_a_real_by_the_digits_that_it_has(
    output: str, value: str, scans: list[int]
) -> None:
    controller = Controller(output, ("0", "1", "1.0"))
    assert differing(controller.take(Sample(("10", "1", value)))) == scans


def test_a_further_request_leaves_scans_that_the_next_one_verifies_and_a_long_break_is_one_stretch() -> None:
    program, asked = program_of(SOURCE), [False, True]
    job = VerifyJob(lambda sources: program, None, lambda said: None, lambda: bool(asked) and asked.pop(0))
    columns = (ColumnMap("a", "Main.a", "input"), ColumnMap("b", "Main.b", "output"))
    mapping, names = TraceMapping(TIME, "scan", "hold", columns).to_json(), (TIME, "a", "b")
    sources = Sources("CJ1M-CPU63", {"Main.st": SOURCE}, program.interval_ns, 1)
    begun = job.answer(BeginController(1, sources, "opc.tcp://press", names, ("0", "1", "2"), mapping, Range(), 100))
    assert isinstance(begun, VerifyBegun)
    far = 1 << 40
    samples = (
        Sample(("4", "1", "2")),
        Sample((str(far), "1", "2"), after_break=True),
        Sample((str(far + 1), "1", "3")),
    )
    part = job.answer(TakeSamples(2, samples, begun.first, last=True))
    assert isinstance(part, ScansDone)
    assert (part.scan, part.compared) == (1, 0)
    rest = job.answer(TakeSamples(3, (), part.scan + 1, last=True))
    assert isinstance(rest, ScansDone)
    assert (rest.scan, [row.scan for row in rest.rows if row.first]) == (far + 1, [far + 1])
    assert (5, far - 1) in rest.skipped or (5, far) in rest.skipped
    nothing = job.answer(TakeSamples(4, (), rest.scan + 1, last=True))
    assert isinstance(nothing, ScansDone)
    assert nothing.scan == -1
