"""A controller that runs elsewhere as the control device: a second virtual PLC, and a server of OPC UA that is not ours."""

import asyncio
import json
import re
import threading
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from asyncua import Server as UaServer
from asyncua import ua
from lxml import etree

from scanbench.client import Plc, Refused, connect, verdict
from scanbench.client.shapes.verification import VerificationInfo
from tests.amounts import slow
from tests.cli.calling import scanbench
from tests.web.server import PATIENCE_S, Server
from tests.web.test_communication import MODEL
from tests.web.test_communication import switch_on as switch_on_fins
from tests.web.test_opcua import switch_on

RIGHT = """\
PROGRAM Main
VAR level AT D100 : INT; twice AT D101 : INT; high AT CIO 100.03 : BOOL; part : REAL; n : DINT; END_VAR
n := n + 1;
twice := level * 2;
high := level > 50;
part := INT_TO_REAL(level) / 3.0;
END_PROGRAM
"""
WRONG = RIGHT.replace("level * 2;", "level * 2 + BOOL_TO_INT(level > 200);")
"""Right up to 200."""
_NUMBERS = count()


@pytest.fixture
def plc(server: Server) -> Plc:
    """The one whose program is the reference."""
    name = f"reference {next(_NUMBERS)}"
    server.instance(name, MODEL, Main=RIGHT)
    return connect(server.address, user="Ann").plc(name)


def until(server: Server, plc: Plc, number: int, holds: Callable[[VerificationInfo], bool]) -> VerificationInfo:
    """What a verification says as soon as that holds; it tells whenever it goes on."""
    found = [plc.verification(number)]
    with server.browser(plc.id) as browser:

        def there() -> bool:
            found[0] = plc.verification(number)
            assert found[0]["state"] != "failed" or holds(found[0]), found[0]["message"]
            return holds(found[0])

        browser.wait(there)
    return found[0]


def test_a_second_plc_is_verified_while_it_runs_and_its_fault_is_found(server: Server, plc: Plc) -> None:
    name = f"controller {next(_NUMBERS)}"
    address = switch_on(server, server.instance(name, MODEL, Main=WRONG))
    controller = connect(server.address, user="Ann").plc(name)
    controller.write("Main.level", 30)
    found = plc.connect_controller(address, interval_ms=50)
    assert {"Main.level", "Main.twice", "Main.high", "Main.part", "Main.n", "Scan"} <= set(found["columns"])
    roles = {each["column"]: each["role"] for each in found["mapping"]["columns"]}
    assert (roles["Main.level"], roles["Main.twice"], roles["Main.n"], roles["Stopped"]) == (
        "input",
        "output",
        "output",
        "ignore",
    )
    assert (found["mapping"]["axis"], found["mapping"]["unit"]) == ("Scan", "scan")
    number = plc.begin_trace_verification(found)
    goes = until(server, plc, number, lambda info: info["compared"] > 20)
    assert (goes["state"], goes["differing"], goes["last"], goes["trace"]) == ("verifying", 0, None, address)
    assert "Sampled every 50 ms" in goes["message"]
    assert verdict(goes) == "same in what was compared"  # it goes on
    stopped = plc.stop_verification(number)
    told = json.loads(plc.export_verification(number, "json"))
    assert (verdict(stopped), told["verdict"], told["same"]) == ("same", "same", True)  # as the command says
    server.http.patch(f"/api/verifications/{number}", json={"action": "resume"})
    controller.write("Main.level", 250)
    bad = until(server, plc, number, lambda info: info["differing"] > 0)
    assert bad["first_difference"] is not None
    assert bad["first_difference"]["message"].startswith("Main.twice is 501, the reference gives 500, at Main.st:4")
    assert bad["coverage"] is not None
    counts = {each["path"]: each["differing"] for each in bad["coverage"]["outputs"]}
    assert counts["Main.n"] == counts["Main.high"] == counts["Main.part"] == 0
    assert plc.verification_rows(number, differing=True)["rows"][0]["differences"][0]["cause"] == "logic"
    refused = server.http.patch(f"/api/verifications/{number}", json={"pace": "scan"})
    assert (refused.status_code, "free pace only" in refused.text) == (422, True)
    plc.delete_verification(number)


