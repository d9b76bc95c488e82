"""The communication unit: servers of protocols, and a plant that is a server itself."""

from typing import Literal, Unpack

from scanbench.client.asking import Steps, asked, asked_value
from scanbench.client.requests.base import Asks
from scanbench.client.shapes import communication as shapes


class Communication(Asks):
    """Who is connected, and what is exchanged with whom."""

    @asked_value
    def communication(self) -> Steps[shapes.Communication]:
        """`servers` with their addresses, clients and last requests, `plant` and whether it answers, who reads `error_readers`."""
        return self._get(shapes.Communication, "communication")

    @asked
    def serve(
        self, kind: Literal["fins", "slmp", "modbus", "opcua"], **wanted: Unpack[shapes.CommunicationServerSettings]
    ) -> Steps[shapes.Communication]:
        """Switches the server of a protocol on with these settings: `serve("modbus", port=502, access="write")`; off with
        `on=False`."""
        return self._send(shapes.Communication, "PUT", f"communication/{kind}", {"on": True, **wanted})

    @asked
    def exchange_with_plant(self, **wanted: Unpack[shapes.PlantSettings]) -> Steps[shapes.Communication]:
        """Exchanges values with a plant that is a server of Modbus TCP: `host`, `port`, `unit`, `every_ms`, `lost`, `answers` and
        `ranges`; ends that with `on=False`."""
        return self._send(shapes.Communication, "PUT", "communication/plant", {"on": True, **wanted})

    @asked
    def break_line(
        self, line: Literal["fins", "slmp", "modbus", "opcua", "plant"], /, **fault: Unpack[shapes.CommunicationFault]
    ) -> Steps[shapes.Communication]:
        """Lets something be wrong with the line to the clients of a server or to the plant; without a fault, nothing any more."""
        return self._send(shapes.Communication, "PUT", f"communication/{line}/fault", fault)

    @asked
    def publish_by_mqtt(self, **wanted: Unpack[shapes.MqttSettingsGiven]) -> Steps[shapes.Communication]:
        """Publishes variables to a broker: `host`, `port`, `sparkplug`, `prefix`, `every_ms` and `variables`; `user`, `password`, `tls`,
        `ca` and `identity` where it wants them; ends that with `on=False`."""
        return self._send(shapes.Communication, "PUT", "communication/mqtt", {"on": True, **wanted})
