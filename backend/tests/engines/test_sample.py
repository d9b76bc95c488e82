"""Sampling: the same rows from each engine, one for each scan, and none lost."""

import struct
from collections.abc import Callable

import pytest

from scanbench.check.typed.condition import BadCondition, Signal, compile_signal
from scanbench.engines.engine import Engine, Reason, Stop
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.probed import ProbedBuilds
from scanbench.engines.pair import PairEngine
from scanbench.engines.sample import Sampling
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from tests.engines.native.plc import check

SOURCE = """
FUNCTION_BLOCK Mixer VAR_IN_OUT level : INT; END_VAR level := level + 1; END_FUNCTION_BLOCK
PROGRAM Main
VAR n, i : DINT; a, b : INT; back : SINT; far : LINT; r : REAL; l : LREAL; on : BOOL; t : TIME; m : Mixer;
  list : ARRAY [0..3] OF INT := [10, 20, 30, 40]; p : REF_TO INT; END_VAR
n := n + 1; i := n MOD 6; back := DINT_TO_SINT(0 - n); far := DINT_TO_LINT(n) * -1_000_000_000_000; r := DINT_TO_REAL(n) / 3.0;
l := r; on := n MOD 3 = 0; t := T#10ms * n;
IF n > 4 THEN IF on THEN m(level := a); ELSE m(level := b); END_IF; END_IF;
IF n = 8 THEN p := REF(a); END_IF; IF n = 12 THEN p := NULL; END_IF;
END_PROGRAM
"""
SIGNALS = [
    "Main.n", "Main.back", "Main.far", "Main.r", "Main.l", "Main.on", "Main.t", "Main.m.level", "Main.a + Main.b",
    "Main.list[Main.i]", "Main.p^", "Main.n > 5 AND Main.on", "D100",
]  # fmt: skip
ENGINES: list[Callable[[Program, bytearray], Engine]] = [
    NativeEngine, ReferenceEngine, PairEngine, DebugBuilds().engine, debug_engine,
    lambda program, memory: ProbedBuilds().engine(program, memory, ()),
]  # fmt: skip
engines = pytest.mark.parametrize(
    "make", ENGINES, ids=["native", "reference", "both", "native debug", "reference debug", "probed"]
)


def signal(program: Program, text: str) -> Signal:
    made = compile_signal(program, text)
    assert isinstance(made, Signal), made
    return made


def sampled(make: Callable[[Program, bytearray], Engine], scans: int, every: int = 1) -> list[list[int]]:
    program = check(SOURCE)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    sampling = Sampling(program, [signal(program, text) for text in SIGNALS if text != "D100"], every)
    engine.sample(sampling)
    assert engine.run(scans) == Stop(Reason.DONE)
    return [list(map(int, row)) for row in sampling.take()]


def test_the_engines_write_the_same_rows() -> None:
    assert sampled(NativeEngine, 40) == sampled(ReferenceEngine, 40)


@engines
def test_values_are_those_after_the_scan(make: Callable[[Program, bytearray], Engine]) -> None:
    rows = sampled(make, 12)
    assert [row[0] for row in rows] == list(range(12))
    values = [row[2:] for row in rows]
    assert [row[0] for row in values] == list(range(1, 13))
    assert [row[1] for row in values] == [256 - n for n in range(1, 13)]
    assert values[0][2] == (-1_000_000_000_000) % (1 << 64)
    assert struct.unpack("<f", values[0][3].to_bytes(4, "little")) == pytest.approx((1 / 3,))
    assert [row[5] for row in values] == [int(n % 3 == 0) for n in range(1, 13)]
    assert values[6][6] == 70_000_000


@engines
def test_what_leads_nowhere_has_no_value(make: Callable[[Program, bytearray], Engine]) -> None:
    rows = sampled(make, 14)

    def has(name: str) -> list[int]:
        return [row[1] >> SIGNALS.index(name) & 1 for row in rows]

    assert has("Main.m.level") == [0] * 4 + [1] * 10
    assert has("Main.list[Main.i]") == [int((n % 6) < 4) for n in range(1, 15)]
    assert has("Main.p^") == [0] * 7 + [1] * 4 + [0] * 3
    assert has("Main.a + Main.b") == [1] * 14
    level = [row[2 + SIGNALS.index("Main.m.level")] for row in rows]
    assert level[4:9] == [1, 1, 2, 3, 2]  # b, a (n = 6), b, b, a


