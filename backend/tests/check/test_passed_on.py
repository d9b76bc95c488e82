"""Conditions on in-outs that are passed on: they mean the variable, as every tool does, however many blocks made a copy of it."""

from dataclasses import replace

import pytest

from scanbench.check.build import check_sources
from scanbench.check.typed.condition import BadCondition, Condition, Signal, compile_condition, compile_signal
from scanbench.check.typed.local import Local, Locals
from scanbench.engines.engine import Reason
from scanbench.engines.pair import PairEngine
from scanbench.program.program import Program
from tests.caseformat import MODELS

SOURCE = """
TYPE Tank : STRUCT name : STRING[5]; level : INT; open : BOOL; list : ARRAY[0..3] OF INT; END_STRUCT; END_TYPE
FUNCTION_BLOCK Valve
VAR_IN_OUT level : INT; on : BOOL; END_VAR
level := level + 1; on := NOT on;
END_FUNCTION_BLOCK
{in_out 'reference'}
FUNCTION_BLOCK Between
VAR_IN_OUT l : INT; on : BOOL; END_VAR
VAR valve : Valve; END_VAR
valve(level := l, on := on);
END_FUNCTION_BLOCK
FUNCTION_BLOCK Pump
VAR_IN_OUT tank : Tank; flags : WORD; END_VAR
VAR between : Between; valve, never : Valve; i : INT; END_VAR
i := (i + 1) MOD 4;
between(l := tank.level, on := tank.open);
valve(level := tank.list[i], on := flags.%X3);
IF FALSE THEN never(level := tank.level, on := tank.open); END_IF;
END_FUNCTION_BLOCK
PROGRAM Main
VAR pump : Pump; pumps : ARRAY[0..1] OF Pump; tanks : ARRAY[0..2] OF Tank; n, i, pos : INT; flags : WORD; own : Valve; turn : BOOL;
  link : REF_TO Pump; seen : BOOL; END_VAR
n := n + 1; i := n MOD 3;
pump(tank := tanks[i], flags := flags);
pumps[0](tank := tanks[1], flags := flags);
pumps[1](tank := tanks[2], flags := flags);
own(level := pos, on := turn);
pos := pos + 50;
tanks[0].level := n; tanks[1].level := n + 100; tanks[2].level := n + 200; // after the calls: no copy has it
tanks[0].list[1] := n + 7; tanks[1].list[1] := n + 8; tanks[2].list[1] := n + 9;
tanks[i].open := n MOD 2 = 0; flags.%X3 := n MOD 4 > 1; turn := n MOD 3 = 0;
link := REF(pump);
END_PROGRAM
"""


def program(convention: str) -> Program:
    made = replace(MODELS["GENERIC-IEC"], in_out=convention)  # type: ignore[arg-type]
    checked = check_sources({"a.st": SOURCE}, made, 1_000_000)
    assert checked.program is not None, checked.problems
    return checked.program


def holds_after(program: Program, text: str) -> int | None:
    """The number of scans; None: not in 20."""
    condition = compile_condition(program, text)
    assert isinstance(condition, Condition), condition
    memory = bytearray(program.initial_image)
    engine = PairEngine(program, memory)
    engine.stop_when(condition)
    return int.from_bytes(memory[16:24], "little") if engine.run(20).reason == Reason.CONDITION else None


@pytest.mark.parametrize("convention", ["reference", "value"])
@pytest.mark.parametrize(
    ("text", "scans"),
    [
        ("Main.pump.between.valve.level <> Main.tanks[Main.i].level", None),
        ("Main.pump.between.valve.level = 108", None),
        ("Main.pump.between.valve.level = 107", 7),
        ("Main.pump.between.l = 107", 7),
        ("Main.pump.tank.level = 107", 7),
        ("Main.pump.valve.level = 16 AND Main.pump.i = 1", 9),
        ("Main.pump.between.valve.on AND Main.n > 4", 6),
        ("Main.pump.between.valve.on <> Main.tanks[Main.i].open", None),
        ("Main.pump.valve.on AND Main.n > 4", 6),
        ("Main.pump.valve.on <> Main.flags.3", None),
        ("Main.pumps[1].between.valve.level = 204", 4),
        ("Main.pumps[0].between.valve.level.1 AND Main.n > 3", 6),
        ("Main.own.level = 102", 2),
        ("Main.own.on", 3),
        ("Main.pump.never.level < 5 OR Main.pump.never.on", None),
    ],
)
def test_it_is_the_variable(convention: str, text: str, scans: int | None) -> None:
    assert holds_after(program(convention), text) == scans


@pytest.mark.parametrize("text", ["Main.pumps[Main.i].valve.level > 3", "Main.link^.between.valve.level > 3"])
def test_what_cannot_be_followed_is_refused(text: str) -> None:
    refused = compile_condition(program("value"), text)
    assert isinstance(refused, BadCondition)
    assert "Which variable the in-out `level` is cannot be told here" in refused.message
    assert "Name the variable itself" in refused.message
    assert isinstance(compile_condition(program("reference"), text), Condition)
    assert isinstance(compile_condition(program("value"), "Main.pumps[Main.i].tank.level > 3"), Condition)
    # in the scope of a POU a name means what it means in its statements
    made = program("value")
    pump = next(pou for pou in made.pous if pou.name == "Pump")
    assert isinstance(Locals(made).value(pump, "between.valve.level + valve.level"), Local)
    assert isinstance(compile_signal(program("value"), "Main.pump.between.valve.level"), Signal)
