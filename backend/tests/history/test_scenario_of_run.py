"""A scenario that is made of a run."""

from pathlib import Path

import pytest

from scanbench.history.scenario import write_scenario
from scanbench.history.scenario_of_run import NOTHING, scenario_of
from scanbench.recording.reader import RunReader
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import COUNTER, advance, begun, of_file


@pytest.mark.parametrize(("motor", "expected"), [("motor AT CIO 100.00 : BOOL", True), ("motor : BOOL", False)])
def test_of_a_program_without_outputs_nothing_is_expected_and_the_file_says_so(
    tmp_path: Path, motor: str, expected: bool
) -> None:
    path = tmp_path / "run"
    timeline = begun(path, COUNTER.replace("motor AT CIO 100.00 : BOOL", motor))
    advance(timeline, 10)
    timeline.close()
    with RunReader(path, of_file, ENTRIES) as reader:
        reader.follow()
        said = write_scenario(scenario_of(reader, 9))
    assert (f"# {NOTHING}\n" in said) is not expected
    assert ("\nexpect:" in said) is expected
