"""Makes golden exports: `python -m tests.reports.golden_exports` has the golden database's records exported, and an error sweep made.

They are made once for each number of a format: later versions read them again, and write all that is in them.
"""

import asyncio
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

from scanbench.faults.reaction.reaction import (
    Carried,
    Line,
    OutputRestart,
    Reaction,
    Reader,
    RequiredResult,
    Unreached,
    ValueThen,
)
from scanbench.reports.record import RecordProblem, TestRecord
from scanbench.reports.record_read import from_xml
from scanbench.reports.record_xml import to_xml
from scanbench.server.verifications import Format, Verifications
from scanbench.store.store import Store
from tests.cli.calling import scanbench
from tests.store.golden_data import GOLDEN as DATABASES
from tests.store.golden_data import opened
from tests.store.golden_database import PROGRAM
from tests.store.said import plain

GOLDEN = Path(__file__).with_name("golden")
ERRORS = ("io-bus-error", "fal", "battery-error", "basic-io-error")
A = TypeVar("A")


def with_store(data: Path, ask: Callable[[Store], A]) -> A:
    """What the golden database answers."""
    store = Store(f"sqlite:///{opened(DATABASES / '0.1.0.sql', data) / 'scanbench.db'}")
    try:
        return ask(store)
    finally:
        store.close()


def verification(store: Store, data: Path, format: Format) -> str:
    """The verification that is kept in the golden database, as a file."""
    kept = Verifications(store, data / "verifications", data / "cache")
    return asyncio.run(kept.export_record(1, format)).text


def _sweep(folder: Path) -> str:
    folder.mkdir()
    (folder / "main.st").write_text(PROGRAM, "utf-8")
    (folder / "project.json").write_text('{"model": "CJ1M-CPU63"}', "utf-8")
    only = [text for each in ERRORS for text in ("--only", each)]
    return scanbench("errors", "sweep", str(folder), *only, "--window", "20", "--json").stdout


def graded(xml: str) -> str:
    """A record of version 1 with a reaction that has a grade and all that belongs to one."""
    record = from_xml(xml)
    assert isinstance(record, TestRecord)
    (first, *others) = record.errors
    reaction = Reaction(
        "decided", 50, 1, None, (Reader("main.st", 4, "Main", "flag", 1),), (), 0, (Line("main.st", 5),), "", "static",
        (Carried("Main.cnt", 1, ("main.st:4", "main.st:5")),), ("main.st:8",), ("D100",),
        (Unreached("main.st", 7, ("Main.one", "Main.two"), "condition", "main.st:6"),),
    )  # fmt: skip
    return to_xml(replace(record, errors=(replace(first, reaction=reaction, reaction_note=""), *others)))


def judged(xml: str) -> str:
    """A record of version 2 with a reaction that has required reactions and all that belongs to them."""
    record = from_xml(xml)
    assert isinstance(record, TestRecord)
    (first, *others) = record.errors
    assert first.reaction is not None
    reaction = replace(
        first.reaction,
        required=(
            RequiredResult("motor = FALSE within 3 scans", 2, "passed", False, 1, (ValueThen("motor", "FALSE"),)),
            RequiredResult("after recovery: motor until reset", 3, "failed", True, 7, (ValueThen("motor", "FALSE"),)),
            RequiredResult("lmp", 4, "not_checked", reason="invalid", note="There is no `lmp`."),
        ),
        restarts=(OutputRestart("fan", 2), OutputRestart("motor", 1, "after recovery: motor may restart")),
        recovery=50,
    )
    made = replace(record, errors=(replace(first, reaction=reaction), *others))
    (sweep, *older) = made.sweeps
    (cell, *cells) = sweep.cells
    sweep = replace(sweep, cells=(replace(cell, required=3, unmet=1), *cells))
    return to_xml(replace(made, sweeps=(sweep, *older)))