class Foreign:
    """A server of asyncua in a thread of its own, with the variables of a controller."""

    def __init__(self) -> None:
        self.loop = asyncio.new_event_loop()
        self.port = 0
        self.server: UaServer | None = None
        self.nodes: dict[str, Any] = {}
        self._thread = threading.Thread(target=self.loop.run_forever)
        self._thread.start()

    def do(self, work: Any) -> Any:
        return asyncio.run_coroutine_threadsafe(work, self.loop).result(PATIENCE_S)

    def start(self, **values: tuple[object, ua.VariantType]) -> str:
        """Its address; the same one each time."""

        async def begin() -> None:
            server = self.server = UaServer()
            await server.init()
            server.set_endpoint(f"opc.tcp://127.0.0.1:{self.port}/plc")
            index = await server.register_namespace("urn:controller")
            folder = await server.nodes.objects.add_folder(index, "Application")
            for name, (value, type) in values.items():
                id = ua.NodeId(f"Application.PLC_PRG.{name}", index)  # type: ignore[arg-type]
                self.nodes[name] = await folder.add_variable(id, name, value, type)
            await server.start()
            assert server.bserver is not None
            self.port = server.bserver.port = server.bserver._server.sockets[0].getsockname()[1]  # type: ignore[union-attr]

        self.do(begin())
        return f"opc.tcp://127.0.0.1:{self.port}/plc"

    def write(self, name: str, value: object, type: ua.VariantType) -> None:
        self.do(self.nodes[name].write_value(value, type))

    def stop(self) -> None:
        if self.server is not None:
            self.do(self.server.stop())
            self.server = None

    def close(self) -> None:
        self.stop()
        self.loop.call_soon_threadsafe(self.loop.stop)
        self._thread.join()
        self.loop.close()


@pytest.fixture
def foreign() -> Iterator[Foreign]:
    made = Foreign()
    yield made
    made.close()


SHORT, SINGLE, BOOL = ua.VariantType.Int16, ua.VariantType.Float, ua.VariantType.Boolean
GOOD = {"level": (40, SHORT), "twice": (80, SHORT), "high": (False, BOOL), "part": (40 / 3, SINGLE)}


@slow
def test_a_foreign_controller_is_mapped_by_its_names_and_goes_on_after_a_lost_connection(
    server: Server, plc: Plc, foreign: Foreign
) -> None:
    address = foreign.start(**GOOD)
    found = plc.connect_controller(address, interval_ms=20)
    paths = {each["column"]: each["path"] for each in found["mapping"]["columns"]}
    assert paths["Application.PLC_PRG.level"] == "Main.level"
    assert paths["Application.PLC_PRG.high"] == "Main.high"
    assert found["mapping"]["unit"] == "ms"
    number = plc.begin_trace_verification(found)
    until(server, plc, number, lambda info: info["compared"] > 10)
    running = plc.verification(number)
    assert server.http.patch(f"/api/verifications/{number}", json={"action": "stop"}).status_code == 200
    assert server.http.patch(f"/api/verifications/{number}", json={"action": "resume"}).status_code == 200
    again = until(server, plc, number, lambda info: info["compared"] > running["compared"] + 30)
    assert (again["skipped"] > running["skipped"], again["differing"]) == (True, 0)
    foreign.stop()
    away = until(server, plc, number, lambda info: "tried again" in info["message"])
    assert (away["state"], away["differing"]) == ("verifying", 0)
    foreign.start(level=(7, SHORT), twice=(14, SHORT), high=(False, BOOL), part=(7 / 3, SINGLE))
    back = until(server, plc, number, lambda info: info["compared"] > away["compared"] + 5)
    assert ("tried again" in back["message"], back["differing"]) == (False, 0)
    assert back["skipped"] > away["skipped"]
    foreign.write("twice", 15, SHORT)
    bad = until(server, plc, number, lambda info: info["differing"] > 0)
    assert bad["first_difference"] is not None
    assert "Main.twice is 15, the reference gives 14" in bad["first_difference"]["message"]
    foreign.stop()
    foreign.start(level=("seven", ua.VariantType.String), twice=(14, SHORT), high=(False, BOOL), part=(7 / 3, SINGLE))
    over = until(server, plc, number, lambda info: info["state"] == "failed")
    assert "Main.level" in over["message"]
    assert "`'seven'`" in over["message"]


