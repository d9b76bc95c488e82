"""What the log says of clients that write again and again: a line now and then, and always one about the last write."""

import pytest

from scanbench.runtime.command import Entry
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.session import tool_writes
from scanbench.session.tool_writes import ToolWrites
from tests.runtime.bench import plc

SECOND = 1_000_000_000


def test_the_last_write_is_told_when_the_client_is_quiet(monkeypatch: pytest.MonkeyPatch) -> None:
    resource = plc("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM", model_name="CJ1M-CPU13")
    now = 0
    monkeypatch.setattr(tool_writes, "monotonic_ns", lambda: now)
    writes = ToolWrites()

    def write(value: int) -> Entry:
        entry = resource.submit(WriteAreas("HMI", (AreaWrite("D", 200, bytes((value, 0))),)))
        assert isinstance(entry, Entry)
        return entry

    first, second, third = (write(value) for value in (1, 2, 3))
    assert writes.text(first) == first.plan.message
    assert (writes.text(second), writes.text(third), writes.due()) == (None, None, [])
    now = 4 * SECOND
    assert writes.due() == []
    now = 5 * SECOND
    assert writes.due() == [(third, f"{third.plan.message} (1 more writes before)")]
    assert writes.due() == []
    assert writes.text(write(4)) is None, "that was a line just now"
