"""Rows of a verification in the parent: bounded, paged, replaced."""

from dataclasses import replace

import pytest

from scanbench.server import verify_rows
from scanbench.server.verify_rows import Rows
from scanbench.verify.contract import Column, Mismatch, Output, Row
from scanbench.wire.codec import pack_body
from scanbench.wire.verification import PackedRow, ScansVerified

A = Column("speed", "INT", "int", 2)


def packed(scan: int, differs: bool = False, value: int = 0) -> PackedRow:
    wrong = Mismatch("logic", "speed", b"\1\0", b"\2\0", None, "speed is 1, the reference gives 2")
    outputs = {"speed": Output(bytes((value, 0)), b"\0\0")}
    row = Row("pass", scan, 1, outputs=outputs, differences=(wrong,) if differs else ())
    return PackedRow(scan, 1, 0, wrong if differs else None, pack_body(row))


def came(*rows: PackedRow) -> ScansVerified:
    return ScansVerified(1, rows[-1].scan, len(rows), rows, (A,), (), ("speed",), 3)


def test_pages_and_those_that_differ() -> None:
    rows = Rows()
    rows.add(came(*(packed(scan, scan % 10 == 3) for scan in range(50))))
    page = rows.page(10, 5, differing=False)
    assert [(row.index, row.scan) for row in page.rows] == [(index, index) for index in range(10, 15)]
    assert (page.count, page.first, page.columns) == (50, 0, (replace(A, output=True),))
    assert page.differing == (3, 13, 23, 33, 43)
    assert [row.index for row in rows.page(4, 2, differing=True).rows] == [13, 23]
    assert rows.page(50, 5, differing=False).rows == ()


def test_a_row_is_replaced_by_scan_and_call() -> None:
    rows = Rows()
    rows.add(came(packed(1), packed(2), packed(3)))
    rows.replace(came(packed(2, value=9)))
    assert [row.outputs["speed"].control for row in rows.all()] == [b"\0\0", b"\x09\0", b"\0\0"]
    assert rows.bytes == sum(len(each.data) for each in rows.kept)


def test_the_oldest_are_forgotten_and_indices_stay(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(verify_rows, "MOST_ROWS", 20)
    rows = Rows()
    for scan in range(0, 100, 10):
        rows.add(came(*(packed(each, each % 10 == 3) for each in range(scan, scan + 10))))
    assert (rows.first, rows.count, len(rows.kept)) == (80, 100, 20)
    assert rows.differing == [*range(3, 100, 10)]  # these outlive the equal ones
    assert [row.scan for row in rows.page(0, 3, differing=True).rows] == [3, 13, 23]
    assert [row.scan for row in rows.all()][:10] == [3, 13, 23, 33, 43, 53, 63, 73, 80, 81]
    again = Rows.of(rows.packed())
    assert (again.differing, again.first, again.count) == (rows.differing, 80, 100)
    rows.replace(came(packed(13, differs=True, value=9)))
    assert [row.outputs["speed"].control for row in rows.page(13, 1, differing=True).rows] == [b"\x09\0"]
    assert [row.scan for row in rows.page(0, 3, differing=False).rows] == [80, 81, 82]
    monkeypatch.setattr(verify_rows, "MOST_BYTES", 5 * len(packed(1).data))
    rows.add(came(packed(100)))
    assert rows.count == 101
    assert len(rows.kept) <= 5
