"""Sections of variables."""

from tests.syntax.shown import complaints, show, well


def test_sections_and_their_qualifiers() -> None:
    file = well(
        """FUNCTION_BLOCK b
VAR_INPUT RETAIN a : INT; END_VAR
VAR CONSTANT PRIVATE c : INT := 1; END_VAR;
VAR PUBLIC NON_RETAIN d : INT; END_VAR
VAR PERSISTENT RETAIN e : INT; END_VAR
VAR_IN_OUT CONSTANT f : INT; END_VAR
VAR_EXTERNAL CONSTANT g : INT; END_VAR
VAR_STAT h : INT; END_VAR
VAR_TEMP i : INT; END_VAR
VAR END_VAR
VAR retain : INT; private AT %I* : INT; END_VAR
END_FUNCTION_BLOCK"""
    )
    found = [(each.keyword, each.qualifiers, each.access) for each in file.pous[0].sections]
    assert found == [
        ("VAR_INPUT", ("RETAIN",), "PROTECTED"),
        ("VAR", ("CONSTANT",), "PRIVATE"),
        ("VAR", ("NON_RETAIN",), "PUBLIC"),
        ("VAR", ("PERSISTENT", "RETAIN"), "PROTECTED"),
        ("VAR_IN_OUT", ("CONSTANT",), "PROTECTED"),
        ("VAR_EXTERNAL", ("CONSTANT",), "PROTECTED"),
        ("VAR", (), "PROTECTED"),
        ("VAR_TEMP", (), "PROTECTED"),
        ("VAR", (), "PROTECTED"),
        ("VAR", (), "PROTECTED"),
    ]


def test_variables() -> None:
    text = """PROGRAM p VAR
a, b : INT := 5;
c AT %MW3 : INT;
d AT %I* : INT;
f : INT AT D100 := 3;
AT %IX1.0 : BOOL;
clk : BOOL R_EDGE; down : BOOL F_EDGE := FALSE;
{attribute 'hide'} inst : Lib.Block(IN := TRUE, n := 3);
END_VAR END_PROGRAM"""
    variables = well(text).pous[0].sections[0].variables
    assert [show(each) for each in variables] == [
        "Variable(name=a, type=INT, initial=5)",
        "Variable(name=b, type=INT, initial=5)",
        "Variable(name=c, type=INT, address=%MW3)",
        "Variable(name=d, type=INT, address=%I*)",
        "Variable(name=f, type=INT, initial=3, address=D100)",
        "Variable(name=clk, type=BOOL, edge=R)",
        "Variable(name=down, type=BOOL, initial=0, edge=F)",
        "Variable(name=inst, type=Lib.Block, arguments=[Argument(name=IN, value=1), Argument(name=n, value=3)])",
    ]
    assert (variables[2].address_span.column, variables[2].address_span.end_column) == (6, 10)  # type: ignore[union-attr]


def test_bad_declarations_are_skipped_one_by_one() -> None:
    text = "PROGRAM p\nVAR\na INT;\nb : INT;\nc : ;\nd, : INT;\n IF : INT;\nx AT : INT;\ne : INT\nEND_VAR\nx := 1;\nEND_PROGRAM"
    assert [each[:8] for each in complaints(text)] == [
        "S003 3:3",
        "S003 5:5",
        "S003 6:4",
        "S003 7:2",
        "S003 8:6",
        "S003 9:7",
    ]
    text = "PROGRAM p\nVAR\na : INT;\nx := 1;\nEND_PROGRAM"
    assert complaints(text) == [
        "S003 4:3 `:` expected after `x`, then its type, found `:=`.",
        "S003 5:1 `END_VAR` expected to close the VAR of line 2, found `END_PROGRAM`.",
    ]


def test_refused_sections() -> None:
    assert complaints("FUNCTION_BLOCK b\nVAR_INPUT n : INT<; END_VAR\nEND_FUNCTION_BLOCK") == [
        "S003 2:19 an expression (a value, variable or call) expected, found `;`."
    ]
    assert complaints("PROGRAM p\nVAR_ACCESS a : b : INT; END_VAR\nVAR x : INT; END_VAR\nEND_PROGRAM") == [
        "X001 2:1 VAR_ACCESS in a PROGRAM is not supported; write it inside of the CONFIGURATION."
    ]
