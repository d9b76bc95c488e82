"""The bench command's measurement."""

import pytest

from scanbench.bench.run import PROGRAMS, BenchError, run_bench


def test_a_program_beside_its_twin() -> None:
    result = run_bench(["noop", "mavg"])
    assert set(result) == {"programs", "compile"}
    for name in ("noop", "mavg"):
        measured = result["programs"][name]
        assert measured["ns"] is not None
        assert measured["c_ns"] is not None
        assert measured["ratio"] == pytest.approx(measured["ns"] / measured["c_ns"], abs=0.01)
        assert set(result["compile"][name]) == {"check", "emit", "parse", "optimise", "codegen", "link"}


def test_a_program_without_a_twin() -> None:
    measured = run_bench(["string_unrolled"])["programs"]["string_unrolled"]
    assert measured["ns"] is not None
    assert measured["c_ns"] is measured["ratio"] is None


def test_an_unknown_program_is_named() -> None:
    with pytest.raises(BenchError, match=r"no bench program nope; there are: noop"):
        run_bench(["nope"])
    assert "noop" in PROGRAMS
