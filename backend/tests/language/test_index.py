"""Every name of a program resolves, and the names that are kept over edits are those that a fresh check finds."""

import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from scanbench.check.uses import Symbol
from scanbench.language.declared import Declared
from scanbench.language.index import Occurrence
from scanbench.language.reading import Reading, Readings
from scanbench.problems import Severity
from scanbench.program.types import ABBREVIATIONS, ELEMENTARY
from scanbench.syntax import tree
from scanbench.syntax.chart import QUALIFIERS, Chart
from scanbench.syntax.conditions import chosen
from scanbench.syntax.lexer import Lex, tokenize
from scanbench.syntax.networks import NetworkBody
from scanbench.syntax.source import Source
from tests.amounts import nightly, some
from tests.caseformat import MODELS, read_cases
from tests.language.reading import FILE, at, read

CASES = Path(__file__).parent.parent / "cases"
WORDS = frozenset(
    """
    ABSTRACT ACTION ACTIONS END_ACTIONS ARRAY BY CLASS CONSTANT EXTENDS FINAL F_EDGE GET IMPLEMENTS INTERFACE INTERNAL INTERVAL METHOD NAMESPACE
    NON_RETAIN NULL ON OVERLAP OVERRIDE PERSISTENT POINTER PRIORITY PRIVATE PROPERTY PROPERTY_GET PROPERTY_SET PROTECTED PUBLIC
    READ_ONLY READ_WRITE REFERENCE REF REF_TO RESOURCE RETAIN R_EDGE SET SINGLE STRING SUPER TASK THIS UNION USING WITH WSTRING
    INITIAL_STEP STEP END_STEP TRANSITION END_TRANSITION FROM RUNG END_RUNG NETWORK END_NETWORK JMP PLC CPU CONTINUE R S ANY ANY_NUM ANY_INT ANY_REAL ANY_BIT ANY_STRING ANY_DATE ANY_ELEMENTARY ANY_MAGNITUDE CIO
    """.split()
)
"""Words of the language that the lexer takes as names, as programs may use them as names."""


@nightly
@pytest.mark.parametrize("topic", some(sorted(path.stem for path in CASES.glob("*.case")), 4, 0))
def test_every_name_of_a_case_means_something(topic: str) -> None:
    for case in read_cases(CASES / f"{topic}.case"):
        files = {FILE: case.source, **case.files}
        reading = Readings(MODELS[case.model], case.interval_ns).read(files)
        if any(problem.severity is Severity.ERROR for problem in reading.checked.problems):
            continue
        # What an external FUNCTION takes any number of (`args : ...`) has no variable that a name could mean.
        missing = [each for each in unresolved(reading) if not ("..." in case.source and each.startswith("args "))]
        assert not missing, f"{case.name}: {missing}"


def unresolved(reading: Reading) -> list[str]:
    """Names that mean nothing; but not words of the language, parameters of standard functions, names of namespaces, tasks and
    program instances, operators and labels of IL, and what only a network knows."""
    source = Source(FILE, reading.text(FILE))
    tokens, _ = chosen(source, tokenize(source)[0])
    names = reading.index.between(FILE, 0, len(reading.text(FILE)) + 1)
    known = {reading.place(FILE, first) for first, _, _ in names}
    known |= {(each.span.line, each.span.column) for each in declared(reading)}
    types = {*ELEMENTARY, *ABBREVIATIONS}
    found = []
    for number, (kind, text, start) in enumerate(zip(tokens.kinds, tokens.texts, tokens.starts, strict=True)):
        if kind is not Lex.NAME:
            continue
        upper, before = text.upper(), tokens.texts[number - 1].upper()
        # wires, links and labels of networks, names of transitions, modes of contacts and coils, qualifiers of actions
        mode = (upper in ("P", "N") and before == "[") or (upper in QUALIFIERS and before == "(")
        if before in ("#", "RUNG", "NETWORK", "JMP", "TRANSITION") or mode:
            continue
        formal = tokens.texts[number + 1] in (":=", "=>") and tokens.texts[number - 1] in ("(", ",", "NOT")
        around = reading.around(FILE, start)
        if around and isinstance(around.pou.body, Chart) and (before, upper) == (".", "Q"):
            continue  # of an action: hidden
        if around and isinstance(around.inner.body, NetworkBody) and tokens.texts[number - 2 : number] == [")", "."]:
            continue  # an output of a box that is a FUNCTION: it has no variable outside of the box
        if around and is_switched_off(around.inner.body, reading.place(FILE, start)[0]):
            continue
        if "CONFIGURATION" in reading.holding(FILE, start) or (around and isinstance(around.inner.body, tree.IlBody)):
            continue
        line = reading.text(FILE).splitlines()[reading.place(FILE, start)[0] - 1].upper()
        if "NAMESPACE " in line or "USING " in line or line.startswith("ACTIONS ") or tokens.texts[number + 1] == ".":
            continue
        word = tokens.texts[number - 1] == "AT" or upper in WORDS or upper in types or upper in ("EN", "ENO")
        if not word and not formal and reading.place(FILE, start) not in known:
            found.append(f"{text} in line {reading.place(FILE, start)[0]}")
    return found


