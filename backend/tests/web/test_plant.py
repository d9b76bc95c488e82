"""A plant that is a server of Modbus which somebody else wrote: its values are inputs of a virtual PLC, in its run."""

from functools import partial
from pathlib import Path
from typing import Any

import pytest
from pymodbus.client import ModbusTcpClient

from scanbench.client import Refused, connect
from scanbench.client.shapes.communication import CommunicationPlant
from scanbench.recording.blocks import read_contents
from scanbench.recording.format import RunFile
from scanbench.runtime.write_areas import WriteAreas
from scanbench.wire.codec import ENTRIES
from tests.cli.calling import scanbench
from tests.web.foreign_plant import COILS, DISCRETE, HOLDING, INPUT, ForeignPlant
from tests.web.server import PATIENCE_S, Server
from tests.web.test_communication import break_line, switch_on, until

SOURCE = """
PROGRAM Main
VAR
  at_end AT CIO 0.03 : BOOL; weight AT D100 : INT; alive AT W0.00 : BOOL;
  motor AT CIO 100.01 : BOOL; speed AT D200 : INT; lost : INT; was : BOOL;
END_VAR
  IF was AND NOT alive THEN lost := lost + 1; END_IF;
  was := alive;
  motor := alive AND NOT at_end;
  speed := 2 * weight;
END_PROGRAM
"""
RANGES = [
    {"group": "discrete input", "first": 0, "count": 16, "address": "CIO0.00"},
    {"group": "input register", "first": 2, "count": 2, "address": "D100"},
    {"group": "coil", "first": 0, "count": 5, "address": "CIO100.00", "to": "plant"},
    {"group": "holding register", "first": 7, "count": 1, "address": "D200", "to": "plant"},
]


def exchange(server: Server, instance: int, port: int, **wanted: Any) -> Any:
    settings = {"port": port, "every_ms": 10, "answers": "W0.00", "ranges": RANGES, **wanted}
    return connect(server.address, user="Ada").plc(instance).exchange_with_plant(**settings)


def seen(server: Server, instance: int) -> CommunicationPlant:
    return connect(server.address).plc(instance).communication["plant"]


def test_a_plant_drives_inputs_is_lost_and_comes_back_and_the_run_replays_without_it(
    server: Server, tmp_path: Path
) -> None:
    instance = server.instance("plant", "CJ1M-CPU13", main=SOURCE)
    modbus = switch_on(server, instance, "modbus")
    with ForeignPlant() as plant, ModbusTcpClient("127.0.0.1", port=modbus, timeout=PATIENCE_S) as plc:

        def words(first: int, count: int = 1) -> list[int]:
            return list(plc.read_holding_registers(first, count=count).registers)

        def bit(number: int) -> bool:
            return bool(plc.read_coils(number, count=1).bits[0])

        exchange(server, instance, plant.port, lost="clear")
        plant.set(INPUT, 2, 21, 0xFFFD)
        until(lambda: words(100, 2) == [21, 0xFFFD])
        until(lambda: words(200) == [42] and plant.get(HOLDING, 7) == [42])
        until(lambda: bit(1601) and plant.get(COILS, 0, 3) == [0, 1, 0])
        plant.set(DISCRETE, 3, 1)
        until(lambda: bit(3) and plant.get(COILS, 1) == [0])
        told = seen(server, instance)
        assert told["answers"]
        assert told["trouble"] == ""
        assert told["exchanges"] > 0
        assert {each["text"] for each in told["frames"]} <= {
            "read discrete inputs 0, 16", "read input registers 2, 2", "write coils 0, 5", "write registers 7, 1",
        }  # fmt: skip

        plant.stop()
        until(lambda: not seen(server, instance)["answers"])
        until(lambda: words(100) == [0])
        assert not bit(3), "what inputs are to do was: 0"
        until(lambda: words(200) == [0])
        assert seen(server, instance)["trouble"] != ""
        name = f"Modbus plant 127.0.0.1:{plant.port}"
        with server.browser(instance) as browser:
            assert name not in [each["name"] for each in browser.hello["users"]], (
                "it does not answer, so it is not there"
            )

        plant.set(INPUT, 2, 22)
        plant.start()
        until(lambda: words(100) == [22] and plant.get(HOLDING, 7) == [44])
        with server.browser(instance) as browser:
            assert [each["client"] for each in browser.hello["users"] if each["name"] == name] == [True]
        log = server.http.get(f"/api/instances/{instance}/log?count=100").json()["lines"]
        told_of = [each["text"] for each in log if each["author"] == name and "the plant at" in each["text"]]
        assert ["does not answer" in each for each in told_of] == [False, True, False]
        exchange(server, instance, plant.port, on=False)
    replays_without(server, instance, name, tmp_path)


