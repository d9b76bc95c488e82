"""Golden exports: what was written once is read for ever, and whoever reads it finds all of it in what is written today."""

import csv
import io
import json
from pathlib import Path

import pytest
from lxml import etree

from scanbench.faults.reaction.reaction import Difference, Line, Reaction, Reader
from scanbench.faults.reaction.sweep import Cell
from scanbench.plcmodel.load import model_named
from scanbench.reports.record import TestRecord
from scanbench.reports.record_read import from_xml
from scanbench.reports.record_xml import to_xml
from scanbench.reports.sweep_report import SweepResult, outcomes_in, sweep_json
from tests.reports.golden_exports import GOLDEN, verification, with_store
from tests.store.said import missing, plain


def text(name: str) -> str:
    """Of a golden file, with its ends of lines."""
    return (GOLDEN / name).read_bytes().decode("utf-8")


def kinds(value: object) -> object:
    """The names and kinds of all that is in a value; of a list those of its first entry."""
    if isinstance(value, dict):
        return {name: kinds(each) for name, each in value.items()}
    if isinstance(value, list):
        return [kinds(each) for each in value[:1]]
    return type(value).__name__


def elements(node: etree._Element) -> object:
    """An element with all that is in it."""
    within: dict[str, list[object]] = {}
    for each in node:
        within.setdefault(str(each.tag), []).append(elements(each))
    made: dict[str, object] = {str(name): str(value) for name, value in node.attrib.items()}
    return made | within


@pytest.mark.parametrize("version", ["1", "2", "3", "4", "5"])
def test_a_golden_test_record_says_what_it_said(version: str) -> None:
    record = from_xml(text(f"record-{version}.xml"))
    assert isinstance(record, TestRecord)
    assert missing(json.loads(text(f"record-{version}.json")), plain(record)) == []
    then, now = (etree.fromstring(each.encode()) for each in (text(f"record-{version}.xml"), to_xml(record)))
    assert then.attrib.pop("Version") == version  # today's may have more
    assert missing(elements(then), elements(now)) == []


@pytest.mark.parametrize(("version", "last"), [("1", "reacted"), ("2", "acted")])
def test_a_golden_sweep_says_what_it_said(version: str, last: str) -> None:
    told = json.loads(text(f"sweep-{version}.json"))
    found = [(each.error, each.state, each.verdict, each.scans) for each in outcomes_in(told)]
    assert found == [(each["id"], each["state"], each["verdict"], each["scans"]) for each in told["results"]]
    assert {verdict for _, _, verdict, _ in found} == {"stopped", "never_read", "no_effect", last}


def test_a_sweep_has_all_that_a_golden_one_has() -> None:
    then = json.loads(text("sweep-1.json"))
    then["results"] = [next(each for each in then["results"] if each["verdict"] == "reacted")]
    del then["unhandled"]  # which the command adds
    assert then.pop("format") == 1  # today's has more
    then["counts"] = {}
    error = next(each for each in model_named("CJ1M-CPU63").errors() if each.id == "basic-io-error")
    reaction = Reaction(
        "reacted", 20, 1, 1, (Reader("main.st", 3, "Main", "flag", 1),), (Difference("Main.x", "0", "1", True, 1),), 1,
        (Line("main.st", 4),),
    )  # fmt: skip
    made = SweepResult("line", "CJ1M-CPU63", 20, (("Start", 100),), (error,), (Cell(error.id, "Start", reaction),))
    assert missing(kinds(then), kinds(sweep_json(made))) == []


def test_a_verification_has_all_that_a_golden_one_has(tmp_path: Path) -> None:
    data = tmp_path / "data"
    report, table = with_store(
        data, lambda store: (verification(store, data, "json"), verification(store, data, "csv"))
    )  # fmt: skip
    then = json.loads(text("verification-1.json"))
    assert then.pop("tool").startswith("Scanbench ")
    assert missing(then, json.loads(report)) == []
    assert (
        missing(list(csv.DictReader(io.StringIO(text("verification-1.csv")))), list(csv.DictReader(io.StringIO(table))))
        == []
    )
