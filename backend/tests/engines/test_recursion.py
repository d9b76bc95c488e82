"""Instances that call each other through an interface, in trees and circles, on all engines."""

import random
from collections.abc import Callable

import pytest

from scanbench.engines.engine import Engine, Reason
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native import compiler, parts
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.program import Program
from scanbench.symbols.symbols import resolve
from tests.caseformat import first_difference
from tests.engines.test_debug import agree
from tests.engines.test_observe import check

NODES = 6
SOURCE = f"""
INTERFACE INode
METHOD Sum : DINT
VAR_INPUT depth : INT; tag : STRING[8]; END_VAR
VAR_OUTPUT path : STRING[60]; count : INT; END_VAR
END_METHOD
END_INTERFACE
FUNCTION_BLOCK Node IMPLEMENTS INode
VAR PUBLIC parts : ARRAY[1..2] OF INode; value : INT; seen : DINT; END_VAR
METHOD PUBLIC Sum : DINT
VAR_INPUT depth : INT; tag : STRING[8]; END_VAR
VAR_OUTPUT path : STRING[60]; count : INT; END_VAR
VAR i, n : INT; below : STRING[60]; own : ARRAY[1..2] OF DINT; total : DINT; END_VAR
seen := seen + 1;
path := CONCAT(tag, '(');
FOR i := 1 TO 2 DO
  IF parts[i] <> NULL THEN
    total := total + i * parts[i].Sum(depth := depth + 1, tag := CONCAT(tag, INT_TO_STRING(i)), path => below, count => n) + depth;
    path := CONCAT(CONCAT(path, below), ',');
    own[i] := total;
    count := count + n;
  END_IF
END_FOR
count := count + 1;
Sum := total + value + own[1] - own[2];
END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main
VAR nodes : ARRAY[1..{NODES}] OF Node; links : ARRAY[1..{NODES}, 1..2] OF INT; i, j, count : INT; sum : DINT; path : STRING[60]; END_VAR
FOR i := 1 TO {NODES} DO
  nodes[i].value := i;
  FOR j := 1 TO 2 DO
    IF links[i, j] > 0 THEN nodes[i].parts[j] := nodes[links[i, j]]; ELSE nodes[i].parts[j] := NULL; END_IF
  END_FOR
END_FOR
sum := nodes[1].Sum(0, 'r', path, count);
END_PROGRAM
"""


def link(program: Program, memories: list[bytearray], made: random.Random, back: bool) -> None:
    """Links each node to others at random: to later ones only, or back as well."""
    start = resolve(program, "Main.links[1, 1]").offset
    for node in range(1, NODES + 1):
        for part in range(2):
            other = made.randint(1, NODES) if back else made.randint(node, NODES)
            given = 0 if (other == node and not back) or made.random() < 0.4 else other
            for memory in memories:
                memory[start + 4 * (node - 1) + 2 * part : start + 4 * (node - 1) + 2 * part + 2] = given.to_bytes(
                    2, "little"
                )


@pytest.mark.parametrize("whole", [True, False], ids=["one module", "a module for each POU"])
def test_both_engines_call_alike(whole: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    if not whole:
        monkeypatch.setattr(parts, "SMALL", 0)
        monkeypatch.setattr(compiler, "WHOLE", 0)
    program = check(SOURCE)
    made = random.Random(17)
    makes: list[Callable[[Program, bytearray], Engine]] = [ReferenceEngine, NativeEngine]
    memories = [bytearray(program.initial_image) for _ in makes]
    running = [make(program, memory) for make, memory in zip(makes, memories, strict=True)]
    trapped = 0
    for number in range(60):
        link(program, memories, made, back=number % 4 == 0)
        stops = {engine.run(1) for engine in running}
        assert len(stops) == 1, f"scan {number}: {stops}"
        assert not first_difference(program, *memories), f"scan {number}"
        if stops.pop().reason is Reason.TRAP:
            trapped += 1
            for memory in memories:
                memory[:] = program.initial_image
    assert 0 < trapped < 16


def test_debugged_engines_halt_alike() -> None:
    links = ", ".join(str(each) for each in (2, 3, 4, 0, 4, 5, 0, 6, 0, 0, 0, 0))
    assert agree(check(SOURCE.replace("OF INT; i,", f"OF INT := [{links}]; i,"))) > 50
