"""__TRY on both engines and their debug flavours: random programs that trap, leave and go on."""

import random

import pytest

from scanbench.check.build import check_sources
from scanbench.check.libraries.catalogue import used_libraries
from scanbench.engines.engine import Reason
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.program import Program
from scanbench.syntax.language_file import with_dialect
from tests.amounts import amount
from tests.caseformat import MODELS, first_difference
from tests.engines.test_debug import agree

FUNCTIONS, SCANS = 3, 6
HEAD = "VAR i{depths} : DINT; e : __SYSTEM.ExceptionCode; END_VAR\n"


def statements(chance: random.Random, callees: list[str], depth: int, final: bool, loops: int = 0) -> str:
    """Some statements; in a __FINALLY none leaves it."""
    return "\n".join(_statement(chance, callees, depth, final, loops) for _ in range(chance.randint(1, 3)))


def _statement(chance: random.Random, callees: list[str], depth: int, final: bool, loops: int) -> str:
    number = chance.randint(1, 9)
    kind = chance.choice(
        ["note", "note", "trap", "call", "leave"]
        if depth > 3
        else ["note", "trap", "call", "leave", "try", "try", "loop", "if"]
    )
    inner = (chance, callees, depth + 1, final)
    match kind:
        case "trap":
            return chance.choice([
                f"d := {number} / ((n + {number}) MOD 3);", f"list[(n + {number}) MOD 4] := {number};",
                f"IF n MOD {number} = 0 THEN p := NULL; ELSE p := ADR(d); END_IF d := d + p^;",
            ])  # fmt: skip
        case "call" if callees:
            return f"total := total * 3 + {chance.choice(callees)}({number}, level := list[1]);"
        case "leave" if not final:
            ways = ["RETURN;"] + ["EXIT;", "CONTINUE;"] * (loops > 0)
            return f"IF (n + {number}) MOD 4 = 0 THEN {chance.choice(ways)} END_IF"
        case "try":
            last = f"__FINALLY\n{statements(chance, callees, depth + 1, True)}\n" if chance.random() < 0.6 else ""
            caught = "total := total * 5 + TO_DINT(e);\n" + statements(*inner, loops)
            return f"__TRY\n{statements(*inner, loops)}\n__CATCH(e)\n{caught}\n{last}__ENDTRY"
        case "loop":
            return (
                f"FOR i{depth} := 1 TO {chance.randint(1, 4)} DO\nn := n + 1;\n{statements(*inner, loops + 1)}\nEND_FOR"
            )
        case "if":
            return f"IF n MOD 2 = 0 THEN\n{statements(*inner, loops)}\nELSE\n{statements(*inner, loops)}\nEND_IF"
    return f"total := total * 7 + {number}; n := n + 1;"


def made(seed: int) -> Program:
    chance = random.Random(seed)
    depths = ", i".join(map(str, range(6)))
    text = "VAR_GLOBAL total, n, d : DINT; list : ARRAY[1..3] OF DINT; p : POINTER TO DINT; END_VAR\n"
    callees: list[str] = []
    for number in range(FUNCTIONS):
        name = f"F{number}"
        text += f"FUNCTION {name} : DINT\nVAR_INPUT a : DINT; END_VAR VAR_IN_OUT level : DINT; END_VAR\n{HEAD.format(depths=depths)}"
        text += f"level := level + a; {name} := a;\n{statements(chance, callees, 0, False)}\n{name} := {name} + n;\nEND_FUNCTION\n"
        callees.append(name)
    text += f"FUNCTION_BLOCK Unit\nVAR_OUTPUT done : DINT; END_VAR\n{HEAD.format(depths=depths)}"
    text += f"{statements(chance, callees, 0, False)}\ndone := done + 1;\nEND_FUNCTION_BLOCK\n"
    text += f"PROGRAM Main\nVAR unit : Unit; ended : DINT; END_VAR\n{HEAD.format(depths=depths)}n := n + 1;\n__TRY\n"
    text += f"{statements(chance, callees, 0, False)}\nunit();\n{statements(chance, callees, 0, False)}\n"
    text += "__CATCH(e)\ntotal := total + 1;\n__FINALLY\nended := ended + 1;\n__ENDTRY\nEND_PROGRAM\n"
    sources = with_dialect({"a.st": text}, "codesys")
    sources |= {each.path: each.text for each in used_libraries(sources, "codesys")}
    checked = check_sources(sources, MODELS["GENERIC-IEC"])
    assert checked.program is not None, "\n".join(map(str, checked.problems)) + text
    return checked.program


SEEDS = pytest.mark.parametrize(
    "seed", [pytest.param(each, marks=[] if each < 5 else pytest.mark.nightly) for each in range(amount(100, 5))]
)


@SEEDS
def test_engines_agree_on_programs_that_trap_and_go_on(seed: int) -> None:
    program = made(seed)
    memories = [bytearray(program.initial_image) for _ in range(2)]
    engines = [ReferenceEngine(program, memories[0]), NativeEngine(program, memories[1])]
    for scan in range(SCANS):
        stops = {engine.run(1) for engine in engines}
        assert len(stops) == 1
        assert not first_difference(program, *memories), scan
        assert next(iter(stops)).reason is Reason.DONE, "Main catches all there is"


@SEEDS
def test_debugged_code_tells_the_same_statements_frames_and_accesses(seed: int) -> None:
    agree(made(seed))
