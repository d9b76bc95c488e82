"""Clients that somebody else wrote, at the servers of a virtual PLC: FINS and Modbus."""

import os
import signal
import socket
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fins import FinsClient  # type: ignore[import-untyped]
from fins.command import Command  # type: ignore[import-untyped]
from pymcprotocol import Type3E  # type: ignore[import-untyped]
from pymcprotocol.mcprotocolerror import MCProtocolError  # type: ignore[import-untyped]
from pymodbus.client import ModbusTcpClient
from pymodbus.exceptions import ConnectionException

from scanbench.comm.desk import ELSEWHERE, UNANSWERED
from scanbench.faults.line_faults import BreakLine, MendLine
from scanbench.recording.blocks import read_contents
from scanbench.recording.format import RunFile
from scanbench.runtime.write_areas import WriteAreas
from scanbench.wire.codec import ENTRIES
from tests.cli.calling import scanbench
from tests.web.server import PATIENCE_S, Server

MODEL = "CJ1M-CPU13"
SOURCE = """
PROGRAM Main
VAR level AT D100 : INT; twice AT D101 : INT; raised AT CIO 100.00 : BOOL; errors AT A400 : WORD; n : DINT; END_VAR
  n := n + 1; twice := 2 * level; raised := errors <> 0;
END_PROGRAM
"""
BATTERY = 0x00F7


def switch_on(server: Server, instance: int, kind: str, access: str = "write") -> int:
    wanted = {"on": True, "host": "127.0.0.1", "port": 0, "access": access, "node": 1}
    reply = server.http.put(f"/api/instances/{instance}/communication/{kind}", json=wanted)
    assert reply.status_code == 200, reply.text
    (seen,) = (each for each in reply.json()["servers"] if each["kind"] == kind)
    assert seen["listening"], seen
    return int(seen["address"].rpartition(":")[2])


def seen(server: Server, instance: int, kind: str) -> dict[str, Any]:
    reply = server.http.get(f"/api/instances/{instance}/communication").json()
    (found,) = (each for each in reply["servers"] if each["kind"] == kind)
    return dict(found)


def fins(port: int) -> FinsClient:
    client = FinsClient("127.0.0.1", port, timeout=PATIENCE_S)
    client.connect()
    return client


def words(response: Any) -> list[int]:
    assert response.code in (b"\x00\x00", b"\x00\x40"), response.code.hex()
    return [int.from_bytes(response.data[at : at + 2], "big") for at in range(0, len(response.data), 2)]


def until(found: Callable[[], bool]) -> None:
    """Asks again and again: each answer is of a later scan."""
    for _ in range(10_000):
        if found():
            return
    pytest.fail("it never came true")


def raise_battery_error(server: Server, instance: int) -> None:
    wanted = {"errors": [{"id": "battery-error"}]}
    server.http.post(f"/api/instances/{instance}/errors/generate", json=wanted).raise_for_status()


def recover_battery_error(server: Server, instance: int) -> None:
    wanted = {"ids": ["battery-error"]}
    server.http.post(f"/api/instances/{instance}/errors/recover", json=wanted).raise_for_status()


def test_other_rights_leave_any_port_as_it_is(server: Server) -> None:
    instance = server.instance("any-port", MODEL, main=SOURCE)
    port = switch_on(server, instance, "modbus", access="read")
    assert switch_on(server, instance, "modbus", access="write") == port
    assert seen(server, instance, "modbus")["settings"]["access"] == "write"


