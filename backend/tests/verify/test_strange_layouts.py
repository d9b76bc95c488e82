"""Files that are written in a strange but legal way: each is read, mapped by itself and judged rightly."""

from collections.abc import Callable

import pytest

from scanbench.check.build import check_sources
from scanbench.plcmodel.load import model_named
from scanbench.verify.ranges import parse_range
from scanbench.verify.trace.bind import check
from scanbench.verify.trace.propose import propose
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.subject import TraceSubject
from scanbench.verify.verifier import Verifier

PROGRAM = check_sources(
    {
        "main.st": "PROGRAM Main\nVAR_INPUT x : INT; END_VAR\nVAR_OUTPUT y : REAL; q : BOOL; END_VAR\n"
        "y := INT_TO_REAL(x) / 4.0;\nq := x > 3;\nEND_PROGRAM\n"
    },
    model_named("GENERIC-IEC"),
    10_000_000,
).program
HEAD = "scan,Main.x,Main.y,Main.q"
WRONG = 5


def clock(scan: int) -> str:
    return f"10:59:59.{900 + 10 * scan}" if scan < 10 else f"11:00:00.{10 * (scan - 10):03d}"


def table(wrong: int | None, head: str = HEAD, first: Callable[[int], str] = str) -> str:
    """Twelve scans; one output is wrong in one of them."""
    values = [(scan, 3 * scan % 7) for scan in range(12)]
    rows = (f"{first(scan)},{x},{(x + (scan == wrong)) / 4:.2f},{x > 3:d}\n" for scan, x in values)
    return head + "\n" + "".join(rows)


def german(text: str) -> str:
    """A comma in numbers, and semicolons between them."""
    return text.replace(",", ";").replace(".", ",").replace("Main,", "Main.")


def quoted(text: str) -> str:
    head, rows = text.split("\n", 1)
    return ",".join(f'"{each}"' for each in head.split(",")) + "\n" + rows


LAYOUTS: dict[str, Callable[[int | None], str | bytes]] = {
    "BOM": lambda wrong: "\ufeff" + table(wrong),
    "CRLF": lambda wrong: table(wrong).replace("\n", "\r\n"),
    "semicolon and decimal comma": lambda wrong: german(table(wrong)),
    "tabs and decimal comma": lambda wrong: german(table(wrong)).replace(";", "\t"),
    "quoted names": lambda wrong: quoted(table(wrong)),
    "a line of units": lambda wrong: table(wrong, f"{HEAD}\n,mm,bar,"),
    "UTF-16": lambda wrong: table(wrong).encode("utf-16"),
    "UTF-16, big end first": lambda wrong: b"\xfe\xff" + table(wrong).encode("utf-16-be"),
    "an empty last column": lambda wrong: table(wrong).replace("\n", ",\n"),
    "time of day": lambda wrong: table(wrong, HEAD.replace("scan", "Time"), clock),
    "time of day, decimal comma": lambda wrong: german(table(wrong, HEAD.replace("scan", "Time"), clock)),
    "no line end at the end": lambda wrong: table(wrong).rstrip("\n"),
    "empty lines": lambda wrong: table(wrong).replace("\n", "\n\n"),
    "what Excel takes": lambda wrong: "sep=;\r\n" + german(table(wrong)).replace("\n", "\r\n"),
    "Latin-1": lambda wrong: table(wrong, HEAD.replace("Main.x", "Main.x [°C]")).encode("latin-1"),
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_it_is_read_and_judged_rightly(name: str) -> None:
    assert PROGRAM is not None
    for wrong in (None, WRONG):
        data = LAYOUTS[name](wrong)
        read = read_trace(data.encode() if isinstance(data, str) else data, "log.csv")
        found = check(read, propose(read, PROGRAM).mapping, PROGRAM)
        assert found.trace is not None, found.problems
        verifier = Verifier(TraceSubject(PROGRAM, found.trace))
        verifier.begin(parse_range(""))
        rows = [(scan, row) for scan in range(verifier.first, verifier.end) for row in verifier.verify(scan).rows]
        assert sum(bool(row.compared) for _, row in rows) >= 11
        differs = [(scan - verifier.first, each.name) for scan, row in rows for each in row.differences]
        assert differs == ([] if wrong is None else [(WRONG, "Main.y")])


def test_two_columns_of_one_name_are_refused() -> None:
    with pytest.raises(Exception, match=r"There are two columns `Main\.y`"):
        read_trace(table(None, "scan,Main.x,Main.y,Main.y").encode(), "log.csv")


def test_a_log_without_an_output_has_nothing_to_compare() -> None:
    assert PROGRAM is not None
    read = read_trace(b"scan,Main.x\n0,1\n1,2\n", "log.csv")
    found = check(read, propose(read, PROGRAM).mapping, PROGRAM)
    assert found.trace is None
    assert [str(each) for each in found.problems] == [
        "No column is an output of the program, so there is nothing to compare."
    ]
