"""Which variables of blocks have no effect, whatever is stored in them; and whose state of a library's block counts."""

from collections.abc import Iterator

import pytest

from scanbench.check.build import check_sources
from scanbench.check.holding import Holders
from scanbench.check.program import Program
from scanbench.check.symbols import Symbol, members, resolve
from scanbench.plcmodel.load import load_all, model_directory

MODELS, _ = load_all(model_directory())

SOURCE = """
TYPE Pair : STRUCT left, right : INT; END_STRUCT; END_TYPE
FUNCTION_BLOCK Inner
VAR_INPUT i : INT; END_VAR
VAR_OUTPUT o : INT; END_VAR
VAR
  seen : BOOL; used : INT; counted : INT; spot : INT; list : ARRAY[0..3] OF INT; byMethod : INT; inInOut : INT; pair : Pair;
  limited : INT; table : ARRAY[0..3] OF Pair; shifted : ARRAY[0..1] OF INT;
END_VAR
METHOD Tell : INT
  Tell := byMethod;
END_METHOD
  IF i > 3 THEN seen := TRUE; END_IF;
  used := i;
  counted := counted + 1;
  limited := LIMIT(0, limited + 1, 9);
  spot := i MOD 4;
  list[spot] := 1;
  table[spot].left := i;
  pair.left := i; pair.right := i;
  shifted[0] := i; shifted[1] := shifted[0];
  byMethod := i;
  Into(x := inInOut);
  o := used + pair.right + table[i MOD 2].left;
END_FUNCTION_BLOCK

FUNCTION Into
VAR_IN_OUT x : INT; END_VAR
  x := x + 1;
END_FUNCTION

PROGRAM Main
VAR one : Inner; mine : INT; END_VAR
  one(i := mine);
  IF mine > 3 THEN mine := one.Tell(); END_IF;
END_PROGRAM
"""


def program(source: str, name: str = "GENERIC-IEC") -> Program:
    checked = check_sources({"main.st": source}, next(each for each in MODELS if each.name == name), 10_000_000)
    assert checked.program is not None, checked.problems
    return checked.program


def below(made: Program, path: str) -> Iterator[Symbol]:
    for symbol in members(made, path):
        if symbol.expandable:
            yield from below(made, symbol.path)
        elif not symbol.slots:
            yield symbol


def told(made: Program, path: str) -> dict[str, str]:
    """Variables below a path that count: by the path, the block of the library that they are only the state of."""
    holders, found = Holders(made), {}
    for symbol in below(made, path):
        for held in holders.at(symbol.offset & ~1, 0xFF << 8 * (symbol.offset & 1)):
            assert held.symbol.path == symbol.path
            found[symbol.path.removeprefix(path + ".")] = held.block
    return found


def test_private_variables_that_nothing_reads() -> None:
    made = program(SOURCE)
    every = {each.path.removeprefix("Main.one.") for each in below(made, "Main.one")}
    unread = every - told(made, "Main.one").keys()
    assert unread == {
        "i", "seen", "counted", "limited", "list[0]", "list[1]", "list[2]", "list[3]", "pair.left", "shifted[1]",
        "table[3].right",  # behind the last that a computed index can come to
    }  # fmt: skip
    assert "mine" in told(made, "Main")


TIMERS = """
FUNCTION_BLOCK Holder
VAR_INPUT go : BOOL; END_VAR
VAR_OUTPUT late : BOOL; END_VAR
VAR inside, forgotten : TON; END_VAR
  inside(IN := go, PT := T#1s); forgotten(IN := go, PT := T#1s);
  late := inside.Q;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Taking
VAR_IN_OUT timer : TOF; END_VAR
VAR x : BOOL; END_VAR
  x := timer.Q; IF x THEN timer(IN := FALSE); END_IF;
END_FUNCTION_BLOCK
FUNCTION_BLOCK ByMethod
VAR t, u : TP; END_VAR
METHOD Over : BOOL
  Over := t.Q;
END_METHOD
  t(PT := T#1s); u(PT := T#1s);
END_FUNCTION_BLOCK
VAR_GLOBAL everywhere, nowhere : TON; END_VAR
PROGRAM Main
VAR
  read, unread, byOutput : TON; r, s : R_TRIG; c : CTU; h : Holder; lent : TOF; t : Taking; m : ByMethod;
  row : ARRAY[0..2] OF TON; fixed : ARRAY[0..2] OF TON; lone : TOF_LTIME; far : TP_LTIME; f : F_TRIG;
  way : REF_TO TP_LTIME := REF(far); way2 : REF_TO TOF_LTIME; go, x : BOOL; n : INT;
END_VAR
  read(IN := go, PT := T#1s); unread(IN := go, PT := T#1s); byOutput(IN := go, PT := T#1s, Q => x);
  r(CLK := go); s(CLK := go); c(CU := go, PV := 3); h(go := go); t(timer := lent); f(CLK := go); m();
  everywhere(IN := go, PT := T#1s); nowhere(IN := go, PT := T#1s);
  row[n](IN := go, PT := T#1s); fixed[0](IN := go, PT := T#1s); lone(IN := go); far(IN := go);
  IF read.Q OR s.Q OR c.CV > 5 OR row[n].Q OR fixed[1].Q OR everywhere.Q OR m.Over() OR way^.Q THEN x := TRUE; END_IF;
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("block", "read"),
    [
        ("Main.read", {"Q"}), ("Main.unread", None), ("Main.byOutput", {"Q"}), ("Main.r", None), ("Main.s", {"Q"}),
        ("Main.c", {"CV"}), ("Main.h.inside", {"Q"}), ("Main.h.forgotten", None), ("Main.lent", {"Q"}), ("Main.m.t", {"Q"}),
        ("Main.m.u", None), ("Main.row[2]", {"Q"}), ("Main.fixed[0]", None), ("Main.fixed[1]", {"Q"}), ("Main.f", None),
        ("Main.lone", None), ("Main.far", {"Q"}), ("everywhere", {"Q"}), ("nowhere", None),
    ],
)  # fmt: skip
def test_the_state_of_a_librarys_block_counts_where_somebody_reads_an_output_of_this_one(
    block: str, read: set[str] | None
) -> None:
    """Outputs that are read are variables like others; the rest is state of the block; of one that nobody asks nothing counts."""
    made = program(TIMERS)
    found = told(made, block)
    if read is None:
        assert found == {}
        return
    assert {name for name, of in found.items() if not of} >= read
    inside = {name for name, of in found.items() if of}
    private = {each.name for each in members(made, block) if each.section == "VAR"}
    assert private <= inside
    assert {of for of in found.values() if of} == {resolve(made, block).path}


def test_behind_a_pointer_everything_may_be_read() -> None:
    source = """
PROGRAM Main
VAR unread : TON; p : POINTER TO BOOL; x : BOOL; END_VAR
  unread(IN := x, PT := T#1s); p := ADR(x); x := p^;
END_PROGRAM
"""
    assert "Q" in told(program(source), "Main.unread")


def test_a_name_for_tools_reads_it() -> None:
    source = """
PROGRAM Main
VAR a, b : TON; x : BOOL; END_VAR
  a(IN := x, PT := T#1s); b(IN := x, PT := T#1s);
END_PROGRAM
CONFIGURATION C
  RESOURCE R ON PLC
    TASK T(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM P WITH T : Main;
  END_RESOURCE
  VAR_ACCESS Over : R.P.a.Q : BOOL READ_ONLY; END_VAR
END_CONFIGURATION
"""
    made = program(source)
    assert "Q" in told(made, "P.a")
    assert told(made, "P.b") == {}
