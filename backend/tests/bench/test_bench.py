"""What `python -m bench` measures."""

import hashlib
import json
from pathlib import Path

import pytest

from bench.__main__ import BUILDING, main, shown
from bench.building import measure_building
from bench.debugging import conveyor, measure_costs, measure_swaps
from bench.large import large
from bench.pace import PERIODS_MS, report, run_pace_bench
from bench.run import PROGRAMS, BenchError, Row, run_bench
from bench.trace import run_trace_bench
from scanbench.taps import trace_buffer
from tests.amounts import slow


@slow
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


@pytest.mark.parametrize(
    ("name", "digest"),
    [
        ("big10k", "4c883774e6133ea507e50dcdae339ee6e98c5aaeadfd463103996e3890e33d26"),
        ("big10kflat", "d52d3d743a47ccaae3a78cd6b0fe97decc105e6fdd2122f5dfe8e1daf325eebd"),
    ],
)
def test_large_programs_are_the_same_each_time(name: str, digest: str) -> None:
    text = large(name)
    assert len(text.splitlines()) == 10_000
    assert hashlib.sha256(text.encode()).hexdigest() == digest, "figures of before cannot be compared with those of now"


def test_the_command_prints_a_table_or_an_object(capsys: pytest.CaptureFixture[str]) -> None:
    main(["noop", "--json"])
    assert set(json.loads(capsys.readouterr().out)["programs"]) == {"noop"}
    with pytest.raises(SystemExit):
        main(["nope"])
    assert "there is no bench program nope" in capsys.readouterr().err


def test_a_subject_has_options_of_its_own(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["noop", "--count", "3"])
    assert "--count" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["instances", "--help"])
    assert "--count" in capsys.readouterr().out


def test_figures_are_shown_as_lines() -> None:
    row: Row = {"ns": 12.34, "c_ns": 10.0, "ratio": 1.234, "observed_ratio": 2.0}
    built = {key: 1.0 for key, _, _ in BUILDING}
    lines = shown(
        {
            "programs": {"noop": row}, "peers": {"noop": {"matiec": 3.0}}, "compile": {"noop": {"check": 1.0}},
            "building": {"big10k": built}, "interpreter_per_second": 1000.0,
        }
    )  # fmt: skip
    assert lines[1].split() == ["noop", "12.3", "10.0", "1.23", "2.00", "3.00", "check", "1"]
    assert len([line for line in lines if line.endswith("1.0 ms")]) == len([1 for *_, unit in BUILDING if unit == "ms"])
    assert "1,000 simple statements" in lines[-1]


def test_a_program_without_a_twin() -> None:
    measured = run_bench(["string_unrolled"])["programs"]["string_unrolled"]
    assert measured["ns"] is not None
    assert measured["c_ns"] is measured["ratio"] is None


def test_an_unknown_program_is_named() -> None:
    with pytest.raises(BenchError, match=r"no bench program nope; there are: noop"):
        run_bench(["nope"])
    assert "noop" in PROGRAMS


@slow
def test_what_building_takes(tmp_path: Path) -> None:
    blocks = large("big10kflat").split("END_FUNCTION_BLOCK")[:20]
    program = "PROGRAM Main\nVAR u : Unit0; END_VAR\n  u();\nEND_PROGRAM\n"
    path = tmp_path / "blocks.st"
    path.write_text("END_FUNCTION_BLOCK".join([*blocks, "\n"]) + program, "utf-8")
    figures = measure_building(str(path))
    assert set(figures) == {key for key, _, _ in BUILDING}
    assert all(figure >= 0 for figure in figures.values()), figures


@slow
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
    assert min(figures.scan_ns, figures.condition_ns, figures.interrupt_ns, figures.wake_us) > 0
    assert [(each.period_ms, each.scans) for each in figures.paces] == [(ms, 50 // ms) for ms in PERIODS_MS]
    assert len(report(figures).splitlines()) == 3 + len(PERIODS_MS)


def test_traces_are_looked_through_whatever_their_length(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trace_buffer, "LARGEST", 1000)
    figures = run_trace_bench(minutes=0.02, seconds=0.05)
    assert (figures.scans, figures.lost, figures.paced_scans, figures.paced_lost) == (1200, 0, 50, 0)
