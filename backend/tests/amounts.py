"""How much of what is made up is compared: in `make test` so much that it stays quick, in `make nightly` and CI far more.

`make nightly` runs the tests marked `nightly` or `slow` and those of hypothesis, which mark themselves.
"""

import os
from collections.abc import Sequence
from typing import TypeVar

import pytest

NIGHTLY = bool(os.environ.get("SCANBENCH_NIGHTLY"))
nightly = pytest.mark.nightly
"""Of what this test compares, `make nightly` compares more."""
slow = pytest.mark.slow
"""Only in `make nightly`: it takes many seconds, and a shorter test shows most of what it shows."""
_T = TypeVar("_T")


def amount(all: int, quick: int) -> int:
    """So many programs, runs, or examples of hypothesis."""
    return all if NIGHTLY else quick


def some(everything: Sequence[_T], each: int, first: int = 0) -> Sequence[_T]:
    """All of it, or each third one, say; `first` so that two tests of the same things take different ones."""
    return everything if NIGHTLY else everything[first::each]
