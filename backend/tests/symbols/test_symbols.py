"""Variables by path."""

import pytest

from scanbench.check.build import check_sources
from scanbench.program.program import Program
from scanbench.symbols.names import names_of
from scanbench.symbols.symbols import UnknownPath, complete, members, resolve
from scanbench.symbols.values import format_value, parse_value
from tests.caseformat import MODELS

SOURCE = """
TYPE Zone : STRUCT parts : INT; rate : REAL; END_STRUCT; END_TYPE
VAR_GLOBAL total AT D100 : DINT; flag AT A402.12 : BOOL; END_VAR
FUNCTION_BLOCK Fill VAR_IN_OUT zone : Zone; END_VAR VAR n : INT; END_VAR zone.parts := zone.parts + 1; END_FUNCTION_BLOCK
PROGRAM Main
VAR zones : ARRAY[1..3, 0..1] OF Zone; fill : Fill; k : INT := 2; never : Fill; END_VAR
fill(zone := zones[k, 1]);
IF FALSE THEN never(zone := zones[1, 0]); END_IF;
END_PROGRAM
"""


@pytest.fixture(scope="module")
def program() -> Program:
    made = check_sources({"a.st": SOURCE}, MODELS["CJ1M-CPU63"]).program
    assert made is not None
    return made


def test_paths_are_found_in_any_case(program: Program) -> None:
    assert resolve(program, "main.ZONES[2,1].Parts").path == "Main.zones[2,1].parts"
    assert resolve(program, "d100").path == "D100"
    assert resolve(program, "TOTAL").address == "D100"


@pytest.mark.parametrize("path", ["Main.zones[2, 1].parts", " Main . zones [2,1] . parts"])
def test_blanks_do_not_matter(program: Program, path: str) -> None:
    assert resolve(program, path).path == "Main.zones[2,1].parts"


def test_unknown_paths_name_what_is_near(program: Program) -> None:
    with pytest.raises(UnknownPath) as caught:
        resolve(program, "Main.zoness")
    assert caught.value.near == ("Main.zones",)
    with pytest.raises(UnknownPath, match=r"outside of 1\.\.3"):
        resolve(program, "Main.zones[4,0]")
    with pytest.raises(UnknownPath):
        resolve(program, "Main.k.x")
    with pytest.raises(UnknownPath):
        resolve(program, "D99999")


def test_what_the_model_protects_is_not_writable(program: Program) -> None:
    assert not resolve(program, "A402.12").writable
    assert not resolve(program, "flag").writable
    assert resolve(program, "D100").writable


def test_an_in_out_is_followed_to_what_it_is_bound_to(program: Program) -> None:
    from scanbench.engines.interpreter.engine import ReferenceEngine

    memory = bytearray(program.initial_image)
    symbol = resolve(program, "Main.fill.zone.parts")
    assert symbol.locate(memory) is None
    ReferenceEngine(program, memory).run(1)
    assert symbol.locate(memory) == resolve(program, "Main.zones[2,1].parts").locate(memory)
    assert resolve(program, "Main.never.zone.parts").locate(memory) is None


def test_members_and_completion(program: Program) -> None:
    assert [each.name for each in members(program, "")] == ["Main", "total", "flag"]
    assert [each.path for each in members(program, "Main.zones")][:2] == ["Main.zones[1,0]", "Main.zones[1,1]"]
    assert [each.path for each in complete(program, "Main.zo", 10)] == ["Main.zones"]
    assert "A402.12" in [each.path for each in complete(program, "A402.12", 10)]


def test_a_byte_of_the_image_has_a_name(program: Program) -> None:
    symbol = resolve(program, "Main.zones[3,1].rate")
    place = symbol.locate(program.initial_image)
    assert place is not None
    assert names_of(program).path(place[0] + 2) == "Main.zones[3,1].rate"


@pytest.mark.parametrize(
    ("path", "text", "shown"),
    [
        ("Main.k", "16#7FFF", "32767"), ("Main.k", "-5", "-5"), ("flag", "true", "TRUE"), ("D100", "255", "16#00FF"),
        ("Main.zones[1,0].rate", "1e3", "1000"),
    ],
)  # fmt: skip
def test_values_as_text(program: Program, path: str, text: str, shown: str) -> None:
    type = resolve(program, path).type
    assert format_value(type, parse_value(type, text)) == shown


