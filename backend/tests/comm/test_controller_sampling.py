"""Samples of a controller that is written to between two scans."""

import asyncio
from collections.abc import Sequence

from scanbench.comm.controller.contract import Connection, Found, Source
from scanbench.comm.controller.sampling import Sampler, Settling, taken

SETTLING = Settling(0, (1,))
Row = tuple[str, str, str]
"""Scan, input, output."""


class Scripted:
    """Answers these rows one after the other, and the last one for ever."""

    def __init__(self, *rows: Row) -> None:
        self.rows = list(rows)

    async def find(self) -> Found:
        return Found(("Scan", "level", "twice"))

    async def read(self, wanted: Sequence[int]) -> Sequence[str]:
        row = self.rows.pop(0) if len(self.rows) > 1 else self.rows[0]
        return [row[at] for at in wanted]

    async def close(self) -> None:
        pass


def samples(*rows: Row, most: int, settling: Settling | None = SETTLING) -> list[tuple[str, ...]]:
    async def opened(connection: Connection) -> Source:
        return Scripted(*rows)

    async def read() -> list[tuple[str, ...]]:
        sampler = Sampler(Connection("opc.tcp://127.0.0.1:4840", 10), opened, lambda _: None)
        await sampler.begin()
        first = await sampler.once(range(3))
        return [first.cells] + [each.cells async for each in taken(sampler, range(3), settling, most - 1)]

    return asyncio.run(read())


def test_a_sample_whose_input_was_written_after_its_scan_is_read_again_after_a_further_scan() -> None:
    before, torn, after = ("1", "30", "60"), ("4", "250", "60"), ("5", "250", "500")
    assert samples(before, torn, torn, after, most=2) == [before, after]
    assert samples(before, torn, torn, after, most=2, settling=None) == [before, torn]


def test_a_controller_that_is_written_to_while_it_runs_no_scan_gives_no_sample_until_it_does() -> None:
    before, torn, after = ("1", "30", "60"), ("4", "250", "60"), ("5", "250", "500")
    assert samples(before, *[torn] * 20, after, most=2) == [before, after]


def test_inputs_that_change_in_each_scan_are_taken_as_they_are() -> None:
    rows: list[Row] = [(str(at), str(at), str(2 * at)) for at in range(1, 20)]
    found = samples(*rows, most=3)
    assert len(found) == 3
    assert set(found) <= set(rows)
