"""From bytes back to names."""

from scanbench.program.program import Program
from scanbench.program.types import BOOL
from scanbench.symbols.kept import KeptNames
from scanbench.symbols.names import Names
from scanbench.symbols.sites import sites_of
from scanbench.symbols.symbols import resolve
from tests.runtime.bench import program

SOURCE = """
TYPE Point : STRUCT x, y : INT; ok : BOOL; END_STRUCT; END_TYPE
TYPE Either : UNION whole : DWORD; half : ARRAY[0..1] OF WORD; END_UNION; END_TYPE
FUNCTION_BLOCK Inner
VAR_INPUT taken : INT; END_VAR
VAR_OUTPUT given : INT; END_VAR
VAR_IN_OUT shared : INT; END_VAR
  given := taken; shared := given;
END_FUNCTION_BLOCK
PROGRAM Main
VAR_INPUT start : BOOL; END_VAR
VAR
  p : ARRAY[1..2, 0..1] OF Point; u : Either; b : Inner; list : ARRAY[0..3] OF Inner; s : STRING[5]; n : INT; done : BOOL;
  word AT D10 : WORD; bit AT D10.03 : BOOL; words AT D20 : ARRAY[0..3] OF INT;
END_VAR
  done := start; b(taken := n, shared := n);
END_PROGRAM
"""


def at(made: Program, offset: int, bit: int | None = None) -> list[str]:
    """The names for one byte or bit."""
    mask = 0xFF if bit is None else 1 << bit
    return [each.name for each in KeptNames(made).at(offset & ~1, mask << 8 * (offset & 1))]


def test_every_single_value_is_found_by_each_of_its_bytes() -> None:
    made = program(SOURCE)
    for path in ("Main.n", "Main.done", "Main.start", "Main.s", "Main.p[1,0].x", "Main.p[2,1].ok", "Main.b.given",
                 "Main.list[3].given", "Main.word", "Main.words[2]"):  # fmt: skip
        symbol = resolve(made, path)
        for byte in range(symbol.offset, symbol.offset + symbol.type.size):
            assert path in at(made, byte), (path, byte)


def test_what_overlaps_has_all_its_names() -> None:
    made = program(SOURCE)
    assert at(made, resolve(made, "Main.u").offset + 2) == ["Main.u.whole", "Main.u.half[1]"]


def test_what_is_only_passed_on_has_no_name() -> None:
    made = program(SOURCE)
    assert at(made, resolve(made, "Main.b.taken").offset) == []
    assert at(made, resolve(made, "Main.list[2].taken").offset) == []
    slot = resolve(made, "Main.b.shared").slots[0]
    assert at(made, slot) == []


def test_in_an_area_the_smallest_variable_comes_first_and_addresses_fill_up() -> None:
    made = program(SOURCE)
    first = resolve(made, "D10").offset
    assert at(made, first, 3) == ["Main.bit"]
    assert at(made, first, 4) == ["Main.word"]
    assert at(made, first) == ["Main.bit", "Main.word"]
    free = resolve(made, "D50").offset
    assert at(made, free, 4) == ["D50.04"]
    assert at(made, free + 1, 4) == ["D50.12"]
    assert at(made, free) == ["D50"]


def test_the_header_and_padding_are_nobodys() -> None:
    made = program(SOURCE)
    assert at(made, 16) == []
    assert at(made, made.layout.state_size + 64) == []


def test_bits_that_share_a_byte_have_each_its_name() -> None:
    made = program("""
TYPE Flags : STRUCT a AT %X0.0 : BOOL; b AT %X0.3 : BOOL; w AT %W2 : WORD; END_STRUCT; END_TYPE
PROGRAM Main VAR list : ARRAY[0..1] OF Flags; END_VAR END_PROGRAM""")
    flags = resolve(made, "Main.list[1]").offset
    names = Names(made, sites_of(made))
    for name, bit in (("a", 0), ("b", 3)):
        (leaf,) = KeptNames(made).at(flags & ~1, 1 << bit + 8 * (flags & 1))
        assert (leaf.name, leaf.offset, leaf.bit) == (f"Main.list[1].{name}", flags, bit)
        assert leaf.cut(bytes((1 << bit,)), flags) == b"\x01"
        assert names.variable((flags, bit), BOOL) == resolve(made, f"Main.list[1].{name}")
        assert [each.name for each in names.at(flags, 1, 1 << bit)] == [f"Main.list[1].{name}"]
    assert [each.name for each in names.at(flags, 1)] == ["Main.list[1].a", "Main.list[1].b"]
    assert names.path(flags) == "Main.list[1].a"
    assert at(made, resolve(made, "Main.list[1].w").offset) == ["Main.list[1].w"]
