"""What the browser is told of a variable that is watched."""

from scanbench.host.lookup import watch_item
from tests.symbols.test_sites import program_of

SOURCE = """\
TYPE Level: INT (0..500); Tank: STRUCT level: Level; END_STRUCT; END_TYPE
FUNCTION_BLOCK Seat
VAR_IN_OUT tank: Tank; END_VAR
VAR plain: INT; END_VAR
END_FUNCTION_BLOCK
PROGRAM Main
VAR seat: Seat; tank: Tank; some: INT (-3..7); END_VAR
seat(tank := tank);
END_PROGRAM
"""


def test_a_path_that_leads_through_an_in_out_says_so() -> None:
    program = program_of(SOURCE)
    told = {}
    for path in ("Main.seat.tank", "main.SEAT.tank.level", "Main.seat.plain", "Main.seat", "Main.tank.level"):
        symbol = watch_item(program, 1, path)[0].symbol
        assert symbol is not None
        told[path] = symbol.in_out
    assert told == {
        "Main.seat.tank": True, "main.SEAT.tank.level": True, "Main.seat.plain": False, "Main.seat": False,
        "Main.tank.level": False,
    }  # fmt: skip


def test_a_subrange_is_told_with_its_bounds_whatever_it_is_called() -> None:
    program = program_of(SOURCE)
    told = {}
    for path in ("Main.tank.level", "Main.seat.tank.level", "Main.some", "Main.seat.plain"):
        symbol = watch_item(program, 1, path)[0].symbol
        assert symbol is not None
        told[path] = (symbol.type, symbol.range)
    assert told == {
        "Main.tank.level": ("Level", "INT (0..500)"), "Main.seat.tank.level": ("Level", "INT (0..500)"),
        "Main.some": ("INT (-3..7)", "INT (-3..7)"), "Main.seat.plain": ("INT", ""),
    }  # fmt: skip
