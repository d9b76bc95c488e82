"""The language server inside of rungs."""

from scanbench.language.complete import complete
from scanbench.language.navigate import named_at
from scanbench.language.rename import CannotRename, places
from scanbench.language.signature import signature_at
from scanbench.language.symbols import entries
from tests.language.reading import FILE, at, read

TEXT = """\
PROGRAM Main
VAR run, stuck : BOOL; jam : TON; n : INT; END_VAR
RUNG hold: "Holds"
    < [run] | [P run] > [/jam.Q] jam(IN := ~, PT := T#1s).Q (S stuck)
    [run] n := ADD(EN := ~, IN1 := n, IN2 := 1).ENO (run)
END_RUNG
END_PROGRAM
"""


def test_every_use_is_found() -> None:
    reading = read(TEXT)
    for name, number in (("run", 5), ("jam", 3), ("stuck", 2)):
        found = named_at(reading, FILE, at(reading, name))
        assert found is not None
        named = places(reading, found.symbol, "renamed")
        assert not isinstance(named, CannotRename)
        assert len(named) == number, name


def test_variables_and_outputs_are_offered() -> None:
    text = TEXT.replace("(S stuck)", "(S )").replace("/jam.Q", "/jam.")
    reading = read(text)
    assert {"run", "stuck", "jam"} <= {each.label for each in complete(reading, FILE, at(reading, "(S )") + 3)}
    assert [each.label for each in complete(reading, FILE, at(reading, "/jam.") + 5)] == ["IN", "PT", "Q", "ET"]


def test_a_box_shows_its_parameters() -> None:
    reading = read(TEXT)
    found = signature_at(reading, FILE, at(reading, "T#1s"))
    assert found is not None
    assert (found.name, found.active) == ("jam", 1)


def test_the_memory_of_an_edge_is_no_variable_of_the_outline() -> None:
    (main,) = entries(read(TEXT), FILE)
    assert [(each.name, [inner.name for inner in each.inner]) for each in main.inner] == [
        ("VAR", ["run", "stuck", "jam", "n"])
    ]


def test_the_memory_of_an_edge_is_no_declaration() -> None:
    reading = read(TEXT)
    names = {
        each.name
        for chunk in reading.files[FILE].chunks
        for found in reading.part(chunk).declared.values()
        for each in found
    }
    assert names == {"Main", "run", "stuck", "jam", "n"}
