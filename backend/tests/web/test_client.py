"""The Python client against a real server."""

import re
from itertools import count
from pathlib import Path

import pytest

from scanbench.client import Plc, Refused, connect
from tests.web.server import Server

SOURCE = """\
FUNCTION_BLOCK Valve
VAR_IN_OUT level: INT(0..100); END_VAR
VAR opened: BOOL; END_VAR
opened := level > 50;
END_FUNCTION_BLOCK
PROGRAM Main
VAR valve: Valve; tank: ARRAY[1..3] OF INT(0..100); count: DINT; text: STRING[20]; go: BOOL; END_VAR
valve(level := tank[2]);
count := count + 1;
END_PROGRAM
CONFIGURATION Plant
  TASK Cyclic(INTERVAL := T#10ms, PRIORITY := 1);
  PROGRAM Main WITH Cyclic: Main;
END_CONFIGURATION
"""

_NUMBERS = count()


@pytest.fixture
def plc(server: Server) -> Plc:
    """A PLC of its own, paused."""
    name = f"scripted {next(_NUMBERS)}"
    server.instance(name, "GENERIC-IEC", Main=SOURCE)
    found = connect(server.address, user="Ann").plc(name)
    found.run(scans=3)
    return found


def test_a_script_reads_writes_and_forces(plc: Plc) -> None:
    assert "Main.tank[2]" in plc.write("Main.valve.level", 60)
    assert plc.read("Main.tank[2]") == "60"
    plc.write("Main.go", True)
    assert plc.read("Main.go AND Main.tank[2] > 50") == "TRUE"
    plc.write("Main.text", "'hello'")
    assert plc.read("Main.text") == "'hello'"
    with plc.forced("Main.count", 100):
        plc.run(scans=5)
        assert plc.read("Main.count") == "100"
    plc.scan()
    assert plc.read("Main.count") == "101"


def test_what_is_wrong_says_what_is_right(plc: Plc) -> None:
    with pytest.raises(Refused, match=r"0\.\.100"):
        plc.write("Main.valve.level", 101)
    with pytest.raises(Refused) as refused:
        plc.read("Main.cuont")
    assert "Main.count" in refused.value.near or "count" in str(refused.value)
    with pytest.raises(Refused, match="no instance"):
        plc._server.plc("nowhere")


def test_a_run_until_ends_where_the_condition_holds(plc: Plc) -> None:
    plc.run(until="Main.count >= 1000", speed=0)
    assert plc.read("Main.count") == "1000"
    assert plc.state["state"] == "paused"


def test_a_fatal_error_is_not_the_end_of_a_script(server: Server) -> None:
    server.instance(
        "fatal for scripts", "CJ1M-CPU63", main="PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
    )
    plc = connect(server.address, user="Ann").plc("fatal for scripts")
    plc.run(scans=3)
    plc.raise_error("memory-error", location="io-table-checksum")
    assert plc.read("A401.15") == "TRUE"
    with pytest.raises(Refused, match="Recover it"):
        plc.mode("MONITOR")
    plc.recover("memory-error")
    assert plc.mode("MONITOR") == "mode MONITOR: the program runs"
    count = int(plc.read("Main.n"))
    plc.run(scans=5)
    assert int(plc.read("Main.n")) == count + 5
    plc.raise_error("memory-error", location="io-table-checksum")
    assert "memory-error" in plc.clear("all")  # the tool's own way
    plc.raise_error("battery-error")
    with pytest.raises(Refused, match="battery-error"):
        plc.clear("all")  # its cause lasts
    plc.raise_error("memory-error", location="io-table-checksum")
    assert "power off and on" in plc.restart("power")
    plc.run(scans=2)
    assert plc.read("Main.n") == "2"


def test_a_script_arms_faults_and_takes_them_back(server: Server) -> None:
    server.instance("armed", "CJ1M-CPU63", main="PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n")
    plc = connect(server.address, user="Ann").plc("armed")
    plc.run(scans=3)
    begin = int(str(plc.state["scan"]))
    said = plc.arm("basic-io-error", start={"kind": "scan", "scan": begin + 4}, shape={"kind": "stay"}, rack=1, slot=3)
    assert said.startswith("armed 1: basic-io-error")
    assert [(each["id"], each["errors"]) for each in plc.armed] == [(1, ["basic-io-error"])]
    plc.run(scans=6)
    assert plc.read("A408") == "16#0103"
    plc.arm("battery-error", start={"kind": "scan", "scan": begin + 1000})
    plc.disarm()
    assert not plc.armed
    assert plc.read("A402.12") == "FALSE"
    with pytest.raises(Refused, match="no statement begins"):
        plc.arm("battery-error", start={"kind": "line", "file": "main.st", "line": 99})


def test_the_example_of_the_docs_runs(tmp_path: Path) -> None:
    page = (Path(__file__).parents[3] / "docs" / "scripts.md").read_text("utf-8")
    found = re.search(r"```python\n(.*?)```", page, re.DOTALL)
    assert found is not None
    with Server(tmp_path) as server:  # it leaves the sample paused
        sample = connect(server.address).plc("line-1")
        sample.run(scans=3)
        exec(found[1].replace("http://127.0.0.1:8700/?token=...", server.address), {})
