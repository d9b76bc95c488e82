"""Who calls whom."""

from scanbench.language.calls import Calls, incoming, outgoing, party_at
from scanbench.language.reading import Reading
from tests.language.reading import FILE, marked

TEXT = """\
FUNCTION Twice : INT
VAR_INPUT value : INT; END_VAR
Twice := value * 2;
END_FUNCTION
INTERFACE Counts
METHOD Reset : BOOL END_METHOD
END_INTERFACE
FUNCTION_BLOCK Inc IMPLEMENTS Counts
VAR_INPUT by : INT; END_VAR
VAR n : INT; END_VAR
METHOD PUBLIC Reset : BOOL
n := Twice(0);
END_METHOD
n := n + Twice(by) + Twice(LIMIT(0, by, 9));
END_FUNCTION_BLOCK
PROGRAM Main
VAR incs : ARRAY[0..1] OF Inc; any : Counts; i : INT; b : BOOL; END_VAR
FOR i := 0 TO 1 DO incs[i](by := 1); END_FOR;
i := incs[1].by;
any := incs[0];
b := any.Reset();
b := incs[0].Reset();
END_PROGRAM
PROGRAM Listed
VAR inc : Inc; END_VAR
CAL inc(by := 1)
END_PROGRAM
"""


def asked(where: str) -> tuple[Reading, list[Calls], list[Calls]]:
    """Who calls what is named at a place, and whom it calls."""
    reading, position = marked(TEXT.replace(where.replace("|", ""), where, 1))
    party = party_at(reading, FILE, position)
    assert party is not None
    return reading, incoming(reading, party.symbol), outgoing(reading, party.symbol)


def shown(reading: Reading, found: list[Calls]) -> dict[str, list[str]]:
    """By the parties the places of calls: line and name."""
    return {each.party.entry.name: [f"{span.line} {reading.written(span)}" for span in each.names] for each in found}


def test_a_function_is_called_where_its_name_is_called() -> None:
    reading, callers, called = asked("FUNCTION |Twice")
    assert shown(reading, callers) == {"Inc": ["14 Twice", "14 Twice"], "Reset": ["12 Twice"]}
    assert not called


def test_a_condition_after_return_calls() -> None:
    text = TEXT.replace("END_PROGRAM\nPROGRAM Listed", "RETURN(Twice(i) > 1);\nEND_PROGRAM\nPROGRAM Listed")
    reading, position = marked(text.replace("FUNCTION Twice", "FUNCTION |Twice"))
    party = party_at(reading, FILE, position)
    assert party is not None
    assert shown(reading, incoming(reading, party.symbol))["Main"] == ["23 Twice"]


def test_an_instance_that_is_called_calls_its_block() -> None:
    for where in ("FUNCTION_BLOCK I|nc", "i|ncs[i](by", "VAR inc : |Inc"):
        reading, callers, called = asked(where)
        assert shown(reading, callers) == {"Main": ["18 incs"], "Listed": ["26 inc"]}
        assert shown(reading, called) == {"Twice": ["14 Twice", "14 Twice"]}


def test_a_method_may_be_called_through_an_interface() -> None:
    reading, callers, called = asked("METHOD PUBLIC R|eset")
    assert shown(reading, callers) == {"Main": ["21 Reset", "22 Reset"]}
    assert shown(reading, called) == {"Twice": ["12 Twice"]}


def test_a_program_calls_blocks_and_methods() -> None:
    _, callers, called = asked("PROGRAM M|ain")
    assert not callers
    assert [(each.party.symbol.owner, len(each.names)) for each in called] == [("", 1), ("COUNTS", 1), ("INC", 1)]


def test_where_nothing_is_named_that_runs_the_pou_around_is_meant() -> None:
    for where, name in (("|b := any", "Main"), ("n := Twice(0);|", "Reset"), ("END_VAR|\nFOR", "Main")):
        reading, position = marked(TEXT.replace(where.replace("|", ""), where, 1))
        party = party_at(reading, FILE, position)
        assert party is not None
        assert party.entry.name == name


def test_outside_of_all_pous_there_is_no_party() -> None:
    reading, position = marked(TEXT.replace("\nPROGRAM Main", "\n|\nPROGRAM Main"))
    assert party_at(reading, FILE, position) is None


def test_of_a_standard_block_the_pou_around_is_meant() -> None:
    reading, position = marked("PROGRAM Main VAR beat : T|ON; END_VAR beat(); END_PROGRAM")
    party = party_at(reading, FILE, position)
    assert party is not None
    assert party.entry.name == "Main"
