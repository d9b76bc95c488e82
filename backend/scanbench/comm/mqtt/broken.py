"""Why a broker cannot be published to, and what helps."""

import ssl

import aiomqtt
from paho.mqtt.reasoncodes import ReasonCode

from scanbench.comm.mqtt.settings import MqttWanted

_DENIED = (4, 5, 134, 135)
"""User or password are wrong, or not allowed: in MQTT 3.1.1, and as paho tells it."""
_NAMES = (62, 64)
"""Of OpenSSL: the certificate is of another name, of another address."""


def why(error: Exception, wanted: MqttWanted) -> str:
    """A sentence about what aiomqtt raised."""
    at, cause = f"{wanted.host}:{wanted.port}", error.__context__ or error
    if isinstance(error, aiomqtt.MqttCodeError) and _number(error.rc) in _DENIED:
        if not wanted.user:
            return f"the broker at {at} wants a user and a password: give them"
        return f"the broker at {at} refuses the user {wanted.user}: give the name and the password that it knows"
    if isinstance(cause, ssl.SSLCertVerificationError):
        if cause.verify_code in _NAMES:
            return f"the certificate of the broker at {at} is of another one: {cause.verify_message} Give the name that is in it as the address"
        return f"the certificate of the broker at {at} is not trusted: {cause.verify_message}. Give the certificate of the CA that signed it"
    if (
        wanted.tls
        and isinstance(cause, ssl.SSLError | ConnectionError)
        and not isinstance(cause, ConnectionRefusedError)
    ):
        return f"there is no TLS with the broker at {at}: {cause}. It may have another port for that (8883 is usual)"
    if isinstance(cause, TimeoutError):
        if wanted.tls:
            return f"the broker at {at} does not answer: it may want a certificate of the client"
        return f"the broker at {at} does not answer: it may want TLS"
    said = cause.strerror if isinstance(cause, OSError) else None
    return f"the broker at {at} cannot be reached: {said or error}"


def _number(code: int | ReasonCode | None) -> int | None:
    return code.value if isinstance(code, ReasonCode) else code
