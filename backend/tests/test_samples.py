"""Every sample and template that ships: no problems, and the same bytes on both engines after every scan."""

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.pair import PairEngine
from scanbench.recording.headless import HeadlessRun, run_headless
from scanbench.server.samples import Sample, templates
from tests.caseformat import MODELS

SAMPLES = {sample.id: sample for sample in templates()}


@pytest.mark.parametrize("sample", SAMPLES.values(), ids=SAMPLES)
def test_a_sample_runs_alike_on_both_engines(sample: Sample) -> None:
    checked = check_sources(sample.files, MODELS[sample.model])
    assert checked.problems == ()
    assert checked.program is not None
    result: HeadlessRun[None] = run_headless(checked.program, 600, PairEngine)
    assert result.scans == 600
    assert result.resource.trap is None
