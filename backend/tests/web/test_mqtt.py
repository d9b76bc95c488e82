"""Variables that a virtual PLC publishes to mosquitto, and what a client of paho and protobuf make of it."""

import json
import queue
import socket
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, cast

import paho.mqtt.client as mqtt
import pytest
from paho.mqtt.enums import CallbackAPIVersion

from scanbench.client import Refused, connect
from scanbench.client.shapes.communication import CommunicationMqtt
from tests.amounts import slow
from tests.web.server import PATIENCE_S, Server
from tests.web.sparkplug_host import read, rebirth
from tests.web.test_communication import MODEL, until

SOURCE = """
TYPE Colour : (RED, GREEN := 5, BLUE); END_TYPE
TYPE Tank : STRUCT level : INT; full : BOOL; END_STRUCT END_TYPE
PROGRAM Main
VAR
  level AT D100 : INT := -5; lamp AT CIO 100.03 : BOOL; ratio : REAL := 1.5; big : ULINT := 18446744073709551615; small : DINT := -7;
  span : TIME := T#1s500ms; day : DATE := D#2026-11-28; name : STRING := 'pump'; wide : WSTRING := "ポンプ"; colour : Colour := BLUE; tank : Tank;
  speed : INT(0..500) := 250;
END_VAR
END_PROGRAM
"""
PATHS = ["level", "lamp", "ratio", "big", "small", "span", "day", "name", "wide", "colour", "speed", "tank.full"]
VALUES = [-5, False, 1.5, 2**64 - 1, -7, 1500.0, "2026-11-28T00:00:00+00:00", "pump", "ポンプ", "BLUE", 250, False]


@contextmanager
def broker(folder: Path, port: int = 0, settings: str = "allow_anonymous true\n") -> Iterator[int]:
    """mosquitto, at a port of its own."""
    if not port:
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
    config = folder / "mosquitto.conf"
    config.write_text(f"listener {port} 127.0.0.1\n{settings}")
    process = subprocess.Popen(["/usr/sbin/mosquitto", "-c", config], stderr=subprocess.DEVNULL)

    def answers() -> bool:
        with socket.socket() as there:
            return there.connect_ex(("127.0.0.1", port)) == 0

    try:
        until(answers)
        yield port
    finally:
        process.terminate()
        process.wait(PATIENCE_S)


class Host:
    """A client that has subscribed to everything."""

    def __init__(self, port: int) -> None:
        self.told: queue.Queue[mqtt.MQTTMessage] = queue.Queue()
        self.client = mqtt.Client(CallbackAPIVersion.VERSION2)
        self.client.on_message = lambda _client, _data, message: self.told.put(message)
        self.client.on_connect = lambda client, *_: client.subscribe("#", qos=1)
        self.client.connect("127.0.0.1", port)
        self.client.loop_start()

    def __enter__(self) -> "Host":
        return self

    def __exit__(self, *_: object) -> None:
        self.client.disconnect()
        self.client.loop_stop()

    def next(self, topic: str, fits: Callable[[bytes], bool] = lambda _: True) -> bytes:
        """The next message of a topic that fits."""
        while True:
            message = self.told.get(timeout=PATIENCE_S)
            if message.topic == topic and fits(bytes(message.payload)):
                return bytes(message.payload)


def publish(server: Server, instance: int, port: int, **wanted: Any) -> None:
    plc = connect(server.address, user="Ada").plc(instance)
    settings = {"port": port, "every_ms": 100, "variables": [f"Main.{each}" for each in PATHS], **wanted}
    plc.publish_by_mqtt(**cast(Any, settings))


def seen(server: Server, instance: int) -> CommunicationMqtt:
    return connect(server.address).plc(instance).communication["mqtt"]


def power(server: Server, instance: int, on: bool) -> None:
    server.http.patch(f"/api/instances/{instance}", json={"power": on}).raise_for_status()