@engines
def test_every_third_scan(make: Callable[[Program, bytearray], Engine]) -> None:
    assert [row[0] for row in sampled(make, 10, every=3)] == [0, 3, 6, 9]


@engines
def test_a_full_ring_ends_the_run_and_nothing_is_lost(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(SOURCE)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    sampling = Sampling(program, [signal(program, "Main.n")], rows=7)
    engine.sample(sampling)
    assert engine.run(30) == Stop(Reason.INTERRUPTED)
    assert sampling.full
    assert engine.run(30) == Stop(Reason.INTERRUPTED)  # still full: no scan runs
    seen = sampling.take().tolist()
    while len(seen) < 30:
        engine.run(30 - len(seen))
        seen += sampling.take().tolist()
    assert [row[0] for row in seen] == list(range(30))
    assert [row[2] for row in seen] == list(range(1, 31))


@engines
def test_only_changes(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(SOURCE)
    engine = make(program, bytearray(program.initial_image))
    sampling = Sampling(program, [signal(program, "Main.on")], changes=True)
    engine.sample(sampling)
    engine.run(10)
    assert sampling.take()[:, [0, 2]].tolist() == [[0, 0], [2, 1], [3, 0], [5, 1], [6, 0], [8, 1], [9, 0]]


@engines
def test_several_samplings_and_none(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(SOURCE)
    engine = make(program, bytearray(program.initial_image))
    one, other = Sampling(program, [signal(program, "Main.n")]), Sampling(program, [signal(program, "Main.a")], 2)
    engine.sample(one, other)
    engine.run(6)
    engine.sample(one)
    engine.run(4)
    engine.sample()
    engine.run(5)
    assert one.take()[:, 0].tolist() == list(range(10))
    assert other.take()[:, 0].tolist() == [0, 2, 4]


@engines
def test_a_scan_that_runs_again_is_not_sampled_again(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(SOURCE)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    sampling = Sampling(program, [signal(program, "Main.n")])
    engine.sample(sampling)
    engine.run(5)
    begin = bytes(memory)
    engine.run(5)
    memory[:] = begin
    engine.run(7)
    assert sampling.take()[:, 0].tolist() == list(range(12))


@engines
def test_a_scan_that_traps_has_no_row(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check("PROGRAM Main VAR n, a : INT; END_VAR n := n + 1; a := 1 / (3 - n); END_PROGRAM")
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    sampling = Sampling(program, [signal(program, "Main.n")])
    engine.sample(sampling)
    assert engine.run(10).reason is Reason.TRAP
    assert sampling.take()[:, 0].tolist() == [0, 1]
    assert int.from_bytes(memory[Layout.SCAN : Layout.SCAN + 8], "little") == 2


def test_sixty_four_signals() -> None:
    program = check(SOURCE)
    rows = []
    for make in (NativeEngine, ReferenceEngine):
        engine = make(program, bytearray(program.initial_image))
        sampling = Sampling(program, [signal(program, f"Main.n + {k}") for k in range(64)])
        engine.sample(sampling)
        engine.run(3)
        rows.append(sampling.take().tolist())
    assert rows[0] == rows[1]
    assert rows[0][2][1] == (1 << 64) - 1
    assert rows[0][2][2:] == [3 + k for k in range(64)]


@pytest.mark.parametrize(
    ("text", "word"),
    [("", "no signal"), ("Main", "Main"), ("Main.list", "ARRAY"), ("Main.x", "x"), ("'abc'", "STRING"), ("Main.p", "REF"),
     ("Main.n := 3", "assigns"), ("x" * 3000, "characters")],
)  # fmt: skip
def test_what_is_no_signal_says_why(text: str, word: str) -> None:
    made = compile_signal(check(SOURCE), text)
    assert isinstance(made, BadCondition)
    assert word in made.message


def test_bounds() -> None:
    program = check(SOURCE)
    with pytest.raises(ValueError, match="64"):
        Sampling(program, [])
    with pytest.raises(ValueError, match="every 0"):
        Sampling(program, [signal(program, "Main.n")], 0)
