"""Errors whose cause lasts: a restart ends them, and they are there again at once."""

from collections.abc import Callable

import pytest

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.observed import observed_engine
from scanbench.faults.arm import Arm
from scanbench.faults.clear import WILL_NOT_CLEAR, ClearErrors
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.faults.schedule import Schedule
from scanbench.faults.shapes import Shape, Start, Wanted
from scanbench.runtime.command import Command, Entry, Refusal, RestartKind
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from tests.runtime.bench import program, value

SOURCE = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; firstCycle AT A200.11 : BOOL; seen, n : INT; first : BOOL; END_VAR
  n := n + 1;
  IF firstCycle THEN first := battery; END_IF;
  IF battery THEN seen := seen + 1; END_IF;
END_PROGRAM
"""
BATTERY, MEMORY, FATAL = ErrorRef("battery-error"), ErrorRef("memory-error"), ErrorRef("io-bus-error")


def ran(*commands: Command | int) -> Resource:
    """Commands, and so many scans between them."""
    resource = Resource(Loaded.make(program(SOURCE), ReferenceEngine), agenda=Schedule(observed_engine))
    for each in commands:
        if isinstance(each, int):
            (resource.run if resource.runnable else resource.idle)(each)
        else:
            assert isinstance(resource.submit(each), Entry)
    return resource


def ids_of(resource: Resource) -> list[str]:
    """The errors that are present."""
    present = resource.journal.derived(ACTIVE)
    return list(present)


def raised(*refs: ErrorRef) -> Generate:
    return Generate("Ada", refs)


@pytest.mark.parametrize("kind", ["cold", "warm", "power"])
def test_a_lasting_cause_survives_a_restart(kind: RestartKind) -> None:
    resource = ran(5, raised(BATTERY), 5, Restart("Bob", kind), 3)
    assert (value(resource, "Main.n"), value(resource, "Main.seen")) == (3, 3)
    assert value(resource, "A400") == 0x00F7
    assert [(each.scan, type(each.command).__name__, each.command.author) for each in resource.journal] == [
        (5, "Generate", "Ada"), (10, "Restart", "Bob"), (10, "Generate", "Ada"),
    ]  # fmt: skip


@pytest.mark.parametrize("order", [lambda: (raised(BATTERY), Restart("Bob", "power")), lambda: (Restart("Bob", "power"), raised(BATTERY))])  # fmt: skip
def test_whatever_the_order_in_the_scan(order: Callable[[], tuple[Command, ...]]) -> None:
    assert value(ran(5, *order(), 3), "Main.seen") == 3


def test_an_error_raised_before_the_first_scan_is_there_in_it() -> None:
    resource = ran(raised(BATTERY), 3)
    assert (value(resource, "Main.first"), value(resource, "Main.seen")) == (True, 3)


def test_after_a_restart_the_first_scan_sees_it() -> None:
    assert value(ran(5, raised(BATTERY), 5, Restart("Bob", "power"), 1), "Main.first") is True


@pytest.mark.parametrize("order", [lambda: (raised(BATTERY), SetMode("Bob", "RUN")), lambda: (SetMode("Bob", "RUN"), raised(BATTERY))])  # fmt: skip
def test_at_a_change_of_mode_the_first_scan_sees_it(order: Callable[[], tuple[Command, ...]]) -> None:
    resource = ran(5, SetMode("Bob", "PROGRAM"), *order(), 3)
    assert value(resource, "Main.seen") == 3


def test_no_change_of_mode_takes_it_away() -> None:
    resource = ran(5, raised(BATTERY), SetMode("Bob", "PROGRAM"), SetMode("Bob", "MONITOR"), 3)
    assert ids_of(resource) == ["battery-error"]
    assert value(resource, "A400") == 0x00F7


@pytest.mark.parametrize("kind", ["warm", "power"])
def test_the_hold_bit_does_not_matter_to_it(kind: RestartKind) -> None:
    resource = ran(5, Write("Ada", "A500.12", "TRUE"), raised(BATTERY, FATAL), Restart("Bob", kind), 3)
    assert set(ids_of(resource)) == {"battery-error", "io-bus-error"}
    assert not resource.runnable


def test_the_card_is_still_missing_after_power_was_off_and_cannot_be_cleared() -> None:
    card = ErrorRef("memory-error", (("location", "memory-card-transfer"),))
    resource = ran(5, raised(card), Restart("Bob", "power"), 3)
    assert ids_of(resource) == ["memory-error"]
    refused = resource.submit(ClearErrors("Bob", "all"))
    assert isinstance(refused, Refusal)
    assert refused.message.startswith(WILL_NOT_CLEAR)


def test_what_has_no_lasting_cause_is_gone() -> None:
    assert ran(5, raised(MEMORY), Restart("Bob", "power"), 3).journal.derived(ACTIVE) == {}


def test_what_was_recovered_stays_so() -> None:
    resource = ran(5, raised(BATTERY), 5, Recover("Ada", None), Restart("Bob", "power"), 3)
    assert resource.journal.derived(ACTIVE) == {}
    resource = ran(5, raised(BATTERY), Restart("Bob", "power"), 3, Recover("Ada", None), 3)
    assert (resource.journal.derived(ACTIVE), value(resource, "Main.seen")) == ({}, 3)


def test_a_fault_that_passes_by_itself_ends_with_the_restart() -> None:
    def armed(shape: Shape) -> Command:
        return Arm("Ada", Wanted((BATTERY,), Start(), shape))

    assert ran(5, armed(Shape("for", 9)), 2, Restart("Bob", "power"), 3).journal.derived(ACTIVE) == {}
    present = ran(5, armed(Shape()), 2, Restart("Bob", "power"), 3).journal.derived(ACTIVE)
    assert list(present) == ["battery-error"]