def test_a_fins_client_reads_writes_is_refused_and_sees_errors(server: Server) -> None:
    instance = server.instance("fins", MODEL, main=SOURCE)
    client = fins(switch_on(server, instance, "fins"))
    assert client.memory_area_write("D100", b"\x00\x15").code == b"\x00\x00"
    assert words(client.memory_area_read("D100")) == [21]
    until(lambda: words(client.memory_area_read("D100", 2)) == [21, 42])
    assert client.memory_area_write("A400", b"\x00\x01").code == b"\x21\x01"
    assert words(client.memory_area_read("A400")) == [0]

    raise_battery_error(server, instance)
    until(lambda: words(client.memory_area_read("A400")) == [BATTERY])
    assert client.memory_area_read("A400").code == b"\x00\x40", "a non-fatal error is told in each answer"
    until(lambda: client.memory_area_read("CIO100.00").data == b"\x01")
    recover_battery_error(server, instance)
    until(lambda: words(client.memory_area_read("A400")) == [0])
    assert client.memory_area_read("A400").code == b"\x00\x00"

    told = seen(server, instance, "fins")
    assert told["settings"]["error_bits"]
    assert [each["name"] for each in told["clients"]] == ["FINS 127.0.0.1, node 1"]
    assert told["clients"][0]["last_refused"] == "memory area write A400, 1: 2101 this memory is read-only"
    assert told["frames"][0]["text"] == "memory area write D100, 1"
    readers = server.http.get(f"/api/instances/{instance}/communication").json()["error_readers"]
    assert {"word": "A400", "clients": ["FINS 127.0.0.1, node 1"]} in readers
    log = server.http.get(f"/api/instances/{instance}/log?count=100").json()["lines"]
    assert [each["author"] for each in log if each["text"] == "D100 := 16#0015"] == ["FINS 127.0.0.1, node 1"]
    client.close()


def test_end_codes_tell_of_errors_unless_that_is_switched_off(server: Server) -> None:
    instance = server.instance("error bits", MODEL, main=SOURCE)
    wanted = {"on": True, "access": "write", "error_bits": False}
    told = server.http.put(f"/api/instances/{instance}/communication/fins", json=wanted).json()
    client = fins(int(told["servers"][0]["address"].rpartition(":")[2]))
    raise_battery_error(server, instance)
    until(lambda: words(client.memory_area_read("A400")) == [BATTERY])
    assert client.memory_area_read("A400").code == b"\x00\x00"
    client.close()


def test_fins_over_tcp_gives_nodes_and_answers_pieces_in_their_order(server: Server) -> None:
    instance = server.instance("fins tcp", MODEL, main=SOURCE)
    port = switch_on(server, instance, "fins")
    with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as sock:
        hello = bytes.fromhex("46494e530000000c000000000000000000000000")
        sock.sendall(hello[:7])
        sock.sendall(hello[7:])
        shaken = exactly(sock, 24)
        assert shaken[:16].hex() == "46494e53000000100000000100000000"
        node = shaken[19]
        assert 239 <= node <= 254
        frames = [
            bytes.fromhex("800002000100" + f"00{node:02x}00" + f"{sid:02x}" + "0101820064000001") for sid in (1, 2)
        ]
        message = b"".join(b"FINS" + (8 + len(each)).to_bytes(4, "big") + b"\0\0\0\2\0\0\0\0" + each for each in frames)
        sock.sendall(message)
        answers = [exactly(sock, 16 + 16) for _ in frames]
        assert [each[16 + 9] for each in answers] == [1, 2]
        sock.sendall(b"GET / HTTP/1.1\r\n\r\n")
        assert exactly(sock, 16).hex() == "46494e53000000080000000300000001"
        assert sock.recv(1) == b""


def exactly(sock: socket.socket, size: int) -> bytes:
    data = b""
    while len(data) < size:
        piece = sock.recv(size - len(data))
        assert piece, "the connection ended"
        data += piece
    return data


def test_a_modbus_client_reads_writes_and_cannot_write_errors(server: Server) -> None:
    instance = server.instance("modbus", MODEL, main=SOURCE)
    port = switch_on(server, instance, "modbus")
    with ModbusTcpClient("127.0.0.1", port=port, timeout=PATIENCE_S) as client:
        assert not client.write_registers(100, [7]).isError()
        assert client.read_holding_registers(100, count=1).registers == [7]
        until(lambda: client.read_holding_registers(100, count=2).registers == [7, 14])
        raise_battery_error(server, instance)
        until(lambda: client.read_input_registers(400, count=1).registers == [BATTERY])
        assert client.read_discrete_inputs(402 * 16 + 4, count=1).bits[0]
        until(lambda: bool(client.read_coils(100 * 16, count=1).bits[0]))
        recover_battery_error(server, instance)
        until(lambda: client.read_input_registers(400, count=1).registers == [0])
        assert not client.write_coil(16 * 200 + 3, True).isError()
        assert client.read_coils(16 * 200, count=4).bits[:4] == [False, False, False, True]
        assert client.read_holding_registers(32768, count=1).exception_code == 2
        assert client.read_holding_registers(0, count=1, device_id=9).exception_code == 11
        assert client.mask_write_register(address=100, and_mask=0xFFF0, or_mask=0x0005).isError() is False
        assert client.read_holding_registers(100, count=1).registers == [5]
        assert client.readwrite_registers(read_address=100, read_count=1, address=100, values=[9]).registers == [9]
        assert client.read_device_information().information[1] == MODEL.encode()
    table = server.http.get(f"/api/instances/{instance}/communication/modbus/map.csv").text.splitlines()
    assert table[1] == "coil,0,65535,CIO0.00,CIO4095.15,1"