def is_switched_off(body: object, line: int) -> bool:
    """Whether the line is in a network that is not compiled."""
    above = [each for each in body.networks if each.span.line <= line] if isinstance(body, NetworkBody) else []
    return bool(above) and above[-1].off


def declared(reading: Reading) -> list[Declared]:
    parts = [reading.part(chunk) for chunk in reading.files[FILE].chunks]
    return [each for part in parts for found in part.declared.values() for each in found]


def place(reading: Reading, found: Occurrence) -> tuple[int, int]:
    return found.span.line, found.span.column


PROGRAM = """\
TYPE Color : (RED, GREEN); END_TYPE
TYPE Point : STRUCT x, y : INT; END_STRUCT; END_TYPE
FUNCTION_BLOCK Inc
VAR_INPUT by : INT; END_VAR
VAR_OUTPUT n : INT; END_VAR
n := n + by;
END_FUNCTION_BLOCK
FUNCTION Twice : INT
VAR_INPUT value : INT; END_VAR
Twice := value * 2;
END_FUNCTION
PROGRAM Main
VAR a, b : INT; inc : Inc; color : Color; point : Point; END_VAR
inc(by := Twice(a));
b := inc.n + point.x;
IF color = RED THEN a := LIMIT(0, b, 9); END_IF;
END_PROGRAM
"""


@pytest.mark.parametrize("seed", range(6))
def test_names_kept_over_edits_are_those_of_a_fresh_check(seed: int) -> None:
    chosen = random.Random(seed)
    readings = Readings(MODELS["GENERIC-IEC"])
    text = PROGRAM
    for _ in range(25):
        cut = chosen.randrange(len(text))
        edit = chosen.choice(("\n", " ", "a", "b := a;", "inc.n", "(* *)", "", "", "END_IF;"))
        text = text[:cut] + edit + text[cut + (0 if edit else chosen.randrange(4)) :]
        kept = readings.read({FILE: text})
        fresh = Readings(MODELS["GENERIC-IEC"]).read({FILE: text})
        assert names(kept) == names(fresh), text
        if chosen.random() < 0.4:
            text = PROGRAM


def names(reading: Reading) -> set[tuple[int, int, Symbol, bool]]:
    """Every use with its place; and where everything is declared."""
    uses = {(*place(reading, each), each.symbol, each.written) for each in occurrences(reading)}
    return uses | {(each.span.line, each.span.column, each.symbol, False) for each in declared(reading)}


def occurrences(reading: Reading) -> Iterator[Occurrence]:
    for _, after, _ in reading.index.between(FILE, 0, len(reading.text(FILE)) + 1):
        found = reading.index.at(FILE, after)
        assert found is not None
        yield found


def test_what_is_written_is_told_from_what_is_read() -> None:
    reading = read("PROGRAM Main VAR a : ARRAY[0..3] OF INT; i, n : INT; END_VAR\na[i] := n;\nEND_PROGRAM")
    found = {each.symbol.name: each.written for each in occurrences(reading)}
    assert found == {"A": True, "I": False, "N": False}


def test_the_result_of_a_function_of_a_namespace_is_the_function() -> None:
    reading = read("NAMESPACE Plant\nFUNCTION Half : INT\nHalf := 1;\nEND_FUNCTION\nEND_NAMESPACE")
    assert [each.symbol for each in occurrences(reading)] == [Symbol("pou", "", "PLANT.HALF")]


def test_the_name_at_a_position_is_the_one_that_it_is_in_or_after() -> None:
    reading = read(PROGRAM)
    for text, symbol in (
        ("inc.n", Symbol("variable", "MAIN", "INC")), ("n + point", Symbol("variable", "INC", "N")),
        ("RED THEN", Symbol("value", "COLOR", "RED")), ("LIMIT", Symbol("function", "", "LIMIT")),
        ("Twice(a)", Symbol("pou", "", "TWICE")), ("Point; END_VAR", Symbol("type", "", "POINT")),
        ("by := Twice", Symbol("variable", "INC", "BY")), ("Twice := value", Symbol("pou", "", "TWICE")),
    ):  # fmt: skip
        found = reading.index.at(FILE, at(reading, text))
        assert found is not None, text
        assert found.symbol == symbol
    after = reading.index.at(FILE, at(reading, "inc.n") + 3)
    assert after is not None
    assert after.symbol == Symbol("variable", "MAIN", "INC")
    assert reading.index.at(FILE, at(reading, "* 2") + 1) is None
