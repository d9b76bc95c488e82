"""The language server inside of sequential function charts."""

from scanbench.language.complete import complete
from scanbench.language.navigate import named_at
from scanbench.language.rename import CannotRename, places
from scanbench.language.symbols import entries
from tests.language.reading import FILE, at, read

TEXT = """\
PROGRAM Main
VAR go, lamp : BOOL; n : INT; END_VAR
INITIAL_STEP Wait:
END_STEP
STEP Work:
    lamp(N);
    Count(P1);
END_STEP
ACTION Count: n := n + 1; END_ACTION
TRANSITION FROM Wait TO Work := go; END_TRANSITION
TRANSITION FROM Work TO Wait := Work.T > T#1s AND NOT go; END_TRANSITION
END_PROGRAM
"""


def test_every_use_is_found() -> None:
    reading = read(TEXT)
    for name, number in (("Work", 4), ("Wait", 3), ("Count", 2), ("lamp", 2), ("go", 3)):
        found = named_at(reading, FILE, at(reading, name))
        assert found is not None, name
        named = places(reading, found.symbol, "renamed")
        assert not isinstance(named, CannotRename)
        assert len(named) == number, name


def test_steps_and_their_parts_are_offered() -> None:
    text = TEXT.replace("Work.T >", "Work. >")
    reading = read(text)
    assert [each.label for each in complete(reading, FILE, at(reading, "Work. ") + 5)] == ["X", "T"]
    assert {"Wait", "Work", "go"} <= {each.label for each in complete(reading, FILE, at(reading, "go; END"))}


def test_the_outline_has_the_steps_but_not_what_the_chart_remembers() -> None:
    (main,) = entries(read(TEXT), FILE)
    names = [each.name for outer in main.inner for each in (outer, *outer.inner)]
    assert not [name for name in names if "$" in name]
    assert {"go", "lamp", "n", "Count"} <= set(names)