@pytest.mark.parametrize(
    ("path", "text", "why"),
    [
        ("Main.k", "40000", "-32768 to 32767"),
        ("flag", "5", "TRUE or FALSE"),
        ("Main.k", "abc", "integer"),
        ("Main.zones", "1", "members"),
    ],
)
def test_wrong_values_say_what_fits(program: Program, path: str, text: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        parse_value(resolve(program, path).type, text)


POINTERS = """
TYPE Node : STRUCT v : INT; next : REF_TO Node; END_STRUCT; END_TYPE
PROGRAM Main
VAR a : Node := (v := 1); b : Node := (v := 2); p : REF_TO Node := REF(a); r : REFERENCE TO INT; f : BOOL; x : INT (0..9); END_VAR
f := p <> NULL AND_THEN p^.v = 1; a.next := REF(b); x := a.v;
END_PROGRAM
"""


def test_paths_through_references() -> None:
    program = check_sources({"a.st": POINTERS}, MODELS["GENERIC-IEC"]).program
    assert program is not None
    memory = bytearray(program.initial_image)

    def shown(path: str) -> str | None:
        symbol = resolve(program, path)
        place = symbol.locate(memory)
        return (
            None if place is None else format_value(symbol.type, bytes(memory[place[0] : place[0] + symbol.type.size]))
        )

    assert shown("Main.p^.v") == "1"
    assert shown("Main.p^.next^.v") is None
    at, b = resolve(program, "Main.a.next").offset, resolve(program, "Main.b").offset
    memory[at : at + 8] = b.to_bytes(8, "little")
    assert shown("Main.p^.next^.v") == "2"
    memory[at : at + 8] = (len(memory) - 1).to_bytes(8, "little")
    assert shown("Main.p^.next^.v") is None
    with pytest.raises(UnknownPath, match=r"write `Main.p\^.v`"):
        resolve(program, "Main.p.v")
    with pytest.raises(UnknownPath, match="not a reference"):
        resolve(program, "Main.a^")


def test_what_the_compiler_made_is_not_shown() -> None:
    program = check_sources({"a.st": POINTERS}, MODELS["GENERIC-IEC"]).program
    assert program is not None
    assert not [each.path for each in members(program, "Main") if "$" in each.path]
    assert resolve(program, "_SubrangeErrorCount").constant
    assert resolve(program, "_SubrangeError").writable


PARTS = """
VAR_GLOBAL word AT D200 : WORD; END_VAR
FUNCTION_BLOCK Take VAR_IN_OUT w : WORD; flag : BOOL; END_VAR w.%B1 := 16#12; END_FUNCTION_BLOCK
PROGRAM Main
VAR d : DWORD := 16#89AB_CDEF; i : INT; r : REAL; take : Take; x : BOOL; END_VAR
take(w := word, flag := x);
END_PROGRAM
"""


@pytest.fixture(scope="module")
def parts() -> Program:
    made = check_sources({"a.st": PARTS}, MODELS["CJ1M-CPU63"]).program
    assert made is not None
    return made


@pytest.mark.parametrize(
    ("path", "type", "at", "bit"),
    [
        ("Main.d.31", "BOOL", 3, 7),
        ("main.d.%x9", "BOOL", 1, 1),
        ("Main.d.%B2", "BYTE", 2, None),
        ("Main.d . %W1", "WORD", 2, None),
    ],
)
def test_parts_of_a_number_have_paths(parts: Program, path: str, type: str, at: int, bit: int | None) -> None:
    symbol = resolve(parts, path)
    whole = resolve(parts, "Main.d")
    assert (symbol.type.name, symbol.offset - whole.offset, symbol.bit) == (type, at, bit)
    assert symbol.writable
    assert resolve(parts, symbol.path) == symbol


def test_parts_of_located_variables_say_their_address(parts: Program) -> None:
    assert resolve(parts, "word.3").address == "D200.03"
    assert resolve(parts, "word.%B1").address == "D200.08-15"


def test_a_bit_of_what_an_in_out_is_bound_to_is_that_bit(parts: Program) -> None:
    from scanbench.engines.interpreter.engine import ReferenceEngine

    memory = bytearray(parts.initial_image)
    ReferenceEngine(parts, memory).run(1)
    assert resolve(parts, "Main.take.w.9").locate(memory) == resolve(parts, "word.9").locate(memory)
    assert resolve(parts, "Main.take.w.9").locate(memory)[1] == 1  # type: ignore[index]
    assert resolve(parts, "Main.take.w.0").locate(memory)[1] == 0  # type: ignore[index]


@pytest.mark.parametrize(
    ("path", "says"),
    [
        ("Main.r.3", "only integers and bit strings"),
        ("Main.d.32", "it has 32 of that size"),
        ("Main.d.%D0", "no larger than that"),
        ("Main.x.0", "only integers and bit strings"),
        ("D32767:2", "there are 1 from there on"),
        ("D0:0", "is not a range of D"),
        ("D0:20000", "at most 10,000"),
        ("Nope1:4", "There is no variable and no address"),
    ],
)
def test_what_is_no_part_and_no_range_is_refused(parts: Program, path: str, says: str) -> None:
    with pytest.raises(UnknownPath, match=says):
        resolve(parts, path)


def test_a_range_of_addresses_unfolds_to_them(parts: Program) -> None:
    symbol = resolve(parts, "w10 : 8")
    assert (symbol.path, symbol.type.name, symbol.expandable) == ("W10:8", "ARRAY[0..7] OF WORD", True)
    below = members(parts, "W10:8")
    assert [each.path for each in below] == [f"W{number}" for number in range(10, 18)]
    assert [each.offset for each in below] == [resolve(parts, each.path).offset for each in below]
    assert below[3] == resolve(parts, "W13")
    bits = members(parts, "A402.14:3")
    assert [each.path for each in bits] == ["A402.14", "A402.15", "A403.00"]
    assert bits[2] == resolve(parts, "A403.00")
    assert not bits[0].writable
    assert [each.path for each in complete(parts, "D120:4", 5)] == ["D120:4"]
