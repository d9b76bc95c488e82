"""The device's own view of its errors, as the host of one PLC told of it last."""

from collections.abc import Callable

from scanbench.faults.device_shapes import DeviceErrors
from scanbench.session.instance import Instance
from scanbench.wire import events
from scanbench.wire.events import Event
from scanbench.wire.host import DeviceIs, WantDevice


class Device:
    """What a tool would read from the PLC's error memory."""

    def __init__(self, instance: Instance, publish: Callable[[Event], None]) -> None:
        self._instance, self._publish = instance, publish
        self.known: DeviceErrors | None = None
        """None until the PLC was there once."""

    async def now(self) -> DeviceErrors:
        """At the scan that is shown; `Unavailable` while the PLC is not there: then nobody can read its memory."""
        return (await self._instance.ask(WantDevice, DeviceIs)).found

    def on_message(self, message: object) -> bool:
        """What the host says; whether it was about this."""
        if not isinstance(message, DeviceIs):
            return False
        self.known = message.found
        self._publish(events.DeviceChanged(message.found))
        return True
