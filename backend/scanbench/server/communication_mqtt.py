"""What of a PLC is published by MQTT: how it is set, who publishes it, and what people see of it."""

import asyncio
import logging
from collections.abc import Callable

from scanbench.comm.desk import Desk
from scanbench.comm.mqtt.publisher import Publisher
from scanbench.comm.mqtt.settings import MqttGiven, MqttWanted, Secrets
from scanbench.server.communication_door import ErrorReaders, SessionDoor
from scanbench.server.communication_plc import SessionPlc
from scanbench.server.communication_shapes import MqttSeen
from scanbench.server.mqtt_secrets import MqttSecrets
from scanbench.session.session import Session
from scanbench.typed import BadValue, make_kept

log = logging.getLogger("scanbench")


class Mqtt:
    """Of one PLC. `on_clients` is called when something comes to be published, or no more."""

    def __init__(
        self,
        session: Session,
        readers: ErrorReaders,
        secrets: MqttSecrets,
        kept: object,
        on_clients: Callable[[], None],
    ) -> None:
        self._session, self._readers, self._on_clients = session, readers, on_clients
        self._files, self._secrets = secrets, Secrets()
        self.wanted = _read(kept)
        self.desk: Desk | None = None
        """None while it is off."""
        self._publisher: Publisher | None = None
        self._task: asyncio.Task[None] | None = None

    @property
    def seen(self) -> MqttSeen:
        """As it is now."""
        made, desk, secrets = self._publisher, self.desk, self._secrets
        proofs = bool(secrets.password), secrets.identity is not None
        if made is None or desk is None:
            return MqttSeen(self.wanted, *proofs, False, "", 0, 0.0, ())
        return MqttSeen(
            self.wanted, *proofs, made.connected, made.trouble, made.published, desk.per_second, desk.frames
        )

    async def set(self, given: MqttGiven) -> None:
        """Other settings, which were checked. `Refused`: the certificate of the client is none."""
        wanted = given.without_secrets()
        password, identity = given.password, given.identity
        if not _same_broker(
            wanted, self.wanted
        ):  # who may set this must not learn a secret by calling a broker of their own
            password, identity = password or "", identity or ""
        await asyncio.to_thread(self._files.keep, password if wanted.user else "", identity)
        await self.end()
        self.wanted = wanted
        await self.begin()

    async def forget(self) -> None:
        """The PLC is deleted."""
        await asyncio.to_thread(self._files.forget)

    async def begin(self) -> None:
        """Publishes, if that is wanted."""
        wanted = self.wanted
        self._secrets = await asyncio.to_thread(self._files.read)
        if not wanted.on:
            return
        name = f"MQTT {wanted.host}:{wanted.port}"
        self.desk = Desk(lambda author: SessionDoor(self._session, author, self._readers), self._on_clients, True)
        self._publisher = Publisher(
            SessionPlc(self._session), wanted, self._secrets, self.desk, name,
            lambda text: self._session.log.add(name, text, "system"),
        )  # fmt: skip
        self._task = asyncio.get_running_loop().create_task(_run(self._publisher, name))

    async def end(self) -> None:
        """Nothing is published any more."""
        task, self._task = self._task, None
        self._publisher, self.desk = None, None
        if task is not None:
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)
            self._on_clients()


def _same_broker(one: MqttWanted, other: MqttWanted) -> bool:
    return (one.host, one.port, one.tls, one.ca) == (other.host, other.port, other.tls, other.ca)


async def _run(publisher: Publisher, name: str) -> None:
    try:
        await publisher.run()
    except Exception:
        publisher.trouble = "nothing is published any more: see the log of the server"
        log.exception("%s: values could not be published", name)


def _read(kept: object) -> MqttWanted:
    """What was kept; what cannot be understood is off."""
    if not isinstance(kept, dict):
        return MqttWanted()
    try:
        return make_kept(MqttWanted, kept)
    except BadValue as error:
        log.error("the settings of what is published cannot be read: %s", error)
        return MqttWanted()
