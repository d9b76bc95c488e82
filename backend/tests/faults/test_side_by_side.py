"""Sweeps on several cores: the same as on one."""

import os
import signal

import pytest

from scanbench.engines.interpreter.observed import observed_engine
from scanbench.faults.reaction.side_by_side import Died, sweep_side_by_side
from scanbench.faults.reaction.sweep import Cell, Sweeper, sweep
from scanbench.faults.reference import ErrorRef
from scanbench.program.program import Program
from tests.faults.reacting import checked, point_of, programs, standing
from tests.faults.test_sweep import GATED


@pytest.fixture(scope="module")
def program() -> Program:
    return checked({"main.st": GATED})


def test_the_cells_are_the_same_in_the_same_order(program: Program) -> None:
    begin = point_of(standing(program, observed_engine))
    points, errors = {"a": begin, "b": begin}, [ErrorRef(each.id) for each in program.layout.model.errors()]
    there = programs(program, observed_engine)
    alone = list(sweep(points, errors, 5, there))
    assert len(alone) >= 40
    tried: list[tuple[str, str]] = []
    told: list[Cell] = []
    done = {(alone[1].error, alone[1].point)}
    for cell in sweep_side_by_side(points, errors, 5, there, 2, done=done, on_try=lambda *pair: tried.append(pair)):
        told.append(cell)
        assert tried[-1] == (cell.error, cell.point)
        assert len(tried) == len(told)
    assert told == [each for each in alone if (each.error, each.point) not in done]


def test_a_process_that_dies_ends_the_sweep(program: Program, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody waits for what it will never say."""
    begin = point_of(standing(program, observed_engine))
    errors = [ErrorRef(each.id) for each in program.layout.model.errors()]

    def die(self: Sweeper, ref: ErrorRef, name: str) -> Cell:
        os.kill(os.getpid(), signal.SIGKILL)
        raise AssertionError

    monkeypatch.setattr(Sweeper, "cell", die)
    with pytest.raises(Died, match="for want of memory"):
        list(sweep_side_by_side({"a": begin, "b": begin}, errors, 5, programs(program, observed_engine), 2))