@pytest.mark.parametrize("code", ["binary", "ascii"])
def test_an_slmp_client_at_a_melsec(server: Server, code: str) -> None:
    source = "PROGRAM Main\nVAR level AT D100 : INT; twice AT D101 : INT; n : INT; END_VAR\n n := n + 1; twice := 2 * level;\nEND_PROGRAM\n"
    instance = server.instance(f"slmp {code}", "Q03UD", main=source)
    port = switch_on(server, instance, "slmp")
    client = Type3E()
    client.setaccessopt(commtype=code, timer_sec=PATIENCE_S)
    client.connect("127.0.0.1", port)
    client.batchwrite_wordunits("D100", [21, -3])
    assert client.batchread_wordunits("D100", 1) == [21]
    until(lambda: client.batchread_wordunits("D100", 2) == [21, 42])
    client.batchwrite_bitunits("M5", [1, 0, 1])
    assert client.batchread_bitunits("M4", 5) == [0, 1, 0, 1, 0]
    assert client.batchread_wordunits("M0", 1) == [0xA0]
    client.randomwrite(["D200", "W1F"], [7, 8], ["D210"], [0x12345678])
    assert client.randomread(["D200", "W1F"], ["D210"]) == ([7, 8], [0x12345678])
    client.randomwrite_bitunits(["Y1F", "M100"], [1, 1])
    assert client.batchread_bitunits("Y1F", 1) == [1]
    assert client.read_cputype() == ("Q03UDCPU", "0268")
    assert client.echo_test("ABC12") == (5, "ABC12")
    with pytest.raises(MCProtocolError, match="C05B"):
        client.batchwrite_wordunits("SD0", [1])
    with pytest.raises(MCProtocolError, match="C056"):
        client.batchread_wordunits("D12288", 1)
    server.http.post(
        f"/api/instances/{instance}/errors/generate", json={"errors": [{"id": "battery-error"}]}
    ).raise_for_status()
    until(lambda: client.batchread_wordunits("SD0", 1) == [1600])
    recover_battery_error(server, instance)
    until(lambda: client.batchread_wordunits("SD0", 1) == [0])
    client.remote_stop()
    assert server.state(instance)["mode"] == "PROGRAM"
    client.remote_run(clear_mode=0)
    assert server.state(instance)["mode"] == "MONITOR"
    told = seen(server, instance, "slmp")
    assert (
        "batch write SD0, 1: C05B" in told["clients"][0]["last_refused"] or "C056" in told["clients"][0]["last_refused"]
    )
    break_line(server, instance, "slmp", "node")
    with pytest.raises(MCProtocolError, match="4B00"):
        client.batchread_wordunits("D100", 1)
    assert last_outcome(server, instance, "slmp") == f"4B00 {ELSEWHERE}"
    client.close()


def test_who_may_only_read_changes_nothing(server: Server) -> None:
    instance = server.instance("read only", MODEL, main=SOURCE)
    client = fins(switch_on(server, instance, "fins", "read"))
    assert client.memory_area_write("D100", b"\x00\x15").code == b"\x21\x02"
    assert client.stop().code == b"\x21\x02"
    assert words(client.memory_area_read("D100")) == [0]
    with ModbusTcpClient("127.0.0.1", port=switch_on(server, instance, "modbus", "read")) as modbus:
        assert modbus.write_register(100, 7).exception_code == 1
    assert server.state(instance)["mode"] == "MONITOR"
    client.close()


