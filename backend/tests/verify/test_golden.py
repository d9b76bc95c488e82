"""Golden files of controller logs and mappings: what was read once is read the same for ever. See docs/formats.md."""

import json
from pathlib import Path

import pytest

from scanbench.verify.trace.mapping import TraceMapping
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.table import Table

GOLDEN = Path(__file__).with_name("golden")
TABLES: dict[str, dict[str, object]] = json.loads((GOLDEN / "tables.json").read_text("utf-8"))


def told(table: Table) -> dict[str, object]:
    """What a log says."""
    return {
        "columns": list(table.columns), "rows": list(map(list, table.rows)), "numbers": list(table.numbers),
        "comma": table.comma,
    }  # fmt: skip


@pytest.mark.parametrize("name", TABLES)
def test_a_golden_log_says_what_it_said(name: str) -> None:
    assert told(read_trace((GOLDEN / name).read_bytes(), name)) == TABLES[name]


def test_a_golden_mapping_means_what_it_meant() -> None:
    mapping = TraceMapping.from_json((GOLDEN / "mapping.json").read_text("utf-8"))
    assert (mapping.axis, mapping.unit, mapping.gaps) == ("t [ms]", "ms", "hold")
    assert [(each.column, each.path, each.role) for each in mapping.columns] == [
        ("start", "Main.start", "input"), ("motor", "CIO100.00", "output"), ("remark", "", "ignore"),
    ]  # fmt: skip