def judged_exports() -> None:
    """Makes the record with required reactions: version 3."""
    xml = judged((GOLDEN / "record-2.xml").read_text("utf-8"))
    (GOLDEN / "record-3.xml").write_text(xml, "utf-8")
    (GOLDEN / "record-3.json").write_text(
        json.dumps(plain(from_xml(xml)), indent=1, ensure_ascii=False) + "\n", "utf-8"
    )


def graded_exports() -> None:
    """Makes those that have grades: version 2 of records, format 2 of sweeps."""
    with TemporaryDirectory() as directory:
        sweep = _sweep(Path(directory) / "line")
    xml = graded((GOLDEN / "record-1.xml").read_text("utf-8"))
    (GOLDEN / "record-2.xml").write_text(xml, "utf-8")
    (GOLDEN / "record-2.json").write_text(
        json.dumps(plain(from_xml(xml)), indent=1, ensure_ascii=False) + "\n", "utf-8"
    )
    (GOLDEN / "sweep-2.json").write_text(sweep, "utf-8")


def instance_exports() -> None:
    """Makes version 4 of records: a row for each instance."""
    xml = (GOLDEN / "record-3.xml").read_text("utf-8")
    xml = xml.replace('Id="fal"', 'Id="fal:number=5"').replace('Error="fal"', 'Error="fal:number=5"')
    record = from_xml(xml)
    assert isinstance(record, TestRecord)
    (GOLDEN / "record-4.xml").write_text(to_xml(record), "utf-8")
    (GOLDEN / "record-4.json").write_text(json.dumps(plain(record), indent=1, ensure_ascii=False) + "\n", "utf-8")


def untried_exports() -> None:
    """Makes version 5 of records: what is required and could not be tried."""
    record = from_xml((GOLDEN / "record-4.xml").read_text("utf-8"))
    assert isinstance(record, TestRecord)
    (sweep, *older) = record.sweeps
    (cell, *cells) = sweep.cells
    why = "battery-error was already generated by Ada"
    untried = (
        RequiredResult("at least acted", 2, "not_checked", reason="not_raised", note=why),
        RequiredResult("motor = FALSE", 9, "not_checked", reason="no_state", note="there is no state `Idel`."),
        RequiredResult("lamp", 3, "not_checked", reason="present", note=why),
    )
    one = replace(cell, verdict=None, scans=None, note=why, required=3, unmet=2, untried=untried)
    problems = (RecordProblem(7, 1, "CJ1M-CPU63 knows no error 'batery-error'."),)
    made = replace(record, sweeps=(replace(sweep, cells=(one, *cells), problems=problems), *older))
    (GOLDEN / "record-5.xml").write_text(to_xml(made), "utf-8")
    (GOLDEN / "record-5.json").write_text(json.dumps(plain(made), indent=1, ensure_ascii=False) + "\n", "utf-8")


def main() -> None:
    """Makes all that are not there yet."""
    if (GOLDEN / "record-4.xml").exists():
        untried_exports()
        return
    if (GOLDEN / "record-3.xml").exists():
        instance_exports()
        return
    if (GOLDEN / "record-1.xml").exists():
        graded_exports()
        return
    with TemporaryDirectory() as directory:
        data = Path(directory) / "data"

        def told(store: Store) -> tuple[str, str, str]:
            return store.records.get(1).text, verification(store, data, "json"), verification(store, data, "csv")

        xml, report, table = with_store(data, told)
        sweep = _sweep(Path(directory) / "line")
    (GOLDEN / "record-1.xml").write_text(xml, "utf-8")
    (GOLDEN / "record-1.json").write_text(
        json.dumps(plain(from_xml(xml)), indent=1, ensure_ascii=False) + "\n", "utf-8"
    )
    (GOLDEN / "verification-1.json").write_text(report, "utf-8")
    (GOLDEN / "verification-1.csv").write_text(table, "utf-8", newline="")
    (GOLDEN / "sweep-1.json").write_text(sweep, "utf-8")


if __name__ == "__main__":
    main()
