"""The samples, tested as somebody who wrote them would: with the fixtures of the plugin."""

from pathlib import Path

import pytest

import scanbench
from scanbench.plcmodel.load import model_named
from scanbench.testing.plc import Plc

SAMPLES = Path(scanbench.__file__).parent / "samples"
CONVEYOR, DOSING, FILLING = (str(SAMPLES / name) for name in ("conveyor", "dosing", "filling"))
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


@pytest.mark.scanbench(CONVEYOR)
@pytest.mark.parametrize("error", [each for each in ERRORS if each.severity == "nonfatal"], ids=lambda error: error.id)
def test_the_program_goes_on_with_an_error_that_is_not_fatal(plc: Plc, error) -> None:  # type: ignore[no-untyped-def]
    plc.run(5)
    plc.raise_error(error.id)
    assert plc.value("Main.uptime") == 4 * 10_000_000  # of 10 ms each
    plc.run(10)
    assert plc.value("Main.uptime") == 14 * 10_000_000
    assert plc.value("A400") != 0


@pytest.mark.scanbench(DOSING)
def test_the_dosing_plant_runs_without_an_error(plc: Plc) -> None:
    plc.run(250)
    assert not plc.errors


def press(plc: Plc, button: str) -> None:
    plc.write(button, True)
    plc.run(3)
    plc.write(button, False)


def pouring(plc: Plc) -> None:
    """The filling machine runs, and a bottle is half full."""
    plc.run(5)
    press(plc, "start")
    plc.run_until("Main.dosing.volume > 100", 500)
    assert plc.value("valve") is True


@pytest.mark.scanbench(FILLING)
def test_bottles_are_filled_and_capped_at_the_same_time(plc: Plc) -> None:
    pouring(plc)
    plc.within_scans(600, "Main.cycle.Pouring.X AND Main.cycle.Screwing.X")
    plc.within_scans(300, "bottlesDone = 1")
    plc.within_scans(200, "Main.cycle.FillDone.X AND Main.cycle.CapDone.X")
    assert plc.holds("Main.dosing.volume > 249.5 AND Main.dosing.volume < 253.0")
    press(plc, "stop")
    plc.within_scans(10, "Main.cycle.Wait.X")
    plc.never(100, "table OR valve OR spindle")
    assert plc.value("bottlesBad") == 0


@pytest.mark.scanbench(FILLING)
@pytest.mark.parametrize(("error", "bad"), [("basic-io-error", 0), ("special-io-unit-error", 1)])
def test_the_filling_machine_stops_at_once_and_goes_on_after_an_acknowledgement(plc: Plc, error: str, bad: int) -> None:
    pouring(plc)
    plc.raise_error(error)
    plc.within_scans(1, "lampRed AND horn AND NOT valve")
    plc.never(50, "table OR valve OR spindle")
    press(plc, "ack")
    plc.never(50, "table OR valve OR spindle OR NOT lampRed OR horn")  # silent, and the error is still there
    plc.recover()
    plc.never(50, "table OR valve OR spindle OR NOT lampRed")
    volume = plc.value("Main.dosing.volume")
    press(plc, "ack")
    plc.within_scans(2, "valve AND NOT lampRed")
    assert plc.holds(f"Main.dosing.volume >= REAL#{volume}")
    plc.within_scans(700, "bottlesDone = 1")
    assert plc.value("bottlesBad") == bad


@pytest.mark.scanbench(FILLING)
def test_without_the_labeller_the_filling_machine_finishes_what_it_has_begun(plc: Plc) -> None:
    pouring(plc)
    plc.raise_error("cpu-bus-unit-error", unit=2)
    plc.within_scans(1, "horn AND valve")
    plc.within_scans(50, "lampYellow")  # it blinks
    plc.within_scans(300, "Main.cycle.Wait.X")
    plc.never(100, "table OR lampRed")
    plc.recover()
    plc.never(50, "table")
    press(plc, "ack")
    plc.within_scans(10, "table")
    plc.within_scans(600, "bottlesDone = 1")


@pytest.mark.scanbench(FILLING)
def test_a_battery_only_lights_the_yellow_lamp(plc: Plc) -> None:
    pouring(plc)
    plc.raise_error("battery-error")
    plc.within_scans(1, "lampYellow AND valve")
    plc.within_scans(600, "bottlesDone = 1")
    plc.recover()
    assert plc.value("lampYellow") is True
    press(plc, "ack")
    assert plc.value("lampYellow") is False