def test_faults_of_the_line_to_the_plant_are_raised_and_the_program_sees_them(server: Server) -> None:
    instance = server.instance("plant line", "CJ1M-CPU13", main=SOURCE)
    modbus = switch_on(server, instance, "modbus")
    with ForeignPlant() as plant, ModbusTcpClient("127.0.0.1", port=modbus, timeout=PATIENCE_S) as plc:
        plant.set(INPUT, 2, 21)
        exchange(server, instance, plant.port, lost="clear")

        def there(level: int) -> bool:
            """The program has this input, and what it makes of it."""
            return list(plc.read_holding_registers(100, count=1).registers) == [level] and list(
                plc.read_holding_registers(200, count=1).registers
            ) == [2 * level]

        for fault, why in (
            ("cut", "was cut"),
            ("refused", "nobody can connect"),
            ("silent", "no answer came within 2 s"),
        ):
            until(lambda: there(21) and seen(server, instance)["answers"])
            break_line(server, instance, "plant", fault)
            until(lambda: there(0))
            until(partial(says, server, instance, why))
            assert not plc.read_coils(ANSWERS, count=1).bits[0], "the program can tell"
            assert seen(server, instance)["fault"]["kind"] == fault
            break_line(server, instance, "plant", "none")
        break_line(server, instance, "plant", "late", 150)
        until(lambda: there(21) and seen(server, instance)["took_ms"] >= 150)
        exchange(server, instance, plant.port, on=False)
        exchange(server, instance, plant.port)
        until(lambda: seen(server, instance)["took_ms"] >= 150)  # it lasts
        wrong = server.http.put(f"/api/instances/{instance}/communication/plant/fault", json={"kind": "node"})
        assert "no node number" in wrong.json()["message"]
    log = server.http.get(f"/api/instances/{instance}/log?count=100").json()["lines"]
    told = [each["text"] for each in reversed(log) if each["text"].startswith("line of Modbus plant")]
    assert "line of Modbus plant: connections end" in told


def says(server: Server, instance: int, why: str) -> bool:
    return why in seen(server, instance)["trouble"]


ANSWERS = 3200
"""The coil of the first bit of work memory, which is on while the plant answers."""


def replays_without(server: Server, instance: int, name: str, folder: Path) -> None:
    run = folder / "run.scanrun"
    run.write_bytes(server.http.get(f"/api/instances/{instance}/export").content)
    file = RunFile.open(run, read_only=True)
    entries = [each.command for each in read_contents(file, ENTRIES).found.entries]
    file.close()
    authors = [each.author for each in entries if isinstance(each, WriteAreas)]
    assert set(authors) == {name}
    assert len(authors) < 12, "what is there already is not kept"
    replayed = scanbench("replay", str(run))
    assert replayed.returncode == 0, replayed.stderr


def test_settings_that_make_no_sense_are_refused_and_change_nothing(server: Server) -> None:
    instance = server.instance("no plant", "CJ1M-CPU13", main=SOURCE)
    with pytest.raises(Refused, match="range 1: a discrete input of a plant can only be read"):
        exchange(server, instance, 502, ranges=[{**RANGES[0], "to": "plant"}])
    assert seen(server, instance)["settings"]["ranges"] == []
