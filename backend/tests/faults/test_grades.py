"""Every program of `grades/`, with the grade that each error deserves there (`grades.csv`): on both engines."""

import csv
from pathlib import Path
from typing import NamedTuple

import pytest

from scanbench.engines.observe import MakeObserved
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reaction.sweep import sweep
from tests.faults.reacting import MAKES, checked, point_of, programs, ref, standing
from tests.runtime.bench import model

HERE = Path(__file__).parent / "grades"
WINDOW = 50


class Deserved(NamedTuple):
    """A row of the table."""

    error: str
    grade: str
    scans: str
    named: tuple[str, ...]


def table() -> dict[str, list[Deserved]]:
    found: dict[str, list[Deserved]] = {}
    with (HERE / "grades.csv").open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            made = Deserved(row["error"], row["grade"], row["scans"], tuple(row["named"].split()))
            found.setdefault(row["program"], []).append(made)
    return found


TABLE = table()
NONFATAL = [each.id for each in model().errors() if each.severity == "nonfatal" and each.coded]


def of_each_error(rows: list[Deserved]) -> dict[str, Deserved]:
    """`*` is every nonfatal error that has a code, and no row of its own."""
    own = {row.error: row for row in rows}
    rest = own.pop("*", None)
    return own if rest is None else {**own, **{id: rest for id in NONFATAL if id not in own}}


def says(found: Reaction) -> str:
    """What the result names for its verdict."""
    named = [*found.displayed, *found.decided_by]
    named += [part for each in found.carried for part in (each.path, *each.readers)]
    named += [f"{each.file}:{each.line}" for each in found.unreached]
    return " ".join(named)


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES)
@pytest.mark.parametrize("name", TABLE)
def test_every_error_gets_the_grade_it_deserves(name: str, make: MakeObserved) -> None:
    program = checked({"main.st": (HERE / f"{name}.st").read_text("utf-8")})
    point = point_of(standing(program, make))
    wanted = of_each_error(TABLE[name])
    refs = [ref(error) for error in wanted]
    cells = sweep({"here": point}, refs, WINDOW, programs(program, make))
    for cell, row in zip(cells, wanted.values(), strict=True):
        found = cell.reaction
        assert found is not None, cell
        scans = "" if found.first_effect is None else str(found.first_effect)
        assert (found.verdict, scans) == (row.grade, row.scans), (cell.error, found)
        assert set(row.named) <= set(says(found).split()), (cell.error, found)
        assert found.basis == ("static" if row.grade in ("decided", "not_reached") else "exact")


def test_every_program_is_in_the_table() -> None:
    assert {each.stem for each in HERE.glob("*.st")} == set(TABLE)
    assert len(TABLE) >= 40
