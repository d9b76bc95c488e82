"""Every case of `cases/*.case` on both engines."""

from pathlib import Path

import pytest

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from tests.amounts import nightly
from tests.caseformat import Case, read_cases, run_case

CASES = [case for path in sorted((Path(__file__).parent / "cases").glob("*.case")) for case in read_cases(path)]


@nightly
@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_case(case: Case) -> None:
    run_case(case, [ReferenceEngine, NativeEngine])
