"""Commands of Sparkplug B from anybody: broken ones are known as such, and nothing else is raised."""

import pytest

from bench.broken_frames import mutated
from scanbench.comm.mqtt.sparkplug import REBIRTH, Broken, DataType, Metric, payload, wants_rebirth
from tests.amounts import amount, nightly

COMMANDS = [
    payload(1, [Metric(REBIRTH, DataType.BOOLEAN, True)], None),
    payload(1, [Metric("Node Control/Reboot", DataType.BOOLEAN, True), Metric("x", DataType.INT16, -5)], 7),
    payload(1, [Metric("text", DataType.STRING, "ポンプ"), Metric("none", DataType.DOUBLE, None)], 255),
]


def test_who_asks_for_everything_is_understood() -> None:
    assert [wants_rebirth(each) for each in COMMANDS] == [True, False, False]
    assert not wants_rebirth(payload(1, [Metric(REBIRTH, DataType.BOOLEAN, False)], None))
    assert not wants_rebirth(b"")
    with pytest.raises(Broken):
        wants_rebirth(b"\xff\xff\xff\xff")


@nightly
def test_broken_commands_harm_nobody() -> None:
    asked = broken = 0
    for each in mutated(COMMANDS, amount(100_000, 2_000), seed=7):
        try:
            asked += wants_rebirth(each)
        except Broken:
            broken += 1
    assert asked
    assert broken