def test_what_cannot_be_read_is_said_before_anything_begins(server: Server, plc: Plc, foreign: Foreign) -> None:
    with pytest.raises(Refused, match=r"no address of a controller: write opc\.tcp://HOST:4840"):
        plc.connect_controller("192.168.1.10")
    address = foreign.start(level=("high", ua.VariantType.String), twice=(80, SHORT), list=([1, 2], SHORT))
    with pytest.raises(Refused, match="ns=2;s=nowhere: BadNodeIdUnknown"):
        plc.connect_controller(address, nodes=["ns=2;s=nowhere"])
    with pytest.raises(Refused, match="`level` is no id of a node"):
        plc.connect_controller(address, nodes=["level"])
    with pytest.raises(Refused, match="has no single value"):
        plc.connect_controller(address, nodes=["ns=2;s=Application.PLC_PRG.list"])
    found = plc.connect_controller(address)
    assert found["left_out"] == ["Arrays and structures (1): name the nodes of their elements."]
    for each in found["mapping"]["columns"]:
        if each["column"].endswith("level"):
            each["path"], each["role"] = "Main.level", "input"
    with pytest.raises(Refused, match=r"does not fit the program.*`'high'`"):
        plc.begin_trace_verification(found)
    foreign.stop()
    address = foreign.start(**GOOD)
    slow = plc.connect_controller(address, interval_ms=60_000)
    with pytest.raises(Refused, match=r"interval of 60,000 ms: choose one of at most 50,000 ms"):
        plc.begin_trace_verification(slow)
    foreign.stop()
    with pytest.raises(Refused, match="nothing listens at"):
        plc.connect_controller(address)


def verified(folder: Path) -> tuple[str, ...]:
    """The command up to the address, for the right program."""
    (folder / "Main.st").write_text(RIGHT)
    return ("verify", str(folder / "Main.st"), "--model", MODEL, "--every", "50", "--controller")


def test_the_command_reads_a_second_plc_by_opc_ua(server: Server, tmp_path: Path) -> None:
    name = f"controller {next(_NUMBERS)}"
    address = switch_on(server, server.instance(name, MODEL, Main=WRONG))
    controller = connect(server.address, user="Ann").plc(name)
    controller.write("Main.level", 31)
    given = (*verified(tmp_path), address, "--samples", "20")
    right = scanbench(*given, "--json")
    assert right.returncode == 0, right
    told = json.loads(right.stdout)
    assert (told["same"], told["verdict"], told["compared"] > 15, told["trace"]) == (True, "same", True, address)
    assert {"Main.twice", "Main.high", "Main.part", "Main.n"} <= {
        each["variable"] for each in told["coverage"]["outputs"]
    }
    controller.write("Main.level", 250)
    wrong = scanbench(*given, "--junit", str(tmp_path / "report.xml"))
    assert wrong.returncode == 1, wrong
    assert "Main.twice is 501, the reference gives 500" in wrong.stdout
    cases = etree.parse(tmp_path / "report.xml").findall(".//testcase")
    failed = {str(each.get("name")) for each in cases if each.find("failure") is not None}
    assert (failed - {"the whole scan: no difference"}, len(cases) > 4) == ({"output Main.twice"}, True)
    nobody = scanbench(*given[:-3], "opc.tcp://127.0.0.1:1", "--samples", "2")
    assert (nobody.returncode, "opc.tcp://127.0.0.1:1" in nobody.stderr) == (2, True), nobody


