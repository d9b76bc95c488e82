"""Files as the tools of vendors write them: read without editing, mapped by themselves, and judged rightly."""

import random
from collections.abc import Sequence
from dataclasses import replace

import pytest

from scanbench.symbols.symbols import resolve
from scanbench.verify.contract import Row
from scanbench.verify.ranges import parse_range
from scanbench.verify.trace import rounding
from scanbench.verify.trace.bind import check
from scanbench.verify.trace.propose import Proposal, propose
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.subject import TraceSubject
from scanbench.verify.trace.table import BadTraceFile, Table
from scanbench.verify.verifier import Verifier
from tests.amounts import amount, nightly
from tests.verify.vendor_files import FILES, SCANS, SIGNALS, WRONG, Recorded, clean, faulty, lines, program

NAMES = list(FILES)


def table_of(name: str, recorded: Recorded) -> Table:
    return read_trace(FILES[name](recorded), name)


def verified(table: Table, last: int = SCANS) -> list[tuple[int, tuple[Row, ...]]]:
    """The rows of each scan, counted from the first, up to `last`."""
    found = check(table, propose(table, program()).mapping, program())
    assert found.trace is not None, found.problems
    assert not found.problems
    verifier = Verifier(TraceSubject(program(), found.trace))
    verifier.begin(parse_range(""))
    return [
        (scan - verifier.first, verifier.verify(scan).rows)
        for scan in range(verifier.first, min(verifier.end, verifier.first + last + 1))
    ]


def differences(scans: Sequence[tuple[int, tuple[Row, ...]]]) -> list[tuple[int, str]]:
    return [(scan, each.name) for scan, rows in scans for row in rows for each in row.differences]


def mapped(made: Proposal) -> dict[str, str]:
    return {each.column: each.path for each in made.mapping.columns if each.path}


def _place(path: str) -> tuple[int, int | None]:
    symbol = resolve(program(), path)
    return symbol.offset, symbol.bit


def test_there_are_ten_of_them() -> None:
    assert len(FILES) >= 10


@pytest.mark.parametrize("name", NAMES)
def test_it_is_read_and_mapped_without_anybody(name: str) -> None:
    table = table_of(name, clean())
    assert table.layout
    assert len(table.rows) == SCANS
    found = {_place(path) for path in mapped(propose(table, program())).values()}
    wanted = {_place(f"Main.{each}") for each in SIGNALS}
    assert len(found & wanted) >= 0.9 * len(wanted)
    assert found <= wanted


