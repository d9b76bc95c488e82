"""When who has subscribed is told: right after values were read, and no more often than wanted."""

import asyncio
from types import SimpleNamespace
from typing import cast

import pytest
from asyncua.server.subscription_service import SubscriptionService

from scanbench.comm.opcua.items import Publishing


class Subscription:
    def __init__(self, interval_ms: float, fails: bool = False) -> None:
        self.data = SimpleNamespace(RevisedPublishingInterval=interval_ms)
        self._triggered_datachanges = {1: ["a value"]}
        self.told, self.fails = 0, fails

    async def publish_results(self) -> bool:
        self.told += 1
        if self.fails:
            raise ConnectionError
        return True


def test_each_is_told_as_often_as_it_wants(caplog: pytest.LogCaptureFixture) -> None:
    fast, slow, broken, idle = Subscription(100), Subscription(1000), Subscription(100, fails=True), Subscription(100)
    idle._triggered_datachanges = {}
    service = SimpleNamespace(subscriptions={1: broken, 2: fast, 3: slow, 4: idle})
    publishing = Publishing(cast(SubscriptionService, service))

    async def story() -> None:
        for number in range(20):
            await publishing.sampled(5 + number * 0.1, 0.1)

    asyncio.run(story())
    assert (fast.told, slow.told, broken.told, idle.told) == (20, 2, 20, 0)
    assert len(caplog.records) == 20
