"""Publishes chosen variables of a PLC: as topics with JSON, or as an edge node of Sparkplug B.

A connection is there while the PLC is: where the PLC goes, the broker is told its end, by ourselves or by the will that it keeps.
"""

import asyncio
import json
import logging
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass

import aiomqtt

from scanbench.comm.desk import Desk
from scanbench.comm.door import Away, Plc
from scanbench.comm.mqtt.broken import why
from scanbench.comm.mqtt.settings import MqttWanted, Secrets, tls_of
from scanbench.comm.mqtt.sparkplug import BIRTHS, REBIRTH, SEQUENCES, Broken, DataType, Metric, payload, wants_rebirth
from scanbench.comm.mqtt.values import Chosen, choose
from scanbench.runtime.clock import wall_time
from scanbench.wire.refused import Refused
from scanbench.wire.symbols import WatchItem
from scanbench.wire.variables import VariablesAre

log = logging.getLogger("scanbench.mqtt")
log.setLevel(logging.ERROR)  # a broker that is lost is told of where it is seen
AGAIN_S, PATIENCE_S = 1.0, 10.0
"""How long after a loss the broker, or the PLC, is tried again; how long an answer is waited for."""
_AT_ONCE = 50
"""Variables that are new to the PLC: each takes it some 40 us."""
_QUEUE, _LONGEST_ID = 64, 60


@dataclass(frozen=True, slots=True)
class _Values:
    """What was read, all of one scan."""

    told: VariablesAre
    pieces: list[bytes | None]