@nightly
@pytest.mark.parametrize("name", NAMES)
def test_a_clean_trace_with_jitter_and_rounding_has_no_difference(name: str) -> None:
    scans = verified(table_of(name, clean()), amount(SCANS, SCANS // 2))
    assert differences(scans) == []
    assert [scan for scan, rows in scans if not any(row.compared for row in rows)] == [0]  # it is taken over


@pytest.mark.parametrize(
    ("name", "signal"),
    [(name, ("motor", "level", "status", "error")[at % 4]) for at, name in enumerate(NAMES)],
)
def test_a_planted_fault_is_found_at_its_scan_and_variable(name: str, signal: str) -> None:
    assert differences(verified(table_of(name, faulty(signal)), WRONG))[0] == (WRONG, f"Main.{signal}")


def test_rounded_numbers_alone_differ_without_the_runs_at_their_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rounding, "MOST_RANKS", 0)
    assert len(differences(verified(table_of("twincat.csv", clean()), 50))) > 20


def test_a_small_fault_that_adds_up_is_found_in_spite_of_rounding() -> None:
    """The controller's integrator gains 0.4 % too much: less than one digit a scan."""
    recorded = clean()
    levels, raised = list(recorded.values["level"]), 0.0
    for row in recorded.rows():
        raised += float(recorded.values["raw"][row]) * 0.0137 * 0.004 if row else 0.0
        levels[row] = str(float(levels[row]) + raised)
    errors = [str(40.0 - float(each)) for each in levels]
    values = {**recorded.values, "level": levels, "error": errors}
    found = differences(verified(table_of("studio5000.csv", replace(recorded, values=values)), 30))
    assert found[0][1] == "Main.level"
    assert found[0][0] < 30


@nightly
def test_several_seeds_of_jitter() -> None:
    for seed in range(5, amount(7, 6)):
        assert differences(verified(table_of("melsec.csv", clean(seed)))) == []


# ---- single layouts -------------------------------------------------------------------------------------------------


def test_what_the_scope_has_scaled_is_left_out() -> None:
    text = FILES["twincat.csv"](clean()).decode("utf-8-sig")
    rows = [line.split("\t") for line in text.split("\r\n")]
    scale = next(row for row in rows if row[0] == "ScaleFactor")
    at = 1 + SIGNALS.index("level")
    scale[at] = "0,5"
    table = read_trace(lines(rows, "\t").encode(), "scope.csv")
    assert "MAIN.level" not in table.columns
    assert any("was scaled by the scope" in each for each in table.left_out)


def test_numbers_in_hexadecimal_stay_these() -> None:
    table = table_of("melsec.csv", clean())
    assert all(row[-1].startswith("16#") for row in table.rows)
    assert table.left_out == ("`Trigger` is no variable of the program.",)


def test_the_index_counts_where_date_and_time_are_too_coarse() -> None:
    rows = [["2026/11/28 11:59:59", str(at + 1), "0"] for at in range(5)]
    head = [
        ["[LOGGING]", "L1", "2", "3", "4"],
        ["DATETIME[YYYY/MM/DD hh:mm:ss]", "INDEX", "BIT[1;0]"],
        ["TIME", "INDEX", "Main.start"],
    ]
    table = read_trace(lines([*head, *rows], ",").encode(), "log.csv")
    assert (table.columns, table.axis, table.unit, table.from_start) == (
        ("INDEX", "Main.start"),
        "INDEX",
        "scan",
        False,
    )


def test_intervals_of_a_panasonic_trace_are_of_10_us_or_10_ms() -> None:
    for interval, step in (("1000", "10.00"), ("1", "10")):
        rows = [["2026/11/28", f"12:00:{at // 100:02}", interval if at else "0", "1"] for at in range(300)]
        table = read_trace(
            lines([["Date", "Time", "Obtaining interval", "1"], ["", "", "", "start"], *rows], ",").encode(), "t.csv"
        )
        assert table.rows[1][0] == step


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        ("Time;A;Time;B\n0;1;0;5\n10;2;10;6\n", ("Time [s]", "A", "B")),
        ("a.Time [ms];a.Value;b.Time [ms];b.Value\n0;1;5;5\n10;2;15;6\n", ("Time [ms]", "a", "b")),
        ("Line 4\nshift 2\nt;A [mm/s];B\n0;1;5\n1;2;6\n", ("t", "A [mm/s]", "B")),
        ("Time,A,B\ns,bar,-\n0,1,2\n1,1,2\n", ("Time [s]", "A [bar]", "B")),
        ("Date;Time;A\n28.11.2026;10:00:00.1;1\n28.11.2026;10:00:00.2;1\n", ("Time", "A")),
    ],
)
def test_other_files_are_read_by_their_shape(text: str, columns: tuple[str, ...]) -> None:
    table = read_trace(text.encode(), "t.csv")
    assert table.columns == columns
    assert not table.from_start


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("t.trace", "<Trace><a></Trace>", "not XML"),
        ("t.trace", "<Trace/>", "no signal"),
        ("t.trace", '<!DOCTYPE x [<!ENTITY a "b">]><Trace/>', "DOCTYPE"),
        ("t.csv", "[LOGGING],1,x,y,z\n1,2\n", "does not say in which lines"),
        ("t.txt", "CoDeSys Trace\nx.pro\nCycle A B\n0 1 2\n1 2\n", "2 cells, but there are 3 columns"),
        ("t.csv", "Date,Time,Obtaining interval,1\n2026/11/28,12:00:00,x,1\n2026/11/28,12:00:00,x,1\n", "interval cannot be read"),
        ("t.csv", "Line 4\nscan,a\n0,1\n1\n2,3\n", "1 columns"),
        ("t.csv", "Scan,Main.level\n1,2\n1,x\n2", "1 cells, but there are 2 columns"),
    ],
)  # fmt: skip
def test_what_is_broken_is_refused_whole(name: str, text: str, words: str) -> None:
    with pytest.raises(BadTraceFile, match=words):
        read_trace(text.encode(), name)


# ---- anything -------------------------------------------------------------------------------------------------------


def spoiled(data: bytes, chance: random.Random) -> bytes:
    """The same file with lines or cells gone, moved, emptied or of something else, or bytes changed."""
    rows = data.split(b"\n")[:40]
    for _ in range(chance.randrange(1, 4)):
        at = chance.randrange(len(rows))
        kind = chance.randrange(6)
        if kind == 0:
            del rows[at]
        elif kind == 1:
            rows.insert(at, chance.choice(rows))
        elif kind == 2:
            rows[at] = rows[at][: chance.randrange(len(rows[at]) + 1)]
        elif kind == 3:
            cells = rows[at].replace(b";", b",").replace(b"\t", b",").split(b",")
            cells[chance.randrange(len(cells))] = chance.choice(
                (b"", b"x", b"-1e999", b"99:99:99", b'"', b"1,5", b"Name")
            )
            rows[at] = chance.choice((b",", b";", b"\t")).join(cells)
        elif kind == 4:
            rows[at] = bytes(each ^ (chance.random() < 0.02) for each in rows[at])
        else:
            rows[at], rows[-1] = rows[-1], rows[at]
        if not rows:
            return b"\n"
    return b"\n".join(rows)


@nightly
@pytest.mark.parametrize("name", NAMES)
def test_a_spoiled_file_is_read_or_refused(name: str) -> None:
    data, chance = FILES[name](clean()), random.Random(name)
    for _ in range(amount(150, 4)):
        changed = spoiled(data, chance)
        try:
            table = read_trace(changed, name)
        except BadTraceFile:
            continue
        assert table.rows
        assert all(len(row) == len(table.columns) for row in table.rows)
        assert len(set(table.columns)) == len(table.columns)
        check(table, propose(table, program()).mapping, program())
