"""What is said of a broker that cannot be published to; what of it a real one shows is in `tests/web/test_mqtt_secure.py`."""

import aiomqtt
import pytest
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.reasoncodes import ReasonCode

from scanbench.comm.mqtt.broken import why
from scanbench.comm.mqtt.settings import MqttWanted


def raised(cause: Exception | None, text: str = "") -> aiomqtt.MqttError:
    """As aiomqtt does it."""
    error = aiomqtt.MqttError(text or str(cause))
    error.__context__ = cause
    return error


def denied(code: int) -> aiomqtt.MqttError:
    return aiomqtt.MqttCodeError(ReasonCode(PacketTypes.CONNACK, identifier=code))


@pytest.mark.parametrize(
    ("error", "wanted", "told"),
    [
        (denied(135), MqttWanted(), "the broker at 127.0.0.1:1883 wants a user and a password: give them"),
        (aiomqtt.MqttCodeError(5), MqttWanted(user="Ada"), "refuses the user Ada: give the name and the password"),
        (denied(136), MqttWanted(user="Ada"), "cannot be reached: [code:136] Server unavailable"),
        (raised(TimeoutError(), "Operation timed out"), MqttWanted(), "does not answer: it may want TLS"),
        (raised(TimeoutError()), MqttWanted(tls=True), "does not answer: it may want a certificate of the client"),
        (raised(ConnectionResetError(104, "reset")), MqttWanted(tls=True), "It may have another port for that"),
        (raised(ConnectionRefusedError(111, "refused")), MqttWanted(tls=True), "cannot be reached: refused"),
        (raised(None, "Disconnected"), MqttWanted(), "cannot be reached: Disconnected"),
    ],
)  # fmt: skip
def test_it_says_what_helps(error: aiomqtt.MqttError, wanted: MqttWanted, told: str) -> None:
    assert told in why(error, wanted)