def test_values_are_published_as_json_and_what_changes_again(server: Server, tmp_path: Path) -> None:
    instance = server.instance("mqtt", MODEL, main=SOURCE)
    name = server.http.get(f"/api/instances/{instance}").json()["name"]
    plc = connect(server.address, user="Ada").plc(instance)
    with broker(tmp_path) as port, Host(port) as host:
        publish(server, instance, port, variables=[*(f"Main.{each}" for each in PATHS), "Main.tank", "D100"])
        found = {each: json.loads(host.next(f"scanbench/{name}/Main.{each}")) for each in PATHS}
        assert [each["v"] for each in found.values()] == VALUES
        assert len({each["scan"] for each in found.values()}) == 1, "all of one scan"
        assert json.loads(host.next(f"scanbench/{name}/D100"))["v"] == 2**16 - 5
        until(lambda: seen(server, instance)["connected"])
        assert "Main.tank has no single value" in seen(server, instance)["trouble"]
        plc.write("Main.level", 42)
        assert json.loads(host.next(f"scanbench/{name}/Main.level"))["v"] == 42
        with server.browser(instance) as browser:
            assert f"MQTT 127.0.0.1:{port}" in [each["name"] for each in browser.hello["users"]]

        with Host(port) as late:
            assert json.loads(late.next(f"scanbench/{name}/Main.name"))["v"] == "pump", "who comes later is told, too"
        with Host(port) as late:
            assert late.next(f"scanbench/{name}/online") == b"true"
        power(server, instance, on=False)
        host.next(f"scanbench/{name}/online", lambda told: told == b"false")
        until(lambda: not seen(server, instance)["connected"])
        power(server, instance, on=True)
        host.next(f"scanbench/{name}/online", lambda told: told == b"true")
    until(lambda: "cannot be reached" in seen(server, instance)["trouble"])
    with broker(tmp_path, port), Host(port) as host:
        host.next(f"scanbench/{name}/Main.ratio")
        publish(server, instance, port, on=False)
        host.next(f"scanbench/{name}/online", lambda told: told == b"false")
    with pytest.raises(Refused, match="cannot have #"):
        publish(server, instance, port, prefix="a/#")
    with pytest.raises(Refused, match="no variable is chosen"):
        publish(server, instance, port, variables=[])


def test_a_plc_is_an_edge_node_of_sparkplug_b(server: Server, tmp_path: Path) -> None:
    instance = server.instance("sparkplug", MODEL, main=SOURCE)
    name = server.http.get(f"/api/instances/{instance}").json()["name"]
    plc = connect(server.address, user="Ada").plc(instance)

    def topic(kind: str) -> str:
        return f"spBv1.0/Plant/{kind}/{name}"

    with broker(tmp_path) as port, Host(port) as host:
        publish(server, instance, port, sparkplug=True, prefix="Plant")
        birth = read(host.next(topic("NBIRTH")))
        assert birth.sequence == 0
        assert (birth.values["bdSeq"], birth.values["Node Control/Rebirth"]) == (0, False)
        told = [birth.values[f"Main.{each}"] for each in PATHS]
        assert told == [_MIDNIGHT_MS if value == VALUES[6] else value for value in VALUES]
        assert [birth.types[f"Main.{each}"] for each in PATHS] == [2, 11, 9, 8, 3, 10, 13, 12, 12, 12, 2, 11]

        plc.write("Main.level", 42)
        data = read(host.next(topic("NDATA")))
        assert (data.values, data.sequence) == ({"Main.level": 42}, 1)

        host.client.publish(topic("NCMD"), b"\xff\xff\xff\xff")  # no payload at all
        host.client.publish(topic("NCMD"), rebirth())
        birth = read(host.next(topic("NBIRTH")))
        assert (birth.values["Main.level"], birth.sequence) == (42, 0)

        power(server, instance, on=False)
        death = read(host.next(topic("NDEATH")))
        assert (death.values, death.sequence) == ({"bdSeq": 0}, None)
        power(server, instance, on=True)
        assert read(host.next(topic("NBIRTH"))).values["bdSeq"] == 1
        publish(server, instance, port, on=False)
        host.next(topic("NDEATH"))


_MIDNIGHT_MS = 1795824000000
"""2026-11-28."""


@slow
def test_what_is_published_is_so_again_after_a_restart(tmp_path: Path) -> None:
    with broker(tmp_path) as port:
        with Server(tmp_path / "data") as server:
            instance = server.instance("kept mqtt", MODEL, main=SOURCE)
            publish(server, instance, port)
            until(lambda: seen(server, instance)["connected"])
        with Server(tmp_path / "data") as again, Host(port) as host:
            name = again.http.get(f"/api/instances/{instance}").json()["name"]
            host.next(f"scanbench/{name}/online", lambda told: told == b"true")
            assert seen(again, instance)["settings"]["variables"] == [f"Main.{each}" for each in PATHS]