def test_modes_forces_and_the_clock_over_fins(server: Server) -> None:
    instance = server.instance("fins control", MODEL, main=SOURCE)
    client = fins(switch_on(server, instance, "fins"))
    assert client.stop().code == b"\x00\x00"
    assert server.state(instance)["mode"] == "PROGRAM"
    status = raw(client, "0601")
    assert (status[0], status[1]) == (0, 0)
    assert client.run().code == b"\x00\x00"
    assert raw(client, "0601")[:2] == b"\x01\x02"
    assert raw(client, "0702", "261128123456") == b""
    assert raw(client, "0701")[:4] == bytes.fromhex("26112812")

    def forced() -> list[str]:
        return [each["path"] for each in server.http.get(f"/api/instances/{instance}/forces").json()]

    assert raw(client, "2301", "0001" + "0001" + "30" + "0064" + "03") == b""
    assert forced() == ["CIO100.03"]
    assert client.memory_area_write("CIO100.03", b"\x00").code == b"\x00\x00", "a forced bit takes a write, and stays"
    assert client.memory_area_read("CIO100.03").data == b"\x01"
    assert raw(client, "0104", "70006403") == bytes.fromhex("7003")
    assert raw(client, "2302") == b""
    assert forced() == []
    client.close()


def raw(client: FinsClient, code: str, body: str = "") -> bytes:
    command = Command(bytes.fromhex(code), bytes.fromhex(body))
    response = client.send(command)
    assert response.code == b"\x00\x00", response.code.hex()
    return bytes(response.data)


def test_a_write_that_changes_nothing_is_not_kept_and_a_kill_loses_no_other(server: Server, tmp_path: Path) -> None:
    instance = server.instance("fins kept", MODEL, main=SOURCE)
    client = fins(switch_on(server, instance, "fins"))
    for _ in range(3):
        assert client.memory_area_write("D200", b"\x12\x34").code == b"\x00\x00"
    assert client.memory_area_write("D100", b"\x00\x05").code == b"\x00\x00"
    pid, restarts = server.state(instance)["pid"], server.state(instance)["restarts"]
    os.kill(pid, signal.SIGKILL)
    until(lambda: server.state(instance)["restarts"] > restarts and server.state(instance)["state"] == "running")
    until(lambda: client.memory_area_read("D200").code == b"\x00\x00")
    assert words(client.memory_area_read("D200")) == [0x1234]
    until(lambda: words(client.memory_area_read("D100", 2)) == [5, 10])
    client.close()
    run = tmp_path / "run.scanrun"
    run.write_bytes(server.http.get(f"/api/instances/{instance}/export").content)
    file = RunFile.open(run, read_only=True)
    entries = read_contents(file, ENTRIES).found.entries
    file.close()
    writes = [each.command for each in entries if isinstance(each.command, WriteAreas)]
    assert [each.author for each in writes] == ["FINS 127.0.0.1, node 1"] * 2
    replayed = scanbench("replay", str(run))
    assert replayed.returncode == 0, replayed.stderr


def break_line(server: Server, instance: int, kind: str, fault: str, late_ms: int = 1000) -> None:
    wanted = {"kind": fault, "late_ms": late_ms}
    server.http.put(f"/api/instances/{instance}/communication/{kind}/fault", json=wanted).raise_for_status()


def last_outcome(server: Server, instance: int, kind: str) -> str:
    """Of what was asked last."""
    found: str = max(seen(server, instance, kind)["frames"], key=lambda each: each["number"])["outcome"]
    return found


def test_two_plcs_have_the_same_port_at_addresses_of_their_own(server: Server) -> None:
    port = 0
    for number in (11, 12):  # of a client that cannot change its port
        instance = server.instance(f"at {number}", MODEL, main=SOURCE)
        wanted = {"on": True, "host": f"127.0.0.{number}", "port": port, "access": "write", "node": 1}
        server.http.put(f"/api/instances/{instance}/communication/fins", json=wanted).raise_for_status()
        host, _, at = seen(server, instance, "fins")["address"].rpartition(":")
        assert (host, int(at)) == (f"127.0.0.{number}", port or int(at))
        port = int(at)
    for number in (11, 12):
        client = FinsClient(f"127.0.0.{number}", port, timeout=PATIENCE_S)
        client.connect()
        assert client.memory_area_write("D100", bytes((0, number))).code == b"\0\0"
        assert words(client.memory_area_read("D100")) == [number]
        client.close()


