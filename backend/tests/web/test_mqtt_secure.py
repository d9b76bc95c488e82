"""Publishing to a mosquitto that wants TLS, a user with a password, and a certificate of the client; and what a wrong one of each gives."""

import json
import queue
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import paho.mqtt.client as mqtt
import pytest
from paho.mqtt.enums import CallbackAPIVersion

from scanbench.client import Refused
from tests.web.certificates import Made, made
from tests.web.server import PATIENCE_S, Server
from tests.web.test_communication import MODEL, until
from tests.web.test_mqtt import broker, publish, seen

SOURCE = "PROGRAM Main VAR level AT D100 : INT := 7; END_VAR END_PROGRAM"
PASSWORD = "open sesame: 開けゴマ"


class Guarded:
    """A broker with all of it, and what it knows its clients by."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.ca = folder, made("A CA")
        self.client = made("a client", self.ca)
        for name, text in self._files(made("a broker", self.ca)).items():
            (folder / name).write_text(text)
        (folder / "users").touch(0o600)
        subprocess.run(["mosquitto_passwd", "-b", folder / "users", "Ada", PASSWORD], check=True, capture_output=True)

    def _files(self, own: Made) -> dict[str, str]:
        return {"ca.pem": self.ca.pem, "broker.pem": own.pem, "broker.key": own.key, "client.pem": self.identity}

    @property
    def identity(self) -> str:
        return self.client.pem + self.client.key

    @contextmanager
    def running(self) -> Iterator[int]:
        lines = {
            "allow_anonymous": "false", "password_file": self.folder / "users", "cafile": self.folder / "ca.pem",
            "certfile": self.folder / "broker.pem", "keyfile": self.folder / "broker.key", "require_certificate": "true",
            "user": "root",
        }  # fmt: skip
        with broker(self.folder, settings="".join(f"{name} {value}\n" for name, value in lines.items())) as port:
            yield port

    def first(self, port: int, topic: str) -> Any:
        """What is kept at a topic, as paho reads it."""
        client = mqtt.Client(CallbackAPIVersion.VERSION2)
        client.tls_set(str(self.folder / "ca.pem"), str(self.folder / "client.pem"), str(self.folder / "client.pem"))
        client.username_pw_set("Ada", PASSWORD)
        found: queue.Queue[bytes] = queue.Queue()
        client.on_connect = lambda client, *_: client.subscribe(topic, qos=1)
        client.on_message = lambda _client, _data, message: found.put(bytes(message.payload))
        client.connect("127.0.0.1", port)
        client.loop_start()
        try:
            return json.loads(found.get(timeout=PATIENCE_S))
        finally:
            client.disconnect()
            client.loop_stop()


def test_a_broker_that_wants_proofs_gets_them_and_nobody_else_does(server: Server, tmp_path: Path) -> None:
    instance = server.instance("secure mqtt", MODEL, main=SOURCE)
    name = server.http.get(f"/api/instances/{instance}").json()["name"]
    guarded = Guarded(tmp_path)
    with guarded.running() as port:
        at: dict[str, Any] = {
            "port": port,
            "variables": ["Main.level"],
            "tls": True,
            "user": "Ada",
            "ca": guarded.ca.pem,
        }

        def told(**wanted: Any) -> str:
            publish(server, instance, **{**at, **wanted})
            until(lambda: seen(server, instance)["trouble"] != "")
            return seen(server, instance)["trouble"]

        whole: dict[str, Any] = {"password": PASSWORD, "identity": guarded.identity}
        publish(server, instance, **at, **whole)
        until(lambda: seen(server, instance)["connected"])
        assert guarded.first(port, f"scanbench/{name}/Main.level")["v"] == 7
        assert (seen(server, instance)["password"], seen(server, instance)["identity"]) == (True, True)

        publish(server, instance, **at, every_ms=200)
        until(lambda: seen(server, instance)["connected"])  # what is kept goes on to hold
        assert told(password="wrong") == (
            f"the broker at 127.0.0.1:{port} refuses the user Ada: give the name and the password that it knows"
        )
        other = told(**whole, ca=made("Another CA").pem)
        assert other.startswith(f"the certificate of the broker at 127.0.0.1:{port} is not trusted: ")
        assert other.endswith("Give the certificate of the CA that signed it")
        assert told(**whole, host="localhost").endswith("Give the name that is in it as the address")

        publish(server, instance, **{**at, "port": 1})
        kept = seen(server, instance)
        assert (kept["password"], kept["identity"]) == (False, False), (
            "another broker does not get the secrets of this one"
        )
        publish(server, instance, **{**at, **whole, "on": False})
    _nowhere_but_in_its_files(server, instance, guarded)


def _nowhere_but_in_its_files(server: Server, instance: int, guarded: Guarded) -> None:
    files = [path for path in server.data.rglob("*") if path.is_file()]
    with_secrets = [
        path
        for path in files
        if PASSWORD.encode() in path.read_bytes() or guarded.client.key.encode()[60:120] in path.read_bytes()
    ]
    assert {path.relative_to(server.data).as_posix() for path in with_secrets} == {
        f"mqtt/{instance}.password",
        f"mqtt/{instance}.pem",
    }
    assert {path.stat().st_mode & 0o777 for path in with_secrets} == {0o600}
    for asked in ("communication", "log"):
        answer = server.http.get(f"/api/instances/{instance}/{asked}").text
        assert "sesame" not in answer
        assert "PRIVATE KEY" not in answer
    server.http.delete(f"/api/instances/{instance}").raise_for_status()
    assert not any(path.exists() for path in with_secrets)


def test_what_is_no_proof_is_refused_and_not_told_again(server: Server) -> None:
    instance = server.instance("no proofs", MODEL, main=SOURCE)
    client = made("a client")

    def refused(**wanted: Any) -> str:
        with pytest.raises(Refused) as found:
            publish(server, instance, 1, variables=["Main.level"], **wanted)
        return str(found.value)

    assert "no certificate in PEM" in refused(ca="nothing of the kind")
    assert "the key that fits it" in refused(identity=client.pem)
    assert "the key that fits it" in refused(identity=client.pem + made("another one").key)
    assert "a password needs the user" in refused(password=PASSWORD)
    long = refused(user="Ada", password="sesame" * 100)
    assert "up to 200 characters" in long
    assert "sesame" not in long
    sent = {"variables": ["Main.level"], "password": ["sesame"]}
    answer = server.http.put(f"/api/instances/{instance}/communication/mqtt", json=sent)
    assert answer.status_code == 422
    assert "sesame" not in answer.text
    assert not seen(server, instance)["settings"]["on"]
