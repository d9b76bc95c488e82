"""The Python client asks for all that the page does at a PLC: each route of a PLC, a verification, a sweep and a record is asked for, or named below."""

import ast
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

import scanbench.client.requests
from scanbench.client import Refused, connect
from scanbench.web.openapi import document
from tests.web.server import Server

SOURCE = """\
PROGRAM Main
VAR n, doubled : INT; END_VAR
n := n + 1;
doubled := n * 2;
END_PROGRAM
"""

FOLDER = Path(scanbench.client.requests.__file__).parent
OF_A_PLC = re.compile(r"/api/(?:instances/1|verifications|verification-records|sweeps|trace-mappings|states)\b")
APART = {
    "complete": "for who types", "instances-of": "for who types", "rack": "a view of the page", "program": "a view of the page",
    "flow": "a view of the page", "memory": "a view of the page", "memory/1/words": "a view of the page", "memory/1/find": "a view of the page",
    "communication/modbus/map": "a table to print", "communication/modbus/map.csv": "a table to print", "model": "a catalogue: `errors` has its errors",
}  # fmt: skip
"""Routes of a PLC that only the page wants, and why."""
OTHERWISE = {
    "POST trace-check": "`begin_trace_verification` says the same", "GET /api/verification-records/1": "in `kept_verifications`",
    "GET /api/verifications/1/flow": "a view of the page", "DELETE disturbances": "`calm`", "DELETE disturbances/1": "`calm`",
    "GET comparisons": "`compare` gives what it came to", "PATCH traces/1": "a new trace is begun",
}  # fmt: skip
"""What the client has otherwise, or the page alone wants."""


def asked() -> Iterator[tuple[str, str]]:
    """Method and path of each request of the client, `1` for what is put into a path."""
    for file in sorted(FOLDER.glob("*.py")):
        for function in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(function, ast.FunctionDef):
                named = {
                    each.targets[0].id: each.value
                    for each in ast.walk(function)
                    if isinstance(each, ast.Assign) and isinstance(each.targets[0], ast.Name)
                }
                for call in ast.walk(function):
                    if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute):
                        yield from _request(call, call.func.attr, named)


def _request(call: ast.Call, name: str, named: Mapping[str, ast.expr]) -> Iterator[tuple[str, str]]:
    at = {"_get": 1, "_fetch": 0, "_send": 2, "_command": 0}.get(name)
    if at is None or len(call.args) <= at:
        return
    given = call.args[at]
    path = _text(named.get(given.id, given) if isinstance(given, ast.Name) else given)
    method = {"_get": "GET", "_fetch": "GET", "_command": "POST"}.get(name) or _text(call.args[1])
    if path is not None and method is not None:
        yield method, path if path.startswith("/") else f"/api/instances/1/{path}".rstrip("/")


def _text(node: ast.expr) -> str | None:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(str(each.value) if isinstance(each, ast.Constant) else "1" for each in node.values)
    return None


def test_each_route_of_a_plc_is_asked_for() -> None:
    paths: Mapping[str, Mapping[str, object]] = document()["paths"]  # type: ignore[assignment]
    there = {
        (method.upper(), re.sub(r"{\w+}", "1", path))
        for path, methods in paths.items()
        for method in methods
        if OF_A_PLC.match(re.sub(r"{\w+}", "1", path))
    }
    known = set(asked())
    left = {
        f"{method} {path.removeprefix('/api/instances/1/')}"
        for method, path in there - known
        if path.removeprefix("/api/instances/1/") not in APART
    }
    assert sorted(left - OTHERWISE.keys()) == []
    assert OTHERWISE.keys() - left == set()


def test_what_is_kept_of_verifications_and_logs(server: Server) -> None:
    server.instance("asked for all", "GENERIC-IEC", Main=SOURCE)
    plc = connect(server.address, user="Ann").plc("asked for all")
    plc.pause()
    plc.new_run()
    plc.run(scans=10)
    assert {"Main.n", "Main.doubled"} <= {each["path"] for each in plc.symbols("Main")}
    number = plc.begin_verification(2, 5, pou="Main", pace="scan")
    assert plc.stop_verification(number)["verdict"] == "nothing compared"
    assert plc.resume_verification(number)["state"] == "waiting"
    assert plc.drive_verification(number, auto=True)["auto"]
    assert plc.wait_for_verification(number)["verdict"] == "same"
    assert [each["name"] for each in plc.verification_uses(number, 3)][:2] == ["Main.n", "Main.n"]
    kept = plc.keep_verification(number, "nightly")["id"]
    assert [each["id"] for each in plc.kept_verifications] == [kept]
    assert plc.kept_rows(kept)["count"] == 4
    assert plc.export_kept(kept, "junit").startswith(b"<?xml")
    plc.delete_kept_verification(kept)
    assert plc.kept_verifications == []
    trace = plc.upload_trace(b"Scan,Main.n,Main.doubled\n1,1,2\n2,2,4\n", "line.csv")
    saved = plc.save_trace_mapping("line 3", trace["mapping"])
    assert [each["name"] for each in plc.trace_mappings] == ["line 3"]
    plc.delete_trace_mapping(saved["id"])
    assert plc.trace_mappings == []
    assert plc.campaigns == []


def test_what_the_simulator_of_errors_has(server: Server) -> None:
    server.instance("asked for its errors", "CJ1M-CPU63", Main=SOURCE)
    plc = connect(server.address, user="Ann").plc("asked for its errors")
    plc.run(scans=2)
    assert plc.preview("battery-error")
    assert plc.present == []  # it was only looked at
    state = plc.keep_state("a moment")
    before, after = (plc.wait_for_sweep(plc.begin_sweep(["battery-error"], [state], window=5))["id"] for _ in range(2))
    (cell,) = plc.sweep(after)["cells"]
    assert plc.sweep_reaction(after, cell["error"], cell["state"])["verdict"] == cell["verdict"]
    assert plc.accept_finding(after, cell["error"], cell["state"], "it has no battery")["reason"] == "it has no battery"
    plc.withdraw_finding(after, cell["error"], cell["state"])
    assert plc.compare_sweeps(before, after)
    plc.delete_sweep(before)
    with pytest.raises(Refused):
        plc.sweep(before)
    assert b"battery-error" in plc.test_record("csv")
    assert plc.history()
    assert plc.history_versions
    plc.serve("modbus", port=0)
    assert plc.break_line("modbus", kind="silent")
    (line,) = [each for each in plc.communication["servers"] if each["kind"] == "modbus"]
    assert line["fault"].get("kind") == "silent"
    plc.break_line("modbus")