def test_what_is_wrong_with_the_line_is_seen_by_clients(server: Server) -> None:
    instance = server.instance("line", MODEL, main=SOURCE)
    port = switch_on(server, instance, "fins")
    client = fins(port)
    assert words(client.memory_area_read("D100")) == [0]
    break_line(server, instance, "fins", "silent")
    client._socket.settimeout(0.2)
    with pytest.raises(TimeoutError):
        client.memory_area_write("D100", b"\x00\x07")
    assert last_outcome(server, instance, "fins") == UNANSWERED
    client._socket.settimeout(PATIENCE_S)
    break_line(server, instance, "fins", "late", 1)
    assert words(client.memory_area_read("D100")) == [7], "it was done, and nobody was told"
    break_line(server, instance, "fins", "node")
    assert client.memory_area_read("D100").code == b"\x02\x01"
    assert last_outcome(server, instance, "fins") == f"0201 {ELSEWHERE}"
    break_line(server, instance, "fins", "none")
    assert words(client.memory_area_read("D100")) == [7]
    client.close()

    sometimes = {"kind": "node", "scans": 30, "period": 60}
    server.http.put(f"/api/instances/{instance}/communication/fins/fault", json=sometimes).raise_for_status()
    client = fins(port)

    def answers(code: bytes) -> bool:
        """Asked once a while: the line answers by itself, without any scan, while nobody is at that node."""
        return bool(server.state(instance)) and client.memory_area_read("D100").code == code

    until(lambda: answers(b"\x02\x01"))
    until(lambda: answers(b"\x00\x00"))
    until(lambda: answers(b"\x02\x01"))
    break_line(server, instance, "fins", "none")
    until(lambda: answers(b"\x00\x00"))
    client.close()

    other = switch_on(server, instance, "modbus")
    with ModbusTcpClient("127.0.0.1", port=other, timeout=PATIENCE_S, retries=0) as modbus:
        assert modbus.read_holding_registers(100, count=1).registers == [7]
        break_line(server, instance, "modbus", "cut")
        with pytest.raises(ConnectionException):
            modbus.write_register(100, 9)
    break_line(server, instance, "modbus", "none")
    with ModbusTcpClient("127.0.0.1", port=other, timeout=PATIENCE_S, retries=0) as modbus:
        assert modbus.read_holding_registers(100, count=1).registers == [7], "it was not done"
    break_line(server, instance, "modbus", "refused")
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.1", other), PATIENCE_S)
    assert not seen(server, instance, "modbus")["listening"]
    assert seen(server, instance, "modbus")["fault"]["kind"] == "refused"
    break_line(server, instance, "modbus", "node")
    with ModbusTcpClient("127.0.0.1", port=other, timeout=PATIENCE_S, retries=0) as modbus:
        assert modbus.read_holding_registers(100, count=1, device_id=1).exception_code == 0x0B
    *before, frame = sorted(seen(server, instance, "modbus")["frames"], key=lambda each: each["number"])
    assert len(before) >= 2, "what was asked before the port was closed is still told"
    assert frame["outcome"] == f"0B {ELSEWHERE}", "the client asked the right unit"
    break_line(server, instance, "modbus", "none")
    with ModbusTcpClient("127.0.0.1", port=other) as modbus:
        assert modbus.read_holding_registers(100, count=1).registers == [7]


def test_a_fault_of_the_line_is_in_the_run_and_outlives_the_server(server: Server, tmp_path: Path) -> None:
    instance = server.instance("kept line", MODEL, main=SOURCE)
    port = switch_on(server, instance, "fins")
    with server.browser(instance) as browser:
        assert browser.hello["lines"]["broken"] == []
        break_line(server, instance, "fins", "node")
        told = browser.wait_for("lines")
        assert told["broken"][0]["server"] == "fins"
        assert told["broken"][0]["fault"]["kind"] == "node"
    client = fins(port)
    assert client.memory_area_read("D100").code == b"\x02\x01", "it is at a different node"
    client.close()
    port = switch_on(server, instance, "fins")
    client = fins(port)
    assert client.memory_area_read("D100").code == b"\x02\x01", "switched off and on it is still there"
    with server.browser(instance) as browser:
        log = browser.hello["log"]
        assert [each["kind"] for each in log if each["text"].startswith("line of FINS")] == ["error"]
        assert browser.ask(type="mend_line", server="fins")["ok"], "the command is the same wherever it comes from"
    until(lambda: words(client.memory_area_read("D100")) == [0])
    client.close()
    wrong = server.http.put(f"/api/instances/{instance}/communication/opcua/fault", json={"kind": "node"})
    assert "no node numbers" in wrong.json()["message"]
    run = tmp_path / "run.scanrun"
    run.write_bytes(server.http.get(f"/api/instances/{instance}/export").content)
    file = RunFile.open(run, read_only=True)
    commands = [each.command for each in read_contents(file, ENTRIES).found.entries]
    file.close()
    assert [type(each).__name__ for each in commands if isinstance(each, BreakLine | MendLine)] == [
        "BreakLine",
        "MendLine",
    ]
    assert scanbench("replay", str(run)).returncode == 0