class Publisher:
    """Of one PLC, for as long as `run` runs. `tell` is given a sentence when the broker is found or lost."""

    def __init__(
        self, plc: Plc, wanted: MqttWanted, secrets: Secrets, desk: Desk, name: str, tell: Callable[[str], None]
    ) -> None:
        self._plc, self._wanted, self._secrets = plc, wanted, secrets
        self._desk, self._name, self._tell = desk, name, tell
        self._node = topic_name(plc.name)
        self._chosen: Chosen | None = None
        self._births = -1
        self._sequence = 0
        self.connected = False
        self.trouble = ""
        """Why nothing is published, or some of it is not; empty: nothing is wrong."""
        self.published = 0
        """Messages."""

    async def run(self) -> None:
        """Publishes for ever."""
        while True:
            try:
                values = await self._read()
                await self._talk(values)
            except (Away, Refused) as away:
                self._lost(str(away))
            except (aiomqtt.MqttError, OSError) as error:
                self._lost(why(error, self._wanted))
            await asyncio.sleep(AGAIN_S)

    def _lost(self, why: str) -> None:
        if self.connected:
            self._desk.leave(self._name)
            self._tell(f"nothing is published any more: {why}")
        self.connected, self.trouble = False, why

    # ---- what is read ---------------------------------------------------------------------------------------------

    async def _read(self) -> _Values:
        """The present values; `Away`. Where the program was changed, what can be published is found out again."""
        while True:
            chosen = self._chosen = self._chosen or await self._choose()
            told = await self._plc.variables(chosen.paths)
            if told.version == chosen.version and len(told.there) == len(chosen.paths):
                return _Values(told, chosen.pieces(told))
            self._chosen = None

    async def _choose(self) -> Chosen:
        """Of the program that runs now; where it was changed meanwhile, the next answer says so."""
        wanted, version = self._wanted.variables, 0
        found: list[WatchItem] = []
        for at in range(0, len(wanted), _AT_ONCE):
            some = await self._plc.describe(wanted[at : at + _AT_ONCE])
            version = some.version
            found += some.items
        return choose(version, found)

    # ---- one connection -------------------------------------------------------------------------------------------

    async def _talk(self, values: _Values) -> None:
        """Until the PLC is away, or the broker."""
        wanted = self._wanted
        self._births = (self._births + 1) % SEQUENCES
        async with self._client() as client:
            if not self.connected:
                self._desk.arrive(self._name)
                self._tell(f"the broker at {wanted.host}:{wanted.port} gets what is published")
            self.connected = True
            try:
                await self._publish_on(client, values)
            except (Away, asyncio.CancelledError):
                topic, told = self._end()
                with suppress(aiomqtt.MqttError, TimeoutError):
                    await client.publish(topic, told, qos=1, retain=not wanted.sparkplug, timeout=AGAIN_S)
                raise

    def _client(self) -> aiomqtt.Client:
        """`Refused` where what it is known by is none."""
        wanted, secrets = self._wanted, self._secrets
        return aiomqtt.Client(
            wanted.host, wanted.port, timeout=PATIENCE_S, max_queued_incoming_messages=_QUEUE, logger=log,
            identifier="-".join(("scanbench", self._node))[:_LONGEST_ID],
            will=aiomqtt.Will(*self._end(), qos=1, retain=not wanted.sparkplug),
            username=wanted.user or None, password=secrets.password or None,
            tls_context=tls_of(wanted.ca, secrets.identity) if wanted.tls else None,
        )  # fmt: skip

    async def _publish_on(self, client: aiomqtt.Client, values: _Values) -> None:
        wanted, loop = self._wanted, asyncio.get_running_loop()
        if wanted.sparkplug:
            await client.subscribe(self._topic("NCMD"), qos=1)
        await self._begin(client, values)
        commands = aiter(client.messages)
        due = loop.time()
        while True:
            due = max(due + wanted.every_ms / 1000, loop.time())
            if await self._asked_again(commands, due):
                await self._begin(client, values)
            before, chosen, values = values, self._chosen, await self._read()
            if self._chosen is not chosen:
                await self._begin(client, values)
                continue
            changed = [at for at, piece in enumerate(values.pieces) if piece != before.pieces[at]]
            if changed:
                await self._send(client, values, changed)

    async def _asked_again(self, commands: AsyncIterator[aiomqtt.Message], due: float) -> bool:
        """Waits for the moment `due`; whether a host of Sparkplug asked for everything."""
        try:
            async with asyncio.timeout_at(due):
                while True:
                    message = await anext(commands)
                    with suppress(Broken):
                        if wants_rebirth(message.payload):
                            return True
        except TimeoutError:
            return False

    # ---- messages -------------------------------------------------------------------------------------------------

    def _topic(self, kind: str) -> str:
        """Of Sparkplug."""
        return f"spBv1.0/{self._wanted.prefix}/{kind}/{self._node}"

    def _end(self) -> tuple[str, bytes]:
        """What tells that the PLC is gone."""
        if not self._wanted.sparkplug:
            return f"{self._wanted.prefix}/{self._node}/online", b"false"
        births = Metric(BIRTHS, DataType.UINT64, self._births)
        return self._topic("NDEATH"), payload(_now_ms(), [births], None)

    async def _begin(self, client: aiomqtt.Client, values: _Values) -> None:
        """Tells everything."""
        chosen = self._chosen
        assert chosen is not None
        self.trouble = chosen.trouble
        everything = range(len(values.pieces))
        if not self._wanted.sparkplug:
            await client.publish(f"{self._wanted.prefix}/{self._node}/online", b"true", qos=1, retain=True)
            await self._send(client, values, everything)
            return
        self._sequence = 0
        head = [Metric(BIRTHS, DataType.UINT64, self._births), Metric(REBIRTH, DataType.BOOLEAN, False)]
        await self._put(client, "NBIRTH", [*head, *self._metrics(chosen, values, everything)])

    async def _send(self, client: aiomqtt.Client, values: _Values, changed: Sequence[int]) -> None:
        chosen = self._chosen
        assert chosen is not None
        if self._wanted.sparkplug:
            self._sequence = (self._sequence + 1) % SEQUENCES
            await self._put(client, "NDATA", self._metrics(chosen, values, changed))
            return
        at = wall_time().isoformat()
        for number in changed:
            piece = values.pieces[number]
            value = None if piece is None else chosen.forms[number].json(piece)
            told = json.dumps({"v": value, "scan": values.told.scan, "t": at}, ensure_ascii=False).encode()
            topic = f"{self._wanted.prefix}/{self._node}/{topic_name(chosen.paths[number])}"
            await client.publish(topic, told, retain=True)
            self._note(topic, told)

    async def _put(self, client: aiomqtt.Client, kind: str, metrics: Sequence[Metric]) -> None:
        told = payload(_now_ms(), metrics, self._sequence)
        await client.publish(self._topic(kind), told)
        self._note(f"{self._topic(kind)}, {len(metrics)} values", told)

    def _metrics(self, chosen: Chosen, values: _Values, numbers: Sequence[int]) -> list[Metric]:
        found = []
        for number in numbers:
            form, piece = chosen.forms[number], values.pieces[number]
            found.append(Metric(chosen.paths[number], form.type, None if piece is None else form.read(piece)))
        return found

    def _note(self, text: str, told: bytes) -> None:
        self.published += 1
        self._desk.note(self._name, text, "", told, b"")


def topic_name(text: str) -> str:
    """A level of a topic: what has a meaning in topics is replaced."""
    return "".join("_" if each in "/+#\0" else each for each in text) or "_"


def _now_ms() -> int:
    return int(wall_time().timestamp() * 1000)
