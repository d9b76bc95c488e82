"""Programs that everybody has, at the servers of a virtual PLC: nmap and mbpoll."""

import os
import subprocess

from pymodbus.client import ModbusTcpClient

from tests.web.server import PATIENCE_S, Server
from tests.web.test_communication import (
    BATTERY,
    MODEL,
    SOURCE,
    raise_battery_error,
    recover_battery_error,
    switch_on,
    until,
)


def test_programs_that_everybody_has_find_the_plc(server: Server) -> None:
    """nmap's `omron-info` and `modbus-discover`, and mbpoll."""
    instance = server.instance("tools", MODEL, main=SOURCE)
    port, other = switch_on(server, instance, "fins"), switch_on(server, instance, "modbus")
    script = ["nmap", "-n", "-Pn", "-p", str(port), "--script", "+omron-info", "127.0.0.1"]
    assert "Controller Model: CJ1M_CPU13" in said(*script)
    if os.geteuid() == 0:  # scans of UDP need raw sockets
        assert "Controller Version: 04.10" in said(*script[:3], "-sU", *script[3:])
    discover = said("nmap", "-n", "-Pn", "-p", str(other), "--script", "+modbus-discover", "127.0.0.1")
    assert f"Scanbench {MODEL}" in discover, discover
    poll = ["mbpoll", "-m", "tcp", "-p", str(other), "-r", "101", "-1", "-q", "127.0.0.1"]
    said(*poll, "42")
    assert "[101]: \t42" in said(*poll, "-t", "4")
    error = ["mbpoll", "-m", "tcp", "-p", str(other), "-r", "401", "-1", "-q", "-t", "3", "127.0.0.1"]
    raise_battery_error(server, instance)
    until(lambda: f"[401]: \t{BATTERY}" in said(*error))
    recover_battery_error(server, instance)
    until(lambda: "[401]: \t0" in said(*error))
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    own = {"text": "group,first,last,from\nholding register,0,0,A400\ncoil,0,15,CIO200.00\n", "version": 0}
    server.http.put(f"/api/projects/{project}/files/modbus.csv", json=own).raise_for_status()
    clear = ["mbpoll", "-m", "tcp", "-p", str(other), "-r", "1", "-1", "-q", "-t", "4", "127.0.0.1", "0"]
    until(lambda: "Illegal data address" in refused(*clear))  # error memory is read-only, however it is mapped
    said("mbpoll", "-m", "tcp", "-p", str(other), "-r", "5", "-1", "-q", "-t", "0", "127.0.0.1", "1")
    assert client_reads(other, 4)


def said(*command: str) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def refused(*command: str) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout + done.stderr


def client_reads(port: int, coil: int) -> bool:
    with ModbusTcpClient("127.0.0.1", port=port, timeout=PATIENCE_S) as client:
        return bool(client.read_coils(coil, count=1).bits[0])
