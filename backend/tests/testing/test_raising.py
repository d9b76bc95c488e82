"""`--raise` of `scanbench run` with shapes: what each text means, and that a recorded run of it replays."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from scanbench.cli.commands import app
from scanbench.faults.arm import Arm
from scanbench.faults.inject import Generate
from scanbench.faults.reference import ErrorRef
from scanbench.faults.shapes import Shape, Start, Wanted
from scanbench.testing.command_text import before_scan
from scanbench.testing.raising import BadCommand, read_raise
from tests.runtime.bench import program

SOURCE = """PROGRAM Main
VAR n : DINT; battery AT A402.04 : BOOL; seen, first : DINT; END_VAR
  n := n + 1;
  IF battery THEN
    seen := seen + 1;
    IF first = 0 THEN
      first := n;
    END_IF;
  END_IF;
END_PROGRAM
"""
BATTERY, RACK = ErrorRef("battery-error"), ErrorRef("basic-io-error", (("rack", "1"),))


def armed(text: str) -> tuple[int, Wanted]:
    body, scan = before_scan(text)
    command = read_raise(program(SOURCE), "Ada", body)
    assert isinstance(command, Arm)
    return scan, command.wanted


@pytest.mark.parametrize(
    ("text", "scan", "wanted"),
    [
        ("battery-error for 5@100", 100, Wanted((BATTERY,), Start(), Shape("for", 5))),
        ("battery-error  every 100  on 10 times 3 seed 7 @20", 20, Wanted((BATTERY,), Start(), Shape("intermittent", 10, 100, 3, 7))),
        ("battery-error every 9", 0, Wanted((BATTERY,), Start(), Shape("intermittent", 1, 9))),
        ("battery-error chatter times 4", 0, Wanted((BATTERY,), Start(), Shape("chatter", times=4))),
        ("battery-error chatter", 0, Wanted((BATTERY,), Start(), Shape("chatter"))),
        ("battery-error for 9 unless Main.n > 3 AND NOT Main.battery", 0,
         Wanted((BATTERY,), Start(), Shape("unacknowledged", 9, acknowledge="Main.n > 3 AND NOT Main.battery"))),
        ("battery-error when Main.n > 3@5", 5, Wanted((BATTERY,), Start("condition", condition="Main.n > 3"))),
        ("battery-error for 2 when main.st:3", 0, Wanted((BATTERY,), Start("line", file="main.st", line=3), Shape("for", 2))),
        ("battery-error chance 0.5% on 3 times 2 seed 7", 0, Wanted((BATTERY,), Start(), Shape("chance", 3, times=2, seed=7, per_million=5000))),
        ("battery-error chance 100%", 0, Wanted((BATTERY,), Start(), Shape("chance", per_million=1_000_000))),
        ("battery-error while basic-io-error", 0, Wanted((BATTERY,), Start("condition", condition="A402.12"))),
        ("battery-error for 3 while basic-io-error:rack=1", 0,
         Wanted((BATTERY,), Start("condition", condition="A402.12"), Shape("for", 3))),
        ("battery-error + basic-io-error:rack=1 gap 3@10", 10, Wanted((BATTERY, RACK), gap=3)),
    ],
)  # fmt: skip
def test_what_a_text_means(text: str, scan: int, wanted: Wanted) -> None:
    assert armed(text) == (scan, wanted)


def test_without_a_shape_it_is_raised_at_once() -> None:
    assert read_raise(program(SOURCE), "Ada", "basic-io-error:rack=1") == Generate("Ada", (RACK,))
    assert read_raise(program(SOURCE), "Ada", "battery-error + basic-io-error:rack=1") == Generate(
        "Ada", (BATTERY, RACK)
    )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("batery-error for 5", "Did you mean `battery-error`"),
        ("battery-error for", "`for` is not understood"),
        ("battery-error for x", "`for x` is not understood"),
        ("battery-error for 5 for 6", "`for 6` is not understood"),
        ("battery-error for 5 every 6", "every and for do not make a shape"),
        ("battery-error chatter for 6", "for and chatter do not make a shape"),
        ("battery-error chatter unless Main.n > 3", "`unless` goes with `for`"),
        ("battery-error on 5", "on does not make a shape"),
        ("battery-error chance 5", "`chance 5` is not understood"),
        ("battery-error chance 5% for 3", "chance and for do not make a shape"),
        ("battery-error while basic-oi-error", "Did you mean `basic-io-error`"),
        ("battery-error while basic-io-error when Main.n > 3", "leave one out"),
    ],
)
def test_what_is_not_understood(text: str, words: str) -> None:
    with pytest.raises(BadCommand, match=words):
        read_raise(program(SOURCE), "Ada", text)


@pytest.mark.parametrize(("first", "then"), [("battery-error", "basic-io-error"), ("basic-io-error", "battery-error")])
def test_a_pair_in_both_orders(first: str, then: str, tmp_path: Path) -> None:
    (tmp_path / "main.st").write_text(SOURCE)
    ran = call(
        "run", str(tmp_path / "main.st"), "--model", "CJ1M-CPU63", "--scans", "50", "--raise", f"{then} while {first}",
        "--raise", f"{first}@20", "--print", "A402.04", "--print", "A402.12", "--print", "Main.first", "--json",
    )  # fmt: skip
    assert ran.exit_code == 0, ran.output
    values = json.loads(ran.stdout)["values"]
    assert (values["A402.04"], values["A402.12"]) == (True, True)
    assert values["Main.first"] == (21 if first == "battery-error" else 22)  # seen one scan after the other one


def call(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


@pytest.mark.parametrize(
    ("text", "seen", "first"),
    [
        ("battery-error for 5@20", 5, 21),
        ("battery-error every 10 on 3 times 4@20", 12, 21),
        ("battery-error when Main.n = 30", 170, 31),
        ("battery-error for 3 when main.st:5", 0, 0),
        ("battery-error for 3 when main.st:3", 3, 2),
        ("battery-error for 9 unless Main.seen = 4", 4, 1),
    ],
)
def test_runs_and_replays(text: str, seen: int, first: int, tmp_path: Path) -> None:
    (tmp_path / "main.st").write_text(SOURCE)
    record = str(tmp_path / "a.scanrun")
    shown = ("--print", "Main.seen", "--print", "Main.first", "--json", "--hash")
    ran = call(
        "run", str(tmp_path / "main.st"), "--model", "CJ1M-CPU63", "--scans", "200", "--raise", text, "--record", record, *shown
    )  # fmt: skip
    assert ran.exit_code == 0, ran.output
    result = json.loads(ran.stdout)
    assert [result["values"]["Main.seen"], result["values"]["Main.first"]] == [seen, first]
    again = call("replay", record, "--engine", "both", "--json")
    assert again.exit_code == 0, again.output
    assert json.loads(again.stdout)["hash"] == result["hash"]


def test_refused(tmp_path: Path) -> None:
    (tmp_path / "main.st").write_text(SOURCE)

    def refused(text: str, *more: str) -> str:
        ran = call("run", str(tmp_path / "main.st"), "--model", "CJ1M-CPU63", "--scans", "9", "--raise", text, *more)
        assert ran.exit_code == 2
        return ran.output

    assert "refused before scan 4: memory-error is fatal" in refused("memory-error for 3@4")
    for text, says in (
        ("battery-error when main.st:2", "main.st:2; the nearest is at"),
        ("battery-error when Main.m > 3", "`Main.m > 3`: `Main` has no member `m`.\n"),
        ("battery-error for 9 unless Mian.n > 3@5", "Did you mean `Main`?\n"),
    ):
        told = refused(text, "--print", "Main.n")
        assert says in told
        assert "Main.n = " not in told  # nothing ran
        assert ".." not in told
    assert "--engine both cannot wait for a line" in refused("battery-error when main.st:3", "--engine", "both")
