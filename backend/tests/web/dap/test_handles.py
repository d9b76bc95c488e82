import pytest

from scanbench.web.dap.handles import Below, Handles
from scanbench.wire.refused import Refused


def test_frames_are_of_one_halt() -> None:
    handles = Handles()
    first = handles.frame_id(0)
    assert handles.frame_id(0) == first
    assert handles.frame(first) == 0
    handles.clear()
    with pytest.raises(Refused, match="earlier halt"):
        handles.frame(first)
    assert handles.frame_id(0) != first


def test_what_was_found_without_a_frame_stays() -> None:
    handles = Handles()
    framed, free = handles.reference(Below(0, "VAR", "")), handles.reference(Below(None, "", "Main.items"))
    handles.clear()
    assert handles.below(free).expression == "Main.items"
    with pytest.raises(Refused, match="earlier halt"):
        handles.below(framed)


def test_the_oldest_are_forgotten() -> None:
    handles = Handles()
    numbers = [handles.reference(Below(0, "", f"a[{number}]")) for number in range(20_001)]
    assert handles.below(numbers[-1]).expression == "a[20000]"
    with pytest.raises(Refused):
        handles.below(numbers[0])
