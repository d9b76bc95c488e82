"""The Python client against a real server."""

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from itertools import count
from pathlib import Path

import pytest

from scanbench.client import Plc, Refused, connect
from scanbench.web.openapi import document
from tests.amounts import slow
from tests.cli.calling import scanbench
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


def test_what_is_wrong_says_what_is_right(plc: Plc, server: Server) -> None:
    with pytest.raises(Refused, match=r"0\.\.100"):
        plc.write("Main.valve.level", 101)
    with pytest.raises(Refused) as refused:
        plc.read("Main.cuont")
    assert "Main.count" in refused.value.near or "count" in str(refused.value)
    with pytest.raises(Refused, match="no instance"):
        connect(server.address).plc("nowhere")


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
    assert [(each["id"], each["errors"]) for each in plc.armed] == [(1, ["basic-io-error:rack=1,slot=3"])]
    plc.run(scans=6)
    assert plc.read("A408") == "16#0103"
    plc.arm("battery-error", start={"kind": "scan", "scan": begin + 1000})
    plc.disarm()
    assert not plc.armed
    assert plc.read("A402.12") == "FALSE"
    with pytest.raises(Refused, match="no statement begins"):
        plc.arm("battery-error", start={"kind": "line", "file": "main.st", "line": 99})


@slow
def test_the_examples_of_the_docs_run(tmp_path: Path) -> None:
    page = (Path(__file__).parents[3] / "docs" / "scripts.md").read_text("utf-8")
    examples = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    with Server(tmp_path) as server:  # it leaves the sample paused
        sample = connect(server.address).plc("line-1")
        sample.run(scans=3)
        names: dict[str, object] = {}
        for each in examples:
            exec(each.replace("http://127.0.0.1:8700/?token=...", server.address), names)
        (shell,) = re.findall(r"```sh\n(.*?)```", page, re.DOTALL)
        told = f"set -ex\n{shell.replace('http://127.0.0.1:8700/?token=...', server.address)}"
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        done = subprocess.run(
            ["bash", "-c", told],
            cwd=tmp_path,
            env={**os.environ, "PATH": path},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        assert "no error is present" in done.stdout
        assert "no difference" in done.stdout


def test_the_routes_of_the_docs_are_there() -> None:
    page = (Path(__file__).parents[3] / "docs" / "scripts.md").read_text("utf-8")
    paths: Mapping[str, Mapping[str, object]] = document()["paths"]  # type: ignore[assignment]
    there = {(method.upper(), re.sub(r"{\w+}", "1", path)) for path, methods in paths.items() for method in methods}
    told = re.findall(r"^    (GET|POST|PATCH|PUT|DELETE) +(/api[^?\s]+)", page, re.MULTILINE)
    assert told
    assert [each for each in told if each not in there] == []


SAYS = """\
PROGRAM Main
VAR n : DINT; hot : BOOL; END_VAR
  n := n + 1;
  IF hot THEN FAL(N := 42, S := 'PUMP HOT'); MSG(1, 'CALL SERVICE'); END_IF;
END_PROGRAM
"""


def test_a_script_reads_what_the_device_says_of_its_errors(server: Server) -> None:
    server.instance("device for scripts", "CJ1M-CPU63", main=SAYS)
    plc = connect(server.address, user="Ann").plc("device for scripts")
    plc.run(scans=2)
    assert (plc.present, plc.error_log) == ([], [])
    plc.write("Main.hot", True)
    plc.run(scans=2)
    plc.write("Main.hot", False)
    plc.raise_error("battery-error")
    assert [(each["code"], each["text"]) for each in plc.present] == [("412A", "PUMP HOT"), ("00F7", "")]
    assert [each["id"] for each in plc.error_log] == ["battery-error", "fal"]
    assert plc.device["messages"] == [{"number": 1, "text": "CALL SERVICE", "instruction": "MSG"}]
    plc.clear(0x412A)
    with pytest.raises(Refused, match="will not clear"):
        plc.clear()
    plc.clear_log()
    plc.recover()
    assert (plc.present, plc.error_log, plc.device["code"]) == ([], [], "0000")


def test_a_script_goes_through_a_fatal_error_a_restart_and_a_sweep(server: Server) -> None:
    server.instance("long way for scripts", "CJ1M-CPU63", main=SAYS)
    plc = connect(server.address, user="Ann").plc("long way for scripts")
    plc.run(scans=3)
    plc.raise_error("io-bus-error", rack=1, slot=2)
    assert plc.state["state"] == "fatal"
    assert [each["code"] for each in plc.present] == ["80C1"]
    with pytest.raises(Refused, match="will not clear"):
        plc.clear("all")
    plc.recover()
    assert _mode(plc) == "PROGRAM"
    plc.mode("RUN")
    plc.run(scans=2)
    assert _mode(plc) == "RUN"
    plc.restart("power")
    plc.run(until="Main.n >= 3", speed=0)
    plc.arm("battery-error", shape={"kind": "for", "scans": 2})
    plc.run(scans=1)
    assert [each["id"] for each in plc.present] == ["battery-error"]
    plc.run(scans=3)
    assert plc.present == []
    state = plc.keep_state("after the way")
    found = plc.wait_for_sweep(plc.begin_sweep(["battery-error"], [state], window=5))
    assert found["status"] == "done"
    assert [each["verdict"] for each in found["cells"]] == ["never_read"]


def _mode(plc: Plc) -> str:
    return plc.state["mode"]


def test_the_command_line_reads_and_clears_as_a_tool_does(server: Server) -> None:
    server.instance("device for the shell", "CJ1M-CPU63", main=SAYS)
    plc = connect(server.address, user="Ann").plc("device for the shell")
    plc.run(scans=2)

    def said(command: str, *options: str) -> tuple[int, str]:
        done = scanbench("errors", command, "device for the shell", "--server", server.address, *options)
        return done.returncode, " ".join((done.stdout + done.stderr).split())

    assert said("present") == (0, "no error is present")
    plc.raise_error("fal", number=7)
    plc.raise_error("battery-error")
    assert said("present")[0] == 1
    assert "4107 nonfatal fal FAL error FAL number: 7" in said("present")[1]
    assert "00F7 battery-error Battery error" in said("log")[1]
    assert said("clear", "--code", "4107") == (0, "cleared by the tool: fal")
    assert said("clear", "--all")[0] == 2
    assert "will not clear" in said("clear")[1]
    assert said("clear", "--log") == (0, "error log cleared")
    assert said("log") == (0, "the error log is empty")
    assert said("clear", "--all", "--log")[0] == 2