def test_servers_that_cannot_be_say_why(server: Server) -> None:
    instance = server.instance("wrong", MODEL, main=SOURCE)
    at = f"/api/instances/{instance}/communication"
    for wanted, why in (
        ({"on": True, "host": "somewhere"}, "no IP address"),
        ({"on": True, "port": 70000}, "outside of 1 to 65535"),
        ({"on": True, "node": 0}, "outside of 1 to 254"),
    ):
        refused = server.http.put(f"{at}/fins", json=wanted)
        assert refused.status_code == 422
        assert why in refused.json()["message"]
    port = switch_on(server, instance, "fins")
    taken = server.http.put(f"{at}/modbus", json={"on": True, "port": port}).json()
    (modbus,) = (each for each in taken["servers"] if each["kind"] == "modbus")
    assert "cannot be listened on" in modbus["trouble"]
    generic = server.instance(
        "generic", "GENERIC-IEC", main="PROGRAM Main\nVAR n : INT; END_VAR\n n := n + 1;\nEND_PROGRAM\n"
    )
    refused = server.http.put(f"/api/instances/{generic}/communication/fins", json={"on": True})
    assert "does not speak FINS" in refused.json()["message"]


def test_a_project_has_a_map_of_modbus_of_its_own(server: Server) -> None:
    instance = server.instance("own map", MODEL, main=SOURCE)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    file = f"/api/projects/{project}/files/modbus.csv"
    port = switch_on(server, instance, "modbus")
    with ModbusTcpClient("127.0.0.1", port=port, timeout=PATIENCE_S) as client:
        assert client.read_holding_registers(5000, count=1).registers == [0]
        wrong = server.http.put(file, json={"text": "group,first,last,from\ncoil,0,1,D0\n", "version": 0})
        assert wrong.status_code == 422
        assert wrong.json()["message"].startswith("modbus.csv, line 2: a range begins at bit 0 of a word")
        text = "group,first,last,from\nholding register,0,1,D100\nholding register,2,2,A400\ndiscrete input,0,15,CIO100.00\n"
        saved = server.http.put(file, json={"text": text, "version": 0}).json()
        until(lambda: client.read_holding_registers(5000, count=1).isError())
        assert not client.write_registers(0, [21]).isError()
        until(lambda: client.read_holding_registers(0, count=2).registers == [21, 42])
        assert client.read_coils(0, count=1).exception_code == 2, "it has no coils"
        assert client.write_registers(1, [7, 0]).exception_code == 2, (
            "error memory is read-only, and nothing is written"
        )
        assert client.read_holding_registers(0, count=3).registers == [21, 42, 0]
        told = server.http.get(f"/api/instances/{instance}/communication").json()
        assert (told["own_map"], told["map_trouble"]) == (True, "")
        table = server.http.get(f"/api/instances/{instance}/communication/modbus/map.csv").text.splitlines()
        assert table[2] == "holding register,2,2,A400,A400,1"
        assert table[1::2] == ["holding register,0,1,D100,D101,1", "discrete input,0,15,CIO100.00,CIO100.15,1"]
        built = server.http.post(f"/api/projects/{project}/build", json={})
        assert built.status_code == 200, "a build leaves it out"
        deleted = server.http.delete(file, params={"version": saved["version"]})
        assert deleted.is_success, deleted.text
        until(lambda: not client.read_holding_registers(5000, count=1).isError())
