"""What a script asks of a run: its speed, its past, branches and files of it, what left its subrange, what was reached."""

from itertools import count

import pytest

from scanbench.client import Plc, Refused, connect
from tests.web.server import Server

SOURCE = """\
FUNCTION_BLOCK Valve
VAR_IN_OUT level: INT; END_VAR
VAR small: INT(0..10); END_VAR
small := level;
END_FUNCTION_BLOCK
PROGRAM Main
VAR valve: Valve; n: INT; never: BOOL; END_VAR
n := n + 1;
valve(level := n);
IF never THEN
  n := 0;
END_IF;
END_PROGRAM
"""
SMALL, N, NEVER = 4, 8, 11
_NUMBERS = count()


@pytest.fixture
def plc(server: Server) -> Plc:
    """A PLC of its own, paused before scan 5."""
    name = f"asked of its past {next(_NUMBERS)}"
    server.instance(name, "GENERIC-IEC", Main=SOURCE)
    found = connect(server.address, user="Ann").plc(name)
    found.pause()
    found.new_run()
    found.run(scans=5, speed=0)
    return found


def scan(plc: Plc) -> int:
    return plc.state["scan"]


def test_the_speed_is_set_without_running(plc: Plc) -> None:
    assert plc.state["speed"] == 0
    plc.speed(2)
    state = plc.state
    assert (state["speed"], state["state"], state["scan"]) == (2, "paused", 5)
    with pytest.raises(Refused, match="outside of"):
        plc.speed(5000)


def test_the_past_is_shown_and_read(plc: Plc) -> None:
    assert plc.read("Main.n") == "5"
    plc.travel(2)
    past = plc.state
    assert (past["state"], past["scan"]) == ("past", 2)
    assert past["past"] == {"live_scan": 5, "by": "Ann"}
    assert plc.read("Main.n") == "2"
    plc.travel(3, count=2)  # n was counted in this scan already
    assert plc.read("Main.n") == "4"
    with pytest.raises(Refused):
        plc.travel(6)
    plc.live()
    assert (scan(plc), plc.read("Main.n")) == (5, "5")


def test_a_branch_goes_on_from_a_scan(plc: Plc) -> None:
    branch = plc.branch("what if", scan=3)
    assert branch.id != plc.id
    branch.write("Main.n", 100)
    branch.run(scans=1)
    assert (branch.read("Main.n"), plc.read("Main.n")) == ("101", "5")
    branch.power(False)
    assert branch.state["state"] == "off"
    branch.delete()
    with pytest.raises(Refused):
        branch.read("Main.n")


def test_a_run_goes_to_a_file_and_comes_back(plc: Plc, server: Server) -> None:
    taken = connect(server.address).take_run(plc.export_run(scan=4), "a run that was taken")
    assert (scan(taken), taken.read("Main.n")) == (4, "4")
    taken.delete()


def test_forces_are_listed_with_what_the_program_makes_of_them(plc: Plc) -> None:
    plc.force("Main.n", 3)
    plc.run(scans=1)
    (force,) = plc.forces
    assert (force["path"], force["value"], force["author"]) == ("Main.n", "3", "Ann")
    assert (force["after_program"], force["after"]) == ("4", "3")
    plc.release()
    assert plc.forces == []


def test_what_left_its_subrange_is_told_with_its_instance(plc: Plc) -> None:
    assert plc.diagnostics["violations"] == []
    plc.write("Main.n", 20)
    plc.run(scans=2)
    (violation,) = plc.diagnostics["violations"]
    assert (violation["instance"], violation["file"], violation["line"]) == ("Main.valve", "Main.st", SMALL)
    assert (violation["value"], violation["low"], violation["high"]) == ("22", "0", "10")
    assert (violation["times"], violation["first_scan"], violation["last_scan"]) == (2, 5, 6)
    plc.clear_diagnostics()
    assert plc.diagnostics["count"] == 0


def test_who_wrote_last_is_a_statement_or_somebody(plc: Plc) -> None:
    wrote = plc.last_write("Main.n")
    assert wrote["place"] is not None
    assert (wrote["by"], wrote["scan"], wrote["shown"], wrote["place"]["line"]) == ("program", 4, "5", N)
    plc.write("Main.n", 50)
    assert (plc.last_write("Main.n")["by"], plc.last_write("Main.n")["author"]) == ("command", "Ann")
    assert plc.last_write("Main.n", scan=2)["shown"] == "2"


def test_what_changed_between_two_scans_is_told(plc: Plc) -> None:
    found = plc.changes(1, 4)
    changes = sorted((each["path"], each["before_shown"], each["after_shown"]) for each in found["changes"])
    assert changes == [("Main.n", "1", "4"), ("Main.valve.small", "1", "4")]


def test_what_was_reached_is_told_for_each_place(plc: Plc) -> None:
    assert not plc.coverage["on"]
    plc.cover()
    plc.run(scans=3)
    found = plc.coverage
    assert (found["on"], found["scans"]) == (True, 3)
    reached = {site["line"]: site["reached"] for file in found["files"] for site in file["sites"]}
    assert reached[N]
    assert not reached[NEVER]
    assert f"DA:{NEVER},0" in plc.coverage_lcov
    plc.cover(False)
    assert not plc.coverage["on"]


def test_the_log_names_who_did_it(plc: Plc) -> None:
    plc.mode("PROGRAM")
    last = plc.log(count=1)["lines"][-1]
    assert last["author"] == "Ann"
