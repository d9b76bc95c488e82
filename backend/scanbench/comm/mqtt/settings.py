"""What of a PLC is published to which broker, as somebody sets it."""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.public import Public
from scanbench.wire.refused import Refused

MOST_VARIABLES = 500
_EVERY_MS = range(100, 60_001)
_PORTS = range(1, 1 << 16)
_LONGEST = 200
_WILD = "+#"
"""What stands for many topics in MQTT."""


@dataclass(frozen=True, slots=True)
class MqttWanted(Public):
    """Variables that are published, and the broker that gets them."""

    PUBLIC: ClassVar = "MqttSettings"
    GIVEN: ClassVar = True

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
