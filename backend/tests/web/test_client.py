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


def test_the_example_of_the_docs_runs(tmp_path: Path) -> None:
    page = (Path(__file__).parents[3] / "docs" / "scripts.md").read_text("utf-8")
    found = re.search(r"```python\n(.*?)```", page, re.DOTALL)
    assert found is not None
    with Server(tmp_path) as server:  # it leaves the sample paused
        sample = connect(server.address).plc("line-1")
        sample.run(scans=3)
        exec(found[1].replace("http://127.0.0.1:8700/?token=...", server.address), {})
