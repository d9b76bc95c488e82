"""Which variables of blocks have no effect, whatever is stored in them."""

from scanbench.check.build import check_sources
from scanbench.check.unread import unread
from scanbench.plcmodel.load import load_all, model_directory

SOURCE = """
FUNCTION_BLOCK Inner
VAR_INPUT i : INT; END_VAR
VAR_OUTPUT o : INT; END_VAR
VAR seen : BOOL; used : INT; counted : INT; spot : INT; list : ARRAY[0..3] OF INT; byMethod : INT; inInOut : INT; END_VAR
METHOD Tell : INT
  Tell := byMethod;
END_METHOD
  IF i > 3 THEN seen := TRUE; END_IF;
  used := i;
  counted := counted + 1;
  spot := i MOD 4;
  list[spot] := 1;
  byMethod := i;
  Into(x := inInOut);
  o := used;
END_FUNCTION_BLOCK

FUNCTION Into
VAR_IN_OUT x : INT; END_VAR
  x := x + 1;
END_FUNCTION

PROGRAM Main
VAR one : Inner; read : TON; unreadTimer : TOF; mine : INT; END_VAR
  one(i := mine);
  read(IN := mine > 3, PT := T#1s);
  unreadTimer(IN := mine > 3, PT := T#1s);
  IF read.Q THEN mine := one.Tell(); END_IF;
END_PROGRAM
"""


def test_private_variables_that_nothing_reads() -> None:
    models, _ = load_all(model_directory())
    model = next(each for each in models if each.name == "GENERIC-IEC")
    checked = check_sources({"main.st": SOURCE}, model, 10_000_000)
    assert checked.program is not None, checked.problems
    found = unread(checked.program)
    assert {name for name in found if name.startswith("INNER.")} == {"INNER.SEEN", "INNER.COUNTED", "INNER.LIST"}
    assert "TON.Q" not in found
    assert {"TON.ET", "TOF.Q", "TOF.ET"} <= found
    assert not any(name.startswith("MAIN.") for name in found)
