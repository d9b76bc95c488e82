"""The reference engine is quick enough to go through long runs with."""

from bench.interpreter import statements_per_second


def test_simple_statements() -> None:
    assert statements_per_second() > 300_000
