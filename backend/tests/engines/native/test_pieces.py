"""Large bodies in pieces: the same bytes as in one, and no function that LLVM takes long for."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.check.build import check_sources
from scanbench.engines.native import inlining
from scanbench.engines.native.compiler import QUICK
from scanbench.engines.native.emit_program import emit_program
from scanbench.engines.native.engine import NativeEngine
from tests.amounts import amount, nightly, some
from tests.caseformat import Case, read_cases, run_case
from tests.engines.native.plc import MODEL
from tests.engines.native.test_against_reference import agree

CASES = [each for path in sorted((Path(__file__).parents[2] / "cases").glob("*.case")) for each in read_cases(path)]


def divide(patch: pytest.MonkeyPatch) -> None:
    """From here on nearly every body is a large one."""
    patch.setattr(inlining, "DIVIDED", 2)
    patch.setattr(inlining, "PIECE", 2)


@nightly
@pytest.mark.parametrize("case", some(CASES, 24, 5), ids=[case.name for case in some(CASES, 24, 5)])
def test_cases_in_pieces(case: Case, monkeypatch: pytest.MonkeyPatch) -> None:
    divide(monkeypatch)
    run_case(case, [NativeEngine])


@settings(max_examples=amount(120, 10))
@given(st.integers(0, (1 << 32) - 1))
def test_the_engines_agree_in_pieces(seed: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        divide(patch)
        agree(seed, QUICK)


def text_of(body: str) -> str:
    source = f"PROGRAM Main\nVAR a, b, i : DINT; END_VAR\n{body}\nEND_PROGRAM\n"
    program = check_sources({"large.st": source}, MODEL, 1_000_000).program
    assert program is not None
    return emit_program(program)


@pytest.mark.parametrize(
    "body",
    [
        "a := b + i;\n" * 3_000,
        "IF a > 3 THEN\n" + "a := b + i;\n" * 3_000 + "ELSE\n" + "b := a + i;\n" * 3_000 + "END_IF;",
        "FOR i := 1 TO 3 DO\n"
        + "a := b + i;\nIF a > 7 THEN EXIT; END_IF;\n" * 1_500
        + "b := i;\n" * 1_500
        + "END_FOR;",
    ],
    ids=["a list", "lists in an IF", "a list in a FOR"],
)
def test_no_function_is_large(body: str) -> None:
    text = text_of(body)
    sizes = [function.count("\n") for function in text.split("\ndefine ")]
    assert len(sizes) > 5
    assert max(sizes) < 20 * inlining.PIECE or "EXIT" in body, sizes


def test_what_returns_stays_where_it_is() -> None:
    """A RETURN leaves the POU, not a piece of it."""
    text = text_of("a := b + i;\nIF a > 7 THEN RETURN; END_IF;\n" * 1_500)
    assert "piece" not in text
