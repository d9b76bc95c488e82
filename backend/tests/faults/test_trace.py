"""States kept as what changed."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from scanbench.faults.reaction.states import Trace

STATES = st.lists(st.lists(st.integers(0, 2**64 - 1), min_size=5, max_size=5), min_size=1, max_size=20)


@given(STATES)
def test_every_state_comes_back(states: list[list[int]]) -> None:
    arrays = [np.array(each, np.uint64) for each in states]
    trace = Trace(arrays[0], 1 << 20)
    for array in arrays[1:]:
        trace.add(array)
    assert len(trace) == len(arrays) - 1
    assert [state.tolist() for state in trace.states()] == states[1:]
    assert not trace.full


def test_it_is_full_when_its_limit_is_reached() -> None:
    trace = Trace(np.zeros(10, np.uint64), 100)
    full = []
    for number in (0, 1, 1):
        trace.add(np.full(10, number, np.uint64))
        full.append(trace.full)
    assert full == [False, True, True]
    assert len(trace) == 3
