"""The samples, tested as somebody who wrote them would: with the fixtures of the plugin."""

from pathlib import Path

import pytest

import scanbench
from scanbench.plcmodel.load import model_named
from scanbench.testing.plc import Plc

SAMPLES = Path(scanbench.__file__).parent / "samples"
CONVEYOR, DOSING = str(SAMPLES / "conveyor"), str(SAMPLES / "dosing")
ERRORS = [each for each in model_named("CJ1M-CPU63").errors() if each.coded]
"""Those that the code word tells."""
LOOKED_AT = {"basic-io-error", "cpu-bus-unit-error", "special-io-unit-error", "special-io-unit-unknown"}
"""By the function block ErrorHandler, which reads their flags."""


@pytest.mark.scanbench(CONVEYOR)
@pytest.mark.parametrize("error", ERRORS, ids=lambda error: error.id)
def test_an_error_of_the_catalogue_is_told_and_goes_again(plc: Plc, error) -> None:  # type: ignore[no-untyped-def]
    plc.run(5)
    plc.never(5, "A400 <> 0")
    plc.raise_error(error.id)
    plc.within_scans(1, "A400 <> 0")
    told = plc.errors
    assert len(told) == 1
    stops = error.severity == "fatal"
    scans = plc.scan
    plc.run(3)
    assert plc.scan == scans + 3
    assert plc.value(error.flag_text) is True
    plc.recover()
    assert not plc.errors
    if stops:
        plc.restart("warm")
    plc.within_scans(2, "A400 = 0")


@pytest.mark.scanbench(CONVEYOR)
@pytest.mark.parametrize("error", [each for each in ERRORS if each.severity == "nonfatal"], ids=lambda error: error.id)
def test_the_lamp_is_lit_by_errors_that_the_program_looks_at(plc: Plc, error) -> None:  # type: ignore[no-untyped-def]
    plc.run(5)
    plc.raise_error(error.id)
    if error.id in LOOKED_AT:
        plc.within_scans(2, "lamp")
    else:
        plc.never(5, "lamp")


@pytest.mark.scanbench(DOSING)
def test_the_dosing_plant_runs_without_an_error(plc: Plc) -> None:
    plc.run(250)
    assert not plc.errors
