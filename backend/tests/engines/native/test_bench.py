"""The bench command's measurement."""

from pathlib import Path

import pytest

from scanbench.bench.building import measure_building
from scanbench.bench.debugging import conveyor, measure_costs, measure_swaps
from scanbench.bench.pace import PERIODS_MS, report, run_pace_bench
from scanbench.bench.run import HERE, PROGRAMS, BenchError, run_bench
from scanbench.bench.trace import run_trace_bench
from scanbench.cli.bench import BUILDING
from scanbench.taps import trace_buffer


def test_a_program_beside_its_twin() -> None:
    result = run_bench(["noop", "mavg"])
    assert result["building"] == {}
    assert result["interpreter_per_second"] is None
    assert result["peers"]["mavg"]["matiec"] == pytest.approx(228 / 32, abs=0.001)
    for name in ("noop", "mavg"):
        measured = result["programs"][name]
        assert measured["ns"] is not None
        assert measured["c_ns"] is not None
        assert measured["ratio"] == pytest.approx(measured["ns"] / measured["c_ns"], abs=0.01)
        assert set(result["compile"][name]) == {"check", "emit", "parse", "optimise", "codegen", "link", "observed"}
        assert measured["observed_ratio"] is not None
        assert measured["observed_ratio"] > 0


def test_a_program_without_a_twin() -> None:
    measured = run_bench(["string_unrolled"])["programs"]["string_unrolled"]
    assert measured["ns"] is not None
    assert measured["c_ns"] is measured["ratio"] is None


def test_an_unknown_program_is_named() -> None:
    with pytest.raises(BenchError, match=r"no bench program nope; there are: noop"):
        run_bench(["nope"])
    assert "noop" in PROGRAMS


def test_what_building_takes(tmp_path: Path) -> None:
    blocks = (HERE / "st" / "big10kflat.st").read_text("utf-8").split("END_FUNCTION_BLOCK")[:20]
    program = "PROGRAM Main\nVAR u : Unit0; END_VAR\n  u();\nEND_PROGRAM\n"
    path = tmp_path / "blocks.st"
    path.write_text("END_FUNCTION_BLOCK".join([*blocks, "\n"]) + program, "utf-8")
    figures = measure_building(str(path))
    assert set(figures) == {key for key, _, _ in BUILDING}
    assert all(figure >= 0 for figure in figures.values()), figures


def test_what_breakpoints_cost() -> None:
    program = conveyor()
    costs = measure_costs(program)
    assert min(costs.run_ns, costs.loaded, costs.probed_hot, costs.debug_hot) > 0
    assert costs.probed_cold is not None
    swaps = measure_swaps(program)
    assert min(swaps.debug_pause, swaps.debug_build, swaps.probed_pause, swaps.probed_build) > 0


def test_what_the_loop_can_do() -> None:
    figures = run_pace_bench(0.05)
    assert figures.scans_per_second > 0
    assert min(figures.scan_ns, figures.condition_ns, figures.knock_ns, figures.wake_us) > 0
    assert [(each.period_ms, each.scans) for each in figures.paces] == [(ms, 50 // ms) for ms in PERIODS_MS]
    assert len(report(figures).splitlines()) == 3 + len(PERIODS_MS)


def test_traces_are_looked_through_whatever_their_length(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trace_buffer, "LARGEST", 1000)
    figures = run_trace_bench(minutes=0.02, seconds=0.05)
    assert (figures.scans, figures.lost, figures.paced_scans, figures.paced_lost) == (1200, 0, 50, 0)