@slow
def test_the_command_reads_a_foreign_controller_by_opc_ua(foreign: Foreign, tmp_path: Path) -> None:
    given = (*verified(tmp_path), foreign.start(**GOOD), "--samples", "20")
    right = scanbench(*given)
    assert right.returncode == 0, right
    foreign.write("twice", 81, SHORT)
    wrong = scanbench(*given)
    assert wrong.returncode == 1, wrong
    assert "Main.twice is 81, the reference gives 80" in wrong.stdout


def test_a_controller_is_read_by_fins_at_the_addresses_of_the_program(server: Server, plc: Plc, tmp_path: Path) -> None:
    name = f"controller {next(_NUMBERS)}"
    port = switch_on_fins(server, server.instance(name, MODEL, Main=WRONG), "fins", "read")
    controller = connect(server.address, user="Ann").plc(name)
    controller.write("Main.level", 30)
    found = plc.connect_controller(f"fins://127.0.0.1:{port}", interval_ms=50)
    assert set(found["columns"]) == {"time [ms]", "Main.level", "Main.twice", "Main.high"}
    number = plc.begin_trace_verification(found)
    goes = until(server, plc, number, lambda info: info["compared"] > 20)
    assert (goes["state"], goes["differing"]) == ("verifying", 0)
    controller.write("Main.level", -7)  # words have no sign of their own
    until(server, plc, number, lambda info: info["compared"] > goes["compared"] + 20 and info["differing"] == 0)
    controller.write("Main.level", 250)
    bad = until(server, plc, number, lambda info: info["differing"] > 0)
    assert bad["first_difference"] is not None
    # What is read between the write and the scan after it has the new level and the old result: -14.
    assert re.match(r"Main\.twice is (501|-14), the reference gives 500", bad["first_difference"]["message"])
    plc.delete_verification(number)
    given = (*verified(tmp_path), f"fins://127.0.0.1:{port}")
    wrong = scanbench(*given, "--samples", "20")
    assert wrong.returncode == 1, wrong
    assert "Main.twice is 501, the reference gives 500" in wrong.stdout
    controller.write("Main.level", 31)
    right = scanbench(*given, "--samples", "20", "--json")
    assert right.returncode == 0, right
    told = json.loads(right.stdout)
    assert (told["same"], told["compared"] > 15, told["trace"]) == (True, True, f"fins://127.0.0.1:{port}")
    tcp = (*given[:-1], f"fins+tcp://127.0.0.1:{port}", "--samples", "20")
    over = scanbench(*tcp, "--json")
    assert over.returncode == 0, over
    assert json.loads(over.stdout)["compared"] > 15
    controller.write("Main.level", 250)
    assert "Main.twice is 501, the reference gives 500" in scanbench(*tcp).stdout
    for nowhere in ("fins://127.0.0.1:1", "fins+tcp://127.0.0.1:1"):
        nobody = scanbench(*given[:-1], nowhere, "--samples", "2")
        assert (nobody.returncode, f"{nowhere} cannot be reached" in nobody.stderr) == (2, True), nobody
    for nodes, why in (
        (["D100:TEXT"], "`D100:TEXT` is nothing that is read by FINS"),
        (["D99999"], "FINS has no word 99,999"),
        (["D40000"], "refuses to read D40000"),
        (["a=D1", "A=D2"], "two of what is to be read have the same name"),
    ):
        with pytest.raises(Refused, match=why):
            plc.connect_controller(f"fins://127.0.0.1:{port}", nodes=nodes)
