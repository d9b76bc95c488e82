"""Two virtual PLCs exchange data by their own instructions over FINS; one of them is switched off, and the other's program gets the error."""

from pathlib import Path

from tests.cli.calling import scanbench
from tests.web.server import Server
from tests.web.test_communication import fins, seen, until, words

ASKS = """
PROGRAM Main
VAR
  n : DINT; ready AT A202.07 : BOOL; failed AT A219.07 : BOOL; code AT A210 : WORD;
  sending AT A202.06 : BOOL;
END_VAR
  n := n + 1;
  IF n = 1 THEN
    %D300 := 2; %D301 := 0; %D302 := WORD#16#4E00; %D303 := WORD#16#0700; %D304 := 5;  (* RECV: 2 words of node 78, port 7, 0.5 s *)
    %D310 := 1; %D311 := 0; %D312 := WORD#16#4E00; %D313 := WORD#16#0600; %D314 := 5;  (* SEND: 1 word to node 78, port 6 *)
    %D320 := WORD#16#2; %D321 := 30; %D322 := 0; %D323 := WORD#16#4E00; %D324 := WORD#16#0500; %D325 := 5;
    %D400 := WORD#16#0601;  (* CMND: CPU Unit status read, port 5 *)
  END_IF;
  IF failed THEN %D50 := code; END_IF;
  IF ready THEN RECV(S := %D100, D := %D0, C := %D300); END_IF;
  IF sending THEN SEND(S := %D0, D := %D200, C := %D310); END_IF;
  IF n MOD 50 = 3 THEN CMND(S := %D400, D := %D60, C := %D320); END_IF;
END_PROGRAM
"""
OTHER = """
PROGRAM Main
VAR n : WORD; first AT D100 : WORD; second AT D101 : WORD; END_VAR
  first := 16#0042; second := 16#1234;
END_PROGRAM
"""


def at_node(server: Server, instance: int, node: int, on: bool = True) -> int:
    wanted = {"on": on, "host": "127.0.0.1", "port": 0, "access": "write", "node": node, "error_bits": False}
    reply = server.http.put(f"/api/instances/{instance}/communication/fins", json=wanted)
    assert reply.status_code == 200, reply.text
    return int(reply.json()["servers"][0]["address"].rpartition(":")[2]) if on else 0


def test_two_plcs_exchange_data_and_one_is_switched_off(server: Server, tmp_path: Path) -> None:
    one, other = server.instance("asks", "CJ1M-CPU13", main=ASKS), server.instance("answers", "CJ1M-CPU13", main=OTHER)
    at_node(server, server.instance("off", "CJ1M-CPU13", main=OTHER), 78, on=False)
    first, second = fins(at_node(server, one, 77)), fins(at_node(server, other, 78))
    until(lambda: words(first.memory_area_read("D0", 2)) == [0x42, 0x1234])
    until(lambda: words(second.memory_area_read("D200")) == [0x42])
    until(lambda: words(first.memory_area_read("D60", 2)) == [0x0601, 0])
    frames = seen(server, other, "fins")
    assert any(each["name"].startswith("FINS asks") and each["name"].endswith("node 77") for each in frames["clients"])
    until(lambda: any(each["text"] == "memory area read D100, 2" for each in seen(server, other, "fins")["frames"]))

    assert first.memory_area_write("D50", b"\0\0").code == b"\x00\x00"
    second.close()
    server.http.patch(f"/api/instances/{other}", json={"power": False}).raise_for_status()
    until(lambda: words(first.memory_area_read("D50")) == [0x0205])
    errors = server.http.get(f"/api/instances/{one}/errors").json()
    assert any("communications-port-7-error" in str(row) for row in errors), errors

    server.http.patch(f"/api/instances/{other}", json={"power": True}).raise_for_status()
    first.memory_area_write("D50", b"\0\0")
    first.memory_area_write("D0", b"\0\0\0\0")
    until(lambda: words(first.memory_area_read("D0", 2)) == [0x42, 0x1234])
    first.close()

    run = tmp_path / "run.scanrun"
    run.write_bytes(server.http.get(f"/api/instances/{one}/export").content)
    replayed = scanbench("replay", str(run))
    assert replayed.returncode == 0, replayed.stderr
