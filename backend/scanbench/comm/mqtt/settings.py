"""What of a PLC is published to which broker, as somebody sets it."""

import ssl
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import ClassVar

from scanbench.public import Public
from scanbench.wire.refused import Refused

MOST_VARIABLES = 500
_EVERY_MS = range(100, 60_001)
_PORTS = range(1, 1 << 16)
_LONGEST, _LONGEST_PEM = 200, 1 << 16
_WILD = "+#"
"""What stands for many topics in MQTT."""


@dataclass(frozen=True, slots=True)
class MqttWanted(Public):
    """Variables that are published, and the broker that gets them."""

    PUBLIC: ClassVar = "MqttSettings"

    on: bool = False
    host: str = "127.0.0.1"
    """Where the broker is: an address, or the name of a machine."""
    port: int = 1883
    sparkplug: bool = False
    """As an edge node of Sparkplug B; else each variable is a topic with JSON."""
    prefix: str = "scanbench"
    """Topics begin with it; of Sparkplug B it is the group."""
    every_ms: int = 1000
    """How often variables are read; those that changed are published."""
    variables: tuple[str, ...] = ()
    """Paths and addresses: `Main.level`, `D100`."""
    user: str = ""
    """That the broker knows; empty: it asks for none."""
    tls: bool = False
    """What is said is encrypted, and the broker shows a certificate that is for `host`."""
    ca: str = ""
    """The certificate of who signed that of the broker, in PEM; empty: one of those that the machine trusts."""

    def check(self) -> None:
        """`Refused` where this makes no sense."""
        if not self.host.strip() or len(self.host) > _LONGEST:
            raise Refused("the broker needs an address, or the name of a machine")
        if self.port not in _PORTS:
            raise Refused(f"port {self.port} is outside of {_PORTS[0]} to {_PORTS[-1]}")
        if self.every_ms not in _EVERY_MS:
            raise Refused(f"values are published every {_EVERY_MS[0]} to {_EVERY_MS[-1]} ms, not every {self.every_ms}")
        wrong = next((each for each in (_WILD + "/" if self.sparkplug else _WILD) if each in self.prefix), None)
        if wrong is not None:
            raise Refused(f"what topics begin with cannot have {wrong}")
        if not self.prefix.strip() or len(self.prefix) > _LONGEST:
            raise Refused("topics have to begin with something")
        if len(self.variables) > MOST_VARIABLES:
            raise Refused(f"{len(self.variables)} variables are too many: up to {MOST_VARIABLES} are published")
        twice = {each for each in self.variables if self.variables.count(each) > 1}
        if twice:
            raise Refused(f"{min(twice)} is there twice")
        if self.on and not self.variables:
            raise Refused("no variable is chosen that could be published")
        self._check_broker()

    def _check_broker(self) -> None:
        """How it knows us, and we know it."""
        if len(self.user) > _LONGEST:
            raise Refused(f"the name of a user has up to {_LONGEST} characters")
        if len(self.ca) > _LONGEST_PEM:
            raise Refused(f"a certificate has up to {_LONGEST_PEM} characters")
        if self.ca:
            tls_of(self.ca, None)


@dataclass(frozen=True, slots=True)
class MqttGiven(MqttWanted):
    """The same with what proves who we are, which is kept beside the token of the server and never told again."""

    PUBLIC: ClassVar = "MqttSettingsGiven"
    GIVEN: ClassVar = True

    password: str | None = field(default=None, repr=False)
    """Of the user; None: the one that is kept, which is forgotten when the broker becomes another one; empty: none."""
    identity: str | None = field(default=None, repr=False)
    """A certificate of the client and its key, both in PEM, the key without a password; None and empty as with the password."""

    def check(self) -> None:
        """`Refused` where this makes no sense."""
        MqttWanted.check(self)
        if len(self.password or "") > _LONGEST:
            raise Refused(f"a password has up to {_LONGEST} characters")
        if self.password and not self.user:
            raise Refused("a password needs the user that it is of")
        if len(self.identity or "") > _LONGEST_PEM:
            raise Refused(f"a certificate has up to {_LONGEST_PEM} characters")

    def without_secrets(self) -> MqttWanted:
        """What may be shown and kept anywhere."""
        return MqttWanted(**{each.name: getattr(self, each.name) for each in fields(MqttWanted)})


@dataclass(frozen=True, slots=True)
class Secrets:
    """What proves to a broker who we are."""

    password: str = field(default="", repr=False)
    identity: Path | None = None
    """A file with a certificate and its key."""


def tls_of(ca: str, identity: Path | None) -> ssl.SSLContext:
    """How the broker is known, and how it knows us; `Refused`."""
    try:
        context = ssl.create_default_context(cadata=ca or None)
    except (ssl.SSLError, ValueError):
        raise Refused(
            "what is given for the CA is no certificate in PEM: it begins with -----BEGIN CERTIFICATE-----"
        ) from None
    if identity is not None:
        try:
            context.load_cert_chain(identity, password="")
        except (ssl.SSLError, ValueError):
            raise Refused(
                "the certificate of the client has to be a certificate and the key that fits it, both in PEM, the key without a password"
            ) from None
    return context
